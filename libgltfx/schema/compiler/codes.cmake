# SPDX-License-Identifier: Apache-2.0
# Enumerations, which need no more of a page than its name.

# gltfx_page_order(PAGES CODES MEASURES): of the lists rule_pages and measure_pages: all pages in the order of
# their codes, the codes, and the names of measures.
function(gltfx_page_order pages codes measures)
  set(rows "")  # "CODE!PATH": "!" is before all letters, so that they sort as codes
  set(names "")
  foreach(page ${rule_pages})
    cmake_path(GET page STEM code)
    list(APPEND rows "${code}!${page}")
  endforeach()
  foreach(page ${measure_pages})
    cmake_path(GET page STEM LAST_ONLY name)
    list(APPEND names ${name})
    string(TOUPPER "BUDGET_${name}" code)
    string(REGEX REPLACE "[-.]" "_" code ${code})
    list(APPEND rows "${code}!${page}")
  endforeach()
  list(SORT rows)
  list(SORT names)
  set(${measures} ${names} PARENT_SCOPE)
  list(TRANSFORM rows REPLACE "^[^!]*!" "" OUTPUT_VARIABLE paths)
  list(TRANSFORM rows REPLACE "!.*$" "" OUTPUT_VARIABLE sorted)
  set(${pages} ${paths} PARENT_SCOPE)
  set(${codes} ${sorted} PARENT_SCOPE)
endfunction()

# gltfx_measure_names(FOLDER NAME...): writes measure/names.hpp.
function(gltfx_measure_names folder)
  set(values "")
  foreach(name ${ARGN})
    string(REGEX REPLACE "[-.]" "_" name ${name})
    string(APPEND values "  ${name},\n")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/measure/names.hpp CONTENT
"// Written by CMake from the names of schema/measures/*.md.
#pragma once

#include <cstdint>

namespace gltfx::measure {

enum class Name : std::uint8_t {
${values}};

}  // namespace gltfx::measure
" @ONLY)
endfunction()

# gltfx_rule_codes(FOLDER CODE...): writes base/codes.hpp and codes.cpp.
function(gltfx_rule_codes folder)
  set(values "")
  set(names "")
  foreach(code ${ARGN})
    string(APPEND values "  ${code},\n")
    string(APPEND names "    \"${code}\",\n")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/base/codes.hpp CONTENT
"// Written by CMake from the names of schema/rules/*.md and schema/measures/*.md.
#pragma once

#include \"base/code.hpp\"

namespace gltfx {

enum class Code : std::uint16_t {
${values}};

}  // namespace gltfx
" @ONLY)
  file(CONFIGURE OUTPUT ${folder}/codes.cpp CONTENT
"// Written by CMake from the names of schema/rules/*.md and schema/measures/*.md.
#include \"base/code.hpp\"

namespace gltfx {

std::string_view code_name(Code code) {
  static constexpr std::string_view kNames[]{
${names}  };
  return kNames[static_cast<std::size_t>(code)];
}

}  // namespace gltfx
" @ONLY)
endfunction()

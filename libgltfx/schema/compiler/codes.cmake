# SPDX-License-Identifier: Apache-2.0
# gltfx_rule_codes(FOLDER PAGE...): writes base/codes.hpp and codes.cpp, which need no more of a page than
# its name.
function(gltfx_rule_codes folder)
  set(values "")
  set(names "")
  foreach(page ${ARGN})
    cmake_path(GET page STEM code)
    string(APPEND values "  ${code},\n")
    string(APPEND names "    \"${code}\",\n")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/base/codes.hpp CONTENT
"// Written by CMake from the names of schema/rules/*.md.
#pragma once

#include \"base/code.hpp\"

namespace gltfx {

enum class Code : std::uint16_t {
${values}};

}  // namespace gltfx
" @ONLY)
  file(CONFIGURE OUTPUT ${folder}/codes.cpp CONTENT
"// Written by CMake from the names of schema/rules/*.md.
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

# SPDX-License-Identifier: Apache-2.0
# cmake -DOUT=FILE "-DFILES=a.cpp;b.cpp" -P families.cmake
# Lists each family that is defined in FILES. OUT stays as it is when nothing changes.
set(declarations "")
set(items "")
foreach(file ${FILES})
  file(STRINGS ${file} lines REGEX "^const Family& [a-z0-9_]+_family\\(\\) {")
  foreach(line ${lines})
    string(REGEX REPLACE "^const Family& ([a-z0-9_]+)\\(\\) {.*" "\\1" name "${line}")
    string(APPEND declarations "const Family& ${name}();\n")
    string(APPEND items "          ${name}(),\n")
  endforeach()
endforeach()
set(text "// Written by CMake from rules/*/*.cpp.
#include \"rules/context.hpp\"

namespace gltfx::validate {

${declarations}
std::vector<Family> all_families() {
  return {
${items}  };
}

}  // namespace gltfx::validate
")
file(WRITE ${OUT}.new "${text}")
file(COPY_FILE ${OUT}.new ${OUT} ONLY_IF_DIFFERENT)
file(REMOVE ${OUT}.new)

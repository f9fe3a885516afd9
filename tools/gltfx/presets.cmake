# SPDX-License-Identifier: Apache-2.0
# The files of schema/presets/ are data; the build puts them into C++.
#
#   cmake -DOUT=presets.cpp -DFOLDER=schema/presets -P presets.cmake     the build step
if(DEFINED OUT)
  file(GLOB_RECURSE files RELATIVE ${FOLDER} ${FOLDER}/*.toml)
  list(TRANSFORM files REPLACE "\\.toml$" "")
  list(SORT files)
  set(entries "")
  foreach(id ${files})
    file(READ ${FOLDER}/${id}.toml text)
    string(APPEND entries "  EmbeddedPreset{\"${id}\", R\"toml(${text})toml\"},\n")
  endforeach()
  file(WRITE ${OUT} "// Written by presets.cmake from schema/presets/.
#include \"presets.hpp\"

#include <array>

namespace gltfx::tool {
namespace {

constexpr std::array kPresets{
${entries}};

}  // namespace

std::span<const EmbeddedPreset> embedded_presets() { return kPresets; }

}  // namespace gltfx::tool
")
  return()
endif()

set(presets_folder ${PROJECT_SOURCE_DIR}/schema/presets)
set(presets_source ${CMAKE_CURRENT_BINARY_DIR}/presets.cpp)
file(GLOB_RECURSE preset_files CONFIGURE_DEPENDS ${presets_folder}/*.toml)
add_custom_command(OUTPUT ${presets_source}
  COMMAND ${CMAKE_COMMAND} -DOUT=${presets_source} -DFOLDER=${presets_folder}
          -P ${CMAKE_CURRENT_SOURCE_DIR}/presets.cmake
  DEPENDS presets.cmake ${preset_files}
  COMMENT "Embedding the presets" VERBATIM)
target_sources(gltfx_commands PRIVATE ${presets_source})

# SPDX-License-Identifier: Apache-2.0
# The files of schema/targets/ are data; the build puts them into C++.
#
#   cmake -DOUT=targets.cpp -DFOLDER=schema/targets -P embed.cmake     the build step
if(DEFINED OUT)
  file(GLOB files ${FOLDER}/*.json)
  list(SORT files)
  set(entries "")
  foreach(file ${files})
    get_filename_component(name ${file} NAME_WE)
    file(READ ${file} text)
    if(file MATCHES "/features.json$")
      set(features "${text}")
    else()
      # Compilers limit the length of one literal.
      string(REGEX REPLACE "\n    \"" ")json\" R\"json(\n    \"" text "${text}")
      string(APPEND entries "  EmbeddedTarget{\"${name}\", R\"json(${text})json\"},\n")
    endif()
  endforeach()
  string(REGEX REPLACE "\n    \"" ")json\" R\"json(\n    \"" features "${features}")
  file(WRITE ${OUT} "// Written by embed.cmake from schema/targets/.
#include \"target/embedded.hpp\"

#include <array>

namespace gltfx::target {
namespace {

constexpr std::array kTargets{
${entries}};

}  // namespace

std::span<const EmbeddedTarget> embedded_targets() { return kTargets; }

std::string_view embedded_features() { return R\"json(${features})json\"; }

}  // namespace gltfx::target
")
  return()
endif()

set(targets_folder ${PROJECT_SOURCE_DIR}/schema/targets)
set(targets_source ${CMAKE_CURRENT_BINARY_DIR}/targets.cpp)
file(GLOB target_files CONFIGURE_DEPENDS ${targets_folder}/*.json)
add_custom_command(OUTPUT ${targets_source}
  COMMAND ${CMAKE_COMMAND} -DOUT=${targets_source} -DFOLDER=${targets_folder}
          -P ${CMAKE_CURRENT_SOURCE_DIR}/target/embed.cmake
  DEPENDS target/embed.cmake ${target_files}
  COMMENT "Embedding the targets" VERBATIM)
target_sources(gltfx_target PRIVATE ${targets_source})

# SPDX-License-Identifier: Apache-2.0
# The schema module comes in two: gltfx_schema_core knows no schema; gltfx_schema adds those of schema/,
# which the host program gltfx_schema_compiler has checked and turned into C++.
get_target_property(schema_sources gltfx_schema SOURCES)
set(core_sources ${schema_sources})
list(FILTER core_sources EXCLUDE REGEX "/schema/builtin.cpp$")
add_library(gltfx_schema_core STATIC ${core_sources})
target_include_directories(gltfx_schema_core PUBLIC
  $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>
  $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
target_link_libraries(gltfx_schema_core PUBLIC gltfx_json PRIVATE gltfx_options fmt::fmt)
# make_set.cpp needs the schemas that this library does not have; a program that has none does not take it.
gltfx_group(gltfx_schema_core ALONE schema/make_set.cpp)

add_executable(gltfx_schema_compiler schema/compiler/main.cpp schema/compiler/embed.cpp
  schema/compiler/material_table.cpp)
target_link_libraries(gltfx_schema_compiler PRIVATE gltfx_schema_core gltfx_options fmt::fmt)

add_executable(gltfx_page_compiler base/measure.cpp schema/compiler/page_main.cpp schema/compiler/rule_page.cpp
  schema/compiler/measure_page.cpp schema/compiler/embed.cpp schema/page_reader.cpp)
target_link_libraries(gltfx_page_compiler PRIVATE gltfx_options)
target_include_directories(gltfx_page_compiler PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/include)

if(EMSCRIPTEN)  # programs of the build read files of the system
  target_link_options(gltfx_schema_compiler PRIVATE -sNODERAWFS -sALLOW_MEMORY_GROWTH
    -sWASM_ASYNC_COMPILATION=0)
  target_link_options(gltfx_page_compiler PRIVATE -sNODERAWFS -sALLOW_MEMORY_GROWTH
    -sWASM_ASYNC_COMPILATION=0)
endif()

set(schema_root ${PROJECT_SOURCE_DIR}/schema)
file(GLOB schema_files CONFIGURE_DEPENDS RELATIVE ${schema_root}
  ${schema_root}/core/*.json ${schema_root}/extensions/*.json)
list(TRANSFORM schema_files PREPEND ${schema_root}/ OUTPUT_VARIABLE schema_paths)
set(embedded ${CMAKE_CURRENT_BINARY_DIR}/embedded_schemas.cpp)
# What bake and model read of the schemas: in the folder of base/, so that every module may include it.
set(material_table ${generated}/base/material_table.hpp)
add_custom_command(OUTPUT ${embedded} ${material_table}
  COMMAND gltfx_schema_compiler ${embedded} ${material_table} ${schema_root} ${schema_files}
  DEPENDS gltfx_schema_compiler ${schema_paths}
  COMMENT "Compiling and embedding schema files" VERBATIM)

add_custom_target(gltfx_material_table DEPENDS ${material_table})
add_dependencies(gltfx_schema gltfx_material_table)
set_property(TARGET gltfx_schema PROPERTY SOURCES
  ${CMAKE_CURRENT_SOURCE_DIR}/schema/builtin.cpp ${embedded})
target_link_libraries(gltfx_schema PUBLIC gltfx_schema_core)

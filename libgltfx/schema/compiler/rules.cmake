# SPDX-License-Identifier: Apache-2.0
# What schema/rules/CODE.md and schema/measures/NAME.md yield: base/codes.hpp, measure/names.hpp, and the
# tables of rules and measures. A limit on a measure is a rule: that on open-edges is BUDGET_OPEN_EDGES.
set(generated ${CMAKE_CURRENT_BINARY_DIR}/generated)

file(GLOB rule_pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/schema/rules/*.md)
file(GLOB measure_pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/schema/measures/*.md)
include(${CMAKE_CURRENT_LIST_DIR}/codes.cmake)
gltfx_page_order(pages codes measures)
gltfx_rule_codes(${generated} ${codes})
gltfx_measure_names(${generated} ${measures})

add_custom_command(OUTPUT ${generated}/rule_table.cpp ${generated}/measure_table.cpp
  COMMAND gltfx_page_compiler ${generated}/rule_table.cpp ${generated}/measure_table.cpp ${pages}
  DEPENDS gltfx_page_compiler ${pages}
  COMMENT "Embedding the pages of rules and measures" VERBATIM)
add_custom_target(gltfx_page_tables DEPENDS ${generated}/rule_table.cpp ${generated}/measure_table.cpp)

# gltfx_page_table(TARGET NAME): adds one of the two tables to a target.
function(gltfx_page_table target name)
  # Alone, so that tests can have another in its place.
  set_source_files_properties(${generated}/${name}.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${generated}/${name}.cpp)
  add_dependencies(${target} gltfx_page_tables)
endfunction()

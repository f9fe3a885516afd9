# SPDX-License-Identifier: Apache-2.0
# What schema/rules/CODE.md yield: base/codes.hpp and the table of rules.
set(generated ${CMAKE_CURRENT_BINARY_DIR}/generated)

file(GLOB rule_pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/schema/rules/*.md)
list(SORT rule_pages)
include(${CMAKE_CURRENT_LIST_DIR}/codes.cmake)
gltfx_rule_codes(${generated} ${rule_pages})

# gltfx_rule_sources(TARGET): adds the table to a target.
function(gltfx_rule_sources target)
  set(table ${generated}/rule_table.cpp)
  add_custom_command(OUTPUT ${table}
    COMMAND gltfx_rule_compiler ${table} ${rule_pages}
    DEPENDS gltfx_rule_compiler ${rule_pages}
    COMMENT "Embedding the pages of rules" VERBATIM)
  # Alone, so that tests can have another in its place.
  set_source_files_properties(${table} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${table})
endfunction()

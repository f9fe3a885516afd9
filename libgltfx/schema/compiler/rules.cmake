# SPDX-License-Identifier: Apache-2.0
# What schema/rules/CODE.md and rules/ yield: base/codes.hpp, the table of rules and the
# list of families.
set(generated ${CMAKE_CURRENT_BINARY_DIR}/generated)

file(GLOB rule_pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/schema/rules/*.md)
list(SORT rule_pages)
include(${CMAKE_CURRENT_LIST_DIR}/codes.cmake)
gltfx_rule_codes(${generated} ${rule_pages})

# gltfx_rule_sources(TARGET): adds the table and the list to a target that compiles the families.
function(gltfx_rule_sources target)
  set(table ${generated}/rule_table.cpp)
  add_custom_command(OUTPUT ${table}
    COMMAND gltfx_rule_compiler ${table} ${rule_pages}
    DEPENDS gltfx_rule_compiler ${rule_pages}
    COMMENT "Embedding the pages of rules" VERBATIM)
  set(folder ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../../rules)
  file(GLOB_RECURSE families CONFIGURE_DEPENDS ${folder}/*.cpp)
  set(list ${generated}/families.cpp)
  add_custom_command(OUTPUT ${list}
    COMMAND ${CMAKE_COMMAND} -DOUT=${list} "-DFILES=${families}"
      -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/families.cmake
    DEPENDS ${families} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/families.cmake
    COMMENT "Listing the families of rules" VERBATIM)
  # Alone, so that tests can have others in their place.
  set_source_files_properties(${table} ${list} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${table} ${list})
endfunction()

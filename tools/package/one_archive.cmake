# SPDX-License-Identifier: Apache-2.0
# The library as one archive with everything that it links, so that users need only a compiler. Include it where the
# modules (`module_targets`) and the command that drops code for link-time optimisation (`drop_lto`) are known.
set(parts fmt::fmt simdjson::simdjson meshoptimizer::meshoptimizer)
if(GLTFX_BAKE)
  set(embree_parts embree)  # Embree has an archive for each instruction set, and for each of its libraries
  while(embree_parts)
    list(POP_FRONT embree_parts part)
    if(TARGET ${part} AND NOT part IN_LIST parts)
      list(APPEND parts ${part})
      get_target_property(needed ${part} INTERFACE_LINK_LIBRARIES)
      if(needed)
        string(REGEX REPLACE "\\$<LINK_ONLY:([^>]*)>" "\\1" needed "${needed}")
        list(APPEND embree_parts ${needed})
      endif()
    endif()
  endwhile()
endif()
set(archives ${module_targets} ${parts})
list(TRANSFORM archives REPLACE "(.+)" "ADDLIB $<TARGET_FILE:\\1>")
list(APPEND archives "ADDLIB ${GLTFX_SODIUM_LIBRARY}")
list(JOIN archives "\n" archives)
set(one ${CMAKE_CURRENT_BINARY_DIR}/libgltfx.a)
set(script ${CMAKE_CURRENT_BINARY_DIR}/libgltfx.mri)  # for ar
file(GENERATE OUTPUT ${script} CONTENT "CREATE ${one}\n${archives}\nSAVE\nEND\n")
if(GLTFX_LTO)
  set(then_drop_lto COMMAND ${drop_lto} ${one})
endif()
add_custom_command(OUTPUT ${one} COMMAND sh -c "\"${CMAKE_AR}\" -M <\"${script}\"" ${then_drop_lto}
  DEPENDS ${module_targets} ${script} VERBATIM)
add_custom_target(gltfx_one_archive ALL DEPENDS ${one})
install(FILES ${one} DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)

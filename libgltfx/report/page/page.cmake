# SPDX-License-Identifier: Apache-2.0
# Pages are written as HTML, CSS and JavaScript; the build puts them into C++.
set(page_folder ${CMAKE_CURRENT_SOURCE_DIR}/report/page)

# gltfx_page(NAME file...): NAME_begin() and NAME_end() of report/page_source.hpp.
function(gltfx_page name)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name}_source.cpp)
  list(TRANSFORM ARGN PREPEND ${page_folder}/ OUTPUT_VARIABLE files)
  string(REPLACE ";" "," names "${ARGN}")
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DOUT=${source} -DNAME=${name} -DFILES=${names} -DFOLDER=${page_folder}
            -P ${page_folder}/embed.cmake
    DEPENDS ${page_folder}/embed.cmake ${files}
    COMMENT "Embedding ${name}" VERBATIM)
  target_sources(gltfx_report PRIVATE ${source})
endfunction()

gltfx_page(page page.html page.css dom.js requirements.js details.js page.js)
gltfx_page(compare_page compare.html page.css compare.css dom.js compare.js)

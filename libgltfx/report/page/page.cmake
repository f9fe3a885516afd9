# SPDX-License-Identifier: Apache-2.0
# The page of `gltfx report` is written as HTML, CSS and JavaScript; the build puts them into C++.
set(page_folder ${CMAKE_CURRENT_SOURCE_DIR}/report/page)
set(page_source ${CMAKE_CURRENT_BINARY_DIR}/page_source.cpp)
add_custom_command(OUTPUT ${page_source}
  COMMAND ${CMAKE_COMMAND} -DOUT=${page_source} -DFOLDER=${page_folder} -P ${page_folder}/embed.cmake
  DEPENDS ${page_folder}/embed.cmake ${page_folder}/page.html ${page_folder}/page.css
          ${page_folder}/dom.js ${page_folder}/requirements.js ${page_folder}/details.js ${page_folder}/page.js
  COMMENT "Embedding the report page" VERBATIM)
target_sources(gltfx_report PRIVATE ${page_source})

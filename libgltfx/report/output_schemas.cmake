# SPDX-License-Identifier: Apache-2.0
# The JSON Schemas of what `--format json` writes stand in schema/meta/; the build puts them into C++.
#
#   cmake -DOUT=output_schemas.cpp -DFOLDER=schema/meta -P output_schemas.cmake     the build step
if(DEFINED OUT)
  file(READ ${FOLDER}/report.schema.json report)
  file(READ ${FOLDER}/inspect.schema.json inspect)
  file(READ ${FOLDER}/compare.schema.json compare)
  file(WRITE ${OUT} "// Written by output_schemas.cmake from schema/meta/.
#include <gltfx/compare.hpp>
#include <gltfx/inspect.hpp>
#include <gltfx/report.hpp>

namespace gltfx {

std::string_view json_report_schema() { return R\"json(${report})json\"; }
std::string_view compare_report_schema() { return R\"json(${compare})json\"; }
std::string_view inspect_report_schema() { return R\"json(${inspect})json\"; }

}  // namespace gltfx
")
  return()
endif()

set(meta_folder ${PROJECT_SOURCE_DIR}/schema/meta)
set(output_schemas ${CMAKE_CURRENT_BINARY_DIR}/output_schemas.cpp)
add_custom_command(OUTPUT ${output_schemas}
  COMMAND ${CMAKE_COMMAND} -DOUT=${output_schemas} -DFOLDER=${meta_folder}
          -P ${CMAKE_CURRENT_SOURCE_DIR}/report/output_schemas.cmake
  DEPENDS report/output_schemas.cmake ${meta_folder}/report.schema.json ${meta_folder}/inspect.schema.json
          ${meta_folder}/compare.schema.json
  COMMENT "Embedding the schemas of reports" VERBATIM)
target_sources(gltfx_report PRIVATE ${output_schemas})

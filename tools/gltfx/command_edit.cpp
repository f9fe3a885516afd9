// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include "commands.hpp"
#include "delete_print.hpp"
#include "edit_run.hpp"

namespace gltfx::tool {
namespace {

struct DeleteVerb : EditVerb {
  using Request = DeleteRequest;
  using Options = DeleteOptions;
  using Report = DeleteReport;
  using Summary = DeleteSummary;
  static constexpr auto run = delete_objects_in_files;
  static constexpr auto text = delete_text;
  static constexpr auto summary_text = delete_summary_text;
  static constexpr auto json = delete_json;
  static constexpr auto json_end = delete_json_end;

  static DeleteOptions options_of(const DeleteRequest& request) { return request.deletion; }
  static bool is_finding(const DeleteReport& report, const DeleteRequest& request,
                         bool /*writing*/) {
    return request.check && report.changes;
  }
};

}  // namespace

ExitCode run(const DeleteRequest& request) { return run_edit<DeleteVerb>(request); }

}  // namespace gltfx::tool

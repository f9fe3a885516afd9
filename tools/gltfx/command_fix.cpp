// SPDX-License-Identifier: Apache-2.0
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "edit_run.hpp"
#include "fix_print.hpp"

namespace gltfx::tool {
namespace {

struct FixVerb : EditVerb {
  using Request = FixRequest;
  using Options = FixOptions;
  using Report = FixReport;
  using Summary = FixSummary;
  static constexpr std::string_view external_assets = "fix can repair external assets, too";
  static constexpr auto run = fix_files;
  static constexpr auto text = fix_text;
  static constexpr auto summary_text = fix_summary_text;
  static constexpr auto json = fix_json;
  static constexpr auto json_end = fix_json_end;

  static FixOptions options_of(const FixRequest& request) { return request.fix; }

  static void note_beside_diff(const FixReport& report) {
    for (const std::string& file : report.changed_files) {
      complain(fmt::format("note: {}: the diff lacks the changes of {}, to which it refers",
                           printable(report.path), printable(file)));
    }
    for (const std::string& file : report.new_files) {
      complain(fmt::format("note: {}: the diff lacks the new file {}, to which it refers",
                           printable(report.path), printable(file)));
    }
  }

  static bool is_finding(const FixReport& report, const FixRequest& request, bool /*writing*/) {
    if (!request.check || !report.changes) return false;
    if (request.fail_on == Severity::hint) return true;
    return std::any_of(report.actions.begin(), report.actions.end(), [&](const FixAction& action) {
      return action.done && request.fail_on && action.severity <= *request.fail_on;
    });
  }
};

}  // namespace

ExitCode run(const FixRequest& request) { return run_edit<FixVerb>(request); }

}  // namespace gltfx::tool

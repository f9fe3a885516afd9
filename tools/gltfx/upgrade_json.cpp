// SPDX-License-Identifier: Apache-2.0
#include <string_view>

#include "edit_json.hpp"
#include "report/safe_text.hpp"
#include "upgrade_print.hpp"

namespace gltfx::tool {
namespace {

using json::Writer;
using report::long_value;
using report::write_long_values;

void write_action(Writer& writer, const UpgradeAction& action) {
  writer.begin_object();
  writer.member("pointer", long_value(action.pointer));
  writer.member("from", action.from);
  if (!action.to.empty() && !action.removed) writer.member("to", action.to);
  if (!action.generation.empty()) writer.member("generation", action.generation);
  writer.member("outcome", action.removed ? std::string_view("removed")
                                          : upgrade_outcome_name(action.outcome));
  writer.member("done", action.done);
  writer.member("lossy", action.lossy);
  write_long_values(writer, "notes", action.notes);
  writer.end_object();
}

void write_orphan(Writer& writer, const UpgradeOrphan& orphan) {
  writer.begin_object();
  writer.member("pointer", orphan.pointer);
  writer.member("bytes", orphan.bytes);
  writer.member("removed", orphan.removed);
  writer.end_object();
}

}  // namespace

std::string upgrade_json(const UpgradeReport& report, bool first) {
  return edit_json(report, first, [&](json::Writer& writer) {
    writer.member("verified", report.verified);
    if (!report.not_verified.empty()) writer.member("notVerified", long_value(report.not_verified));
    write_place(writer, report);
    writer.key("actions");
    writer.begin_array();
    for (const UpgradeAction& action : report.actions) write_action(writer, action);
    writer.end_array();
    write_long_values(writer, "newFiles", report.new_files);
    write_long_values(writer, "newWarnings", report.new_warnings);
    write_long_values(writer, "namesRemoved", report.names_removed);
    writer.key("orphans");
    writer.begin_array();
    for (const UpgradeOrphan& orphan : report.orphans) write_orphan(writer, orphan);
    writer.end_array();
  });
}

std::string upgrade_json_end(const UpgradeSummary& summary) {
  return edit_json_end({{"files", summary.files},
                        {"unreadable", summary.unreadable},
                        {"objects", summary.objects},
                        {"done", summary.done},
                        {"others", summary.others},
                        {"written", summary.written}});
}

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
#include <gltfx/version.hpp>

#include <string_view>

#include "json/writer.hpp"
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

std::string upgrade_json_begin() {
  std::string out = R"({"gltfx":)";
  json::append_string(out, version());
  return out + R"(,"format":1,"files":[)";
}

std::string upgrade_json(const UpgradeReport& report, bool first) {
  std::string out = first ? "\n" : ",\n";
  Writer writer(out);
  writer.begin_object();
  writer.member("path", report.path);
  writer.member("problem", edit_problem_name(report.problem));
  if (!report.error.empty()) writer.member("error", long_value(report.error));
  writer.member("changes", report.changes);
  writer.member("written", report.written);
  writer.member("verified", report.verified);
  if (!report.not_verified.empty()) writer.member("notVerified", long_value(report.not_verified));
  if (!report.written_to.empty()) writer.member("writtenTo", report.written_to);
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
  if (!report.diff.empty()) writer.member("diff", report.diff);
  writer.end_object();
  report::defuse_json(out, 0);
  return out;
}

std::string upgrade_json_end(const UpgradeSummary& summary) {
  std::string out = "\n],\"summary\":";
  Writer writer(out);
  writer.begin_object();
  writer.member("files", summary.files);
  writer.member("unreadable", summary.unreadable);
  writer.member("objects", summary.objects);
  writer.member("done", summary.done);
  writer.member("others", summary.others);
  writer.member("written", summary.written);
  writer.end_object();
  return out + "}\n";
}

}  // namespace gltfx::tool

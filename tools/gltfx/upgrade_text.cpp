// SPDX-License-Identifier: Apache-2.0
#include "upgrade_text.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "report/wording.hpp"

namespace gltfx::tool {
namespace {

std::string outcome(const UpgradeAction& action) {
  const std::string_view fate = upgrade_fate_name(action.fate);
  if (!action.done) return fmt::format("left alone: {}", fate);
  return action.removed ? "removed" : fmt::format("to {}, {}", action.to, fate);
}

std::string action_text(const UpgradeAction& action, const Style& style) {
  std::string text = fmt::format("  {}\n", style.bold(printable(action.pointer)));
  text += fmt::format("    {}\n", outcome(action));
  if (!action.generation.empty()) {
    text +=
        wrapped(printable(fmt::format("read as {}: {}", action.generation, action.decision)), 4);
  }
  for (const std::string& note : action.notes) text += wrapped(printable(note), 4);
  return text;
}

}  // namespace

void UpgradeSummary::add(const UpgradeReport& report) {
  ++files;
  objects += report.actions.size();
  done += report.actions.size() - report.left();
  written += report.written ? 1U : 0U;
}

std::string upgrade_plan_text(const UpgradeReport& report, const Style& style) {
  if (report.actions.empty()) return {};
  std::string text = printable(report.path) + "\n";
  for (const UpgradeAction& action : report.actions) text += action_text(action, style);
  return text;
}

std::string upgrade_summary_text(const UpgradeSummary& summary, bool writing) {
  const std::string files = report::counted(summary.files, "file");
  if (summary.objects == 0) {
    return fmt::format("{}, nothing legacy{}\n", files,
                       summary.written == 0
                           ? ""
                           : fmt::format("; {} written", report::counted(summary.written, "file")));
  }
  const std::string objects =
      fmt::format("{}, {}", files, report::counted(summary.objects, "legacy object"));
  if (writing) {
    return fmt::format("{}: {} upgraded, {} left; {} written\n", objects, summary.done,
                       summary.objects - summary.done, report::counted(summary.written, "file"));
  }
  return fmt::format("{}: {} can be upgraded, {} would be left; nothing was written\n", objects,
                     summary.done, summary.objects - summary.done);
}

}  // namespace gltfx::tool

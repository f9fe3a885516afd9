// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "report/wording.hpp"
#include "upgrade_print.hpp"

namespace gltfx::tool {
namespace {

std::string outcome(const UpgradeAction& action, bool refused) {
  const std::string_view outcome = upgrade_outcome_name(action.outcome);
  if (!action.is_due()) return fmt::format("left alone, {}", outcome);
  if (!action.done && refused && action.outcome == UpgradeOutcome::safe) {
    return "left alone with the whole file";
  }
  if (!action.done) return fmt::format("left alone: {}", outcome);
  if (action.removed) return "removed";
  return fmt::format("to {}, {}", action.to, action.lossy ? "with loss" : outcome);
}

// The text of an action, without its place.
std::string action_text(const UpgradeAction& action, bool refused) {
  std::string text = fmt::format("    {}\n", outcome(action, refused));
  if (!action.generation.empty()) {
    text +=
        wrapped(printable(fmt::format("read as {}: {}", action.generation, action.decision)), 4);
  }
  for (const std::string& note : action.notes) text += wrapped(printable(note), 4);
  return text;
}

// Objects of one extension with the same text.
struct ActionGroup {
  const UpgradeAction* first;
  std::string text;
  std::vector<std::string> places;
};

std::vector<ActionGroup> groups_of(const std::vector<UpgradeAction>& actions, bool refused) {
  std::vector<ActionGroup> groups;
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  for (const UpgradeAction& action : actions) {
    std::string text = action_text(action, refused);
    const auto [found, is_new] = known.insert({{action.from, text}, groups.size()});
    if (is_new) groups.push_back({&action, std::move(text), {}});
    groups[found->second].places.push_back(action.pointer.empty() ? action.from : action.pointer);
  }
  return groups;
}

std::string group_text(const ActionGroup& group, const Style& style) {
  constexpr std::size_t kMost = 3;
  const std::size_t count = group.places.size();
  if (group.first->outcome == UpgradeOutcome::on_request) {
    return fmt::format("  {} in {}: left alone, {}\n", style.bold(group.first->from),
                       report::counted(count, "object"),
                       upgrade_outcome_name(group.first->outcome));
  }
  std::string text;
  for (std::size_t i = 0; i < (count > kMost ? 1 : count); ++i) {
    text += fmt::format("  {}{}\n", style.bold(printable(group.places[i])),
                        count > kMost ? fmt::format(" and {} others", count - 1) : "");
  }
  return text + group.text;
}

std::string orphans_text(const UpgradeReport& report) {
  if (report.orphans.empty()) return {};
  constexpr std::size_t kMost = 8;
  std::string names;
  std::uint64_t bytes = 0;
  bool removed = true;
  for (const UpgradeOrphan& orphan : report.orphans) {
    if (&orphan < report.orphans.data() + kMost) names.append(1, ' ').append(orphan.pointer);
    bytes += orphan.bytes;
    removed = removed && orphan.removed;
  }
  std::string text =
      fmt::format("not used any more ({}):{}{}; {}", report::counted(bytes, "byte"), names,
                  report.orphans.size() > kMost ? " ..." : "", removed ? "removed" : "kept");
  if (!report.orphans_kept.empty()) {
    fmt::format_to(std::back_inserter(text), ": {}", report.orphans_kept);
  } else if (!removed) {
    text += ", --prune removes them";
  }
  for (const std::string& name : report.names_removed) {
    fmt::format_to(std::back_inserter(text), "; {} has no objects left: its name is removed, too",
                   name);
  }
  return wrapped(printable(text), 2);
}

}  // namespace

void UpgradeSummary::add(const UpgradeReport& report) {
  if (report.problem == EditProblem::unreadable) {
    ++unreadable;
  } else {
    ++files;
  }
  objects += report.due();
  others += report.actions.size() - report.due();
  done += report.due() - report.left();
  written += report.written ? 1U : 0U;
  for (const UpgradeAction& action : report.actions) {
    if (action.outcome == UpgradeOutcome::on_request) {
      on_request.insert(action.notes.begin(), action.notes.end());
    }
  }
}

std::string upgrade_plan_text(const UpgradeReport& report, const Style& style) {
  if (report.actions.empty()) return {};
  std::string text = printable(report.path) + "\n";
  const bool refused = report.problem != EditProblem::none;
  for (const ActionGroup& group : groups_of(report.actions, refused)) {
    text += group_text(group, style);
  }
  for (const std::string& file : report.new_files) {
    text += fmt::format("  new file: {}\n", printable(file));
  }
  for (const std::string& warning : report.new_warnings) {
    text += wrapped(printable("new warning: " + warning), 2);
  }
  text += orphans_text(report);
  if (report.verified) text += "  verified: the picture is the same\n";
  if (!report.not_verified.empty()) {
    text += wrapped(printable("not verified: " + report.not_verified), 2);
  }
  return text;
}

std::string upgrade_summary_text(const UpgradeSummary& summary, bool writing) {
  using report::counted;
  const std::string others =
      summary.others == 0 ? "" : fmt::format(" ({} left alone)", summary.others);
  std::vector<std::string> parts;
  if (summary.files > 0 && summary.objects == 0) {
    parts.push_back(fmt::format("{}, nothing {}{}", counted(summary.files, "file"),
                                summary.others == 0 ? "legacy" : "to upgrade", others));
  } else if (summary.files > 0) {
    parts.push_back(fmt::format("{}, {}{}: {} {}, {} {}", counted(summary.files, "file"),
                                counted(summary.objects, "legacy object"), others, summary.done,
                                writing ? "upgraded" : "can be upgraded",
                                summary.objects - summary.done,
                                writing ? "left" : "would be left"));
  }
  const bool matters = summary.objects > 0 || summary.written > 0;
  if (writing && matters) parts.push_back(counted(summary.written, "file") + " written");
  if (!writing && matters) parts.emplace_back("nothing was written");
  if (summary.unreadable > 0) {
    parts.push_back(counted(summary.unreadable, "file") + " could not be read");
  }
  std::string text =
      fmt::format("{}\n", parts.empty() ? "no files" : fmt::format("{}", fmt::join(parts, "; ")));
  for (const std::string& note : summary.on_request) text += wrapped(printable(note), 2);
  return text;
}

}  // namespace gltfx::tool

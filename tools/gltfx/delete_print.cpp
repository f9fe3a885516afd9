// SPDX-License-Identifier: Apache-2.0
#include "delete_print.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "edit_json.hpp"
#include "report/safe_text.hpp"
#include "report/wording.hpp"

namespace gltfx::tool {
namespace {

using report::counted;

// The first of many lines.
template <class Item, class Text>
std::string first_lines(const std::vector<Item>& items, const Text& text_of) {
  constexpr std::size_t kMost = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(items.size(), kMost); ++i) {
    text += wrapped(printable(text_of(items[i])), 2);
  }
  if (items.size() > kMost) text += fmt::format("  ... {} more\n", items.size() - kMost);
  return text;
}

std::string obstacle_text(const DeleteObstacle& obstacle) {
  return fmt::format("{} {} {}", obstacle.pointer, obstacle.must_have ? "needs" : "refers to",
                     obstacle.target);
}

}  // namespace

void DeleteSummary::add(const DeleteReport& report) {
  ++(report.problem == EditProblem::unreadable ? unreadable : files);
  refused += report.problem == EditProblem::refused ? 1U : 0U;
  deleted += report.deleted.size();
  written += report.written ? 1U : 0U;
}

std::string delete_text(const DeleteReport& report, const Style& style) {
  std::string text = first_lines(report.deleted, [](const DeletedObject& object) {
    const std::string cause = object.cause.empty() ? "" : " with " + object.cause;
    return fmt::format("delete {}{}", object.pointer, cause);
  });
  text += first_lines(report.obstacles, obstacle_text);
  if (text.empty()) return {};
  if (report.obstacles.empty()) {
    text += fmt::format("  {} renumbered\n", counted(report.renumbered, "reference"));
    if (report.bytes > 0) text += fmt::format("  {} cut out\n", counted(report.bytes, "byte"));
    for (const std::string& name : report.names_removed) {
      text += wrapped(printable(name + " has no objects left: its name is removed, too"), 2);
    }
    text += first_lines(report.doubtful, [](const std::string& pointer) {
      return "note: " + pointer + " may be an index and stays as it is";
    });
    text += first_lines(report.new_warnings,
                        [](const std::string& warning) { return "new warning: " + warning; });
  }
  return style.bold(printable(report.path)) + "\n" + text;
}

std::string delete_summary_text(const DeleteSummary& summary, bool writing) {
  std::vector<std::string> parts;
  if (summary.files > 0) {
    parts.push_back(fmt::format("{}, {} {}", counted(summary.files, "file"),
                                counted(summary.deleted, "value"),
                                writing ? "deleted" : "would be deleted"));
  }
  if (summary.refused > 0) parts.push_back(fmt::format("{} refused", summary.refused));
  parts.push_back(writing ? counted(summary.written, "file") + " written" : "nothing was written");
  if (summary.unreadable > 0) {
    parts.push_back(counted(summary.unreadable, "file") + " could not be read");
  }
  return fmt::format("{}\n", fmt::join(parts, "; "));
}

std::string delete_json(const DeleteReport& report, bool first) {
  return edit_json(report, first, [&](json::Writer& writer) {
    write_place(writer, report);
    writer.key("deleted");
    writer.begin_array();
    for (const DeletedObject& object : report.deleted) {
      writer.begin_object();
      writer.member("pointer", report::long_value(object.pointer));
      if (!object.cause.empty()) writer.member("cause", report::long_value(object.cause));
      writer.end_object();
    }
    writer.end_array();
    writer.key("obstacles");
    writer.begin_array();
    for (const DeleteObstacle& obstacle : report.obstacles) {
      writer.begin_object();
      writer.member("pointer", report::long_value(obstacle.pointer));
      writer.member("target", report::long_value(obstacle.target));
      writer.member("mustHave", obstacle.must_have);
      writer.end_object();
    }
    writer.end_array();
    writer.member("renumbered", report.renumbered);
    writer.member("bytes", report.bytes);
    report::write_long_values(writer, "namesRemoved", report.names_removed);
    report::write_long_values(writer, "doubtful", report.doubtful);
    report::write_long_values(writer, "newWarnings", report.new_warnings);
  });
}

std::string delete_json_end(const DeleteSummary& summary) {
  return edit_json_end({{"files", summary.files},
                        {"unreadable", summary.unreadable},
                        {"refused", summary.refused},
                        {"deleted", summary.deleted},
                        {"written", summary.written}});
}

}  // namespace gltfx::tool

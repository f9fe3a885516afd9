// SPDX-License-Identifier: Apache-2.0
#include "fix_print.hpp"

#include <gltfx/validate.hpp>

#include <iterator>
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

std::string places_text(const FixAction& action) {
  constexpr std::size_t kMost = 3;
  std::string text;
  for (const std::string& pointer : action.pointers) {
    if (&pointer == action.pointers.data() + kMost) break;
    if (pointer.empty()) continue;
    text.append(text.empty() ? "" : ", ").append(pointer);
  }
  if (!text.empty() && action.count > kMost) text += ", ...";
  return text;
}

std::string action_text(const FixAction& action, const Style& style) {
  const std::string places = places_text(action);
  std::string text = fmt::format("  {}{}: {}{}\n", style.bold(action.code),
                                 action.kind == Fix::unsafe ? " (unsafe)" : "",
                                 counted(action.count, "finding"), action.done ? "" : " left");
  if (!places.empty()) text += wrapped(printable(fmt::format("at {}", places)), 4);
  if (action.done) text += wrapped(find_rule(action.code)->fix_does, 4);
  if (!action.why_not.empty()) text += wrapped(printable(action.why_not), 4);
  return text;
}

void write_action(json::Writer& writer, const FixAction& action) {
  writer.begin_object();
  writer.member("code", action.code);
  writer.member("fix", fix_name(action.kind));
  writer.member("count", action.count);
  report::write_long_values(writer, "pointers", action.pointers);
  writer.member("done", action.done);
  if (!action.why_not.empty()) writer.member("why", action.why_not);
  writer.end_object();
}

}  // namespace

void FixSummary::add(const FixReport& report) {
  ++(report.problem == EditProblem::unreadable ? unreadable : files);
  fixed += report.fixed();
  left += report.left();
  written += report.written ? 1U : 0U;
}

std::string fix_text(const FixReport& report, const Style& style) {
  if (report.actions.empty()) return {};
  std::string text = printable(report.path) + "\n";
  for (const FixAction& action : report.actions) text += action_text(action, style);
  for (const std::string& file : report.changed_files) {
    text += fmt::format("  changes too: {}\n", printable(file));
  }
  for (const std::string& file : report.new_files) {
    text += fmt::format("  new file: {}\n", printable(file));
  }
  return text;
}

std::string fix_summary_text(const FixSummary& summary, bool writing) {
  std::vector<std::string> parts;
  if (summary.files > 0) {
    parts.push_back(counted(summary.files, "file") + ", ");
    std::string& text = parts.back();
    if (summary.fixed > 0) {
      fmt::format_to(std::back_inserter(text), "{} {}", counted(summary.fixed, "finding"),
                     writing ? "fixed" : "can be fixed");
    } else {
      text += "nothing to fix";
    }
    if (summary.left > 0) {
      fmt::format_to(std::back_inserter(text), ", {} left", counted(summary.left, "finding"));
    }
  }
  if (writing) parts.push_back(counted(summary.written, "file") + " written");
  if (!writing && summary.fixed > 0) parts.emplace_back("nothing was written");
  if (summary.unreadable > 0) {
    parts.push_back(counted(summary.unreadable, "file") + " could not be read");
  }
  return fmt::format("{}\n",
                     parts.empty() ? "no files" : fmt::format("{}", fmt::join(parts, "; ")));
}

std::string fix_json(const FixReport& report, bool first) {
  return edit_json(report, first, [&](json::Writer& writer) {
    write_place(writer, report);
    writer.key("actions");
    writer.begin_array();
    for (const FixAction& action : report.actions) write_action(writer, action);
    writer.end_array();
    report::write_long_values(writer, "changedFiles", report.changed_files);
    report::write_long_values(writer, "newFiles", report.new_files);
  });
}

std::string fix_json_end(const FixSummary& summary) {
  return edit_json_end({{"files", summary.files},
                        {"unreadable", summary.unreadable},
                        {"fixed", summary.fixed},
                        {"left", summary.left},
                        {"written", summary.written}});
}

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
#include "convert_print.hpp"

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

std::string loss_text(const ConvertLoss& loss) {
  if (loss.bound == 0) return loss.quantity;
  return fmt::format("{} {:.2g}{} (bound {:.2g}{})", loss.quantity, loss.measured, loss.unit,
                     loss.bound, loss.unit);
}

std::string losses_text(const ConvertStep& step) {
  if (step.losses.empty()) return "none";
  std::vector<std::string> texts;
  for (const ConvertLoss& loss : step.losses) texts.push_back(loss_text(loss));
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string notes_text(std::string_view kind, const std::vector<ConvertNote>& notes) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(notes.size(), kMost); ++i) {
    const ConvertNote& note = notes[i];
    text += wrapped(printable(fmt::format("{} {}{}{}", kind, note.pointer,
                                          note.pointer.empty() ? "" : ": ", note.reason)),
                    2);
  }
  if (notes.size() > kMost) text += fmt::format("  ... {} more {}\n", notes.size() - kMost, kind);
  return text;
}

void write_notes(json::Writer& writer, std::string_view name,
                 const std::vector<ConvertNote>& notes) {
  writer.key(name);
  writer.begin_array();
  for (const ConvertNote& note : notes) {
    writer.begin_object();
    writer.member("pointer", report::long_value(note.pointer));
    writer.member("reason", report::long_value(note.reason));
    writer.end_object();
  }
  writer.end_array();
}

void write_step(json::Writer& writer, const ConvertStep& step) {
  writer.begin_object();
  writer.member("step", step.step);
  writer.member("what", report::long_value(step.what));
  writer.member("changed", step.changes);
  write_notes(writer, "left", step.left);
  write_notes(writer, "refused", step.refused);
  writer.key("loss");
  writer.begin_array();
  for (const ConvertLoss& loss : step.losses) {
    writer.begin_object();
    writer.member("quantity", report::long_value(loss.quantity));
    if (loss.bound != 0) {
      writer.key("bound");
      writer.number(loss.bound);
      writer.key("measured");
      writer.number(loss.measured);
      writer.member("unit", loss.unit);
    }
    writer.end_object();
  }
  writer.end_array();
  writer.member("bytes_before", step.bytes_before);
  writer.member("bytes_after", step.bytes_after);
  if (step.gpu_bytes_before != 0 || step.gpu_bytes_after != 0) {
    writer.member("gpu_bytes_before", step.gpu_bytes_before);
    writer.member("gpu_bytes_after", step.gpu_bytes_after);
  }
  writer.end_object();
}

std::string remaining_text(const std::vector<ConvertRemainder>& remaining) {
  std::string text;
  for (const ConvertRemainder& each : remaining) {
    const std::string help = each.help.empty() ? std::string() : fmt::format(" ({})", each.help);
    text += wrapped(
        printable(fmt::format("remains {}{}{}{}", each.pointer, each.pointer.empty() ? "" : ": ",
                              without_stop(each.message), help)),
        2);
  }
  return text;
}

std::string saving_text(std::uint64_t bytes) {
  return bytes == 0 ? std::string() : size_text(bytes);
}

std::string savings_text(const ConvertReport& report, const Style& style) {
  std::string text;
  if (!report.savings.empty()) {
    TextTable table("lrr", {"option", "saves", "GPU memory"});
    for (const ConvertSaving& each : report.savings) {
      table.add({std::string(each.option), saving_text(each.bytes), saving_text(each.gpu_bytes)});
    }
    text = table.text(2, style);
  }
  return text + fmt::format("  GPU memory now: images {}, meshes {}\n",
                            size_text(report.gpu_image_bytes), size_text(report.gpu_mesh_bytes));
}

void write_savings(json::Writer& writer, const ConvertReport& report) {
  writer.key("savings");
  writer.begin_array();
  for (const ConvertSaving& each : report.savings) {
    writer.begin_object();
    writer.member("option", each.option);
    writer.member("bytes", each.bytes);
    writer.member("gpuBytes", each.gpu_bytes);
    writer.end_object();
  }
  writer.end_array();
}

void write_remaining(json::Writer& writer, const std::vector<ConvertRemainder>& remaining) {
  writer.key("remaining");
  writer.begin_array();
  for (const ConvertRemainder& each : remaining) {
    writer.begin_object();
    writer.member("target", each.target);
    writer.member("feature", each.feature);
    writer.member("pointer", report::long_value(each.pointer));
    writer.member("message", report::long_value(each.message));
    writer.member("help", each.help);
    writer.member("refused", each.refused);
    writer.end_object();
  }
  writer.end_array();
}

}  // namespace

void ConvertSummary::add(const ConvertReport& report) {
  ++(report.problem == EditProblem::unreadable ? unreadable : files);
  changed += report.changes ? 1U : 0U;
  refused += report.problem == EditProblem::refused ? 1U : 0U;
  written += report.written ? 1U : 0U;
}

std::string convert_text(const ConvertReport& report, const Style& style) {
  const bool sizes = report.gpu_image_bytes > 0 || report.gpu_mesh_bytes > 0;
  if (report.steps.empty() && report.remaining.empty() && !sizes) return {};
  TextTable table("lllll", {"step", "what", "bytes", "", "loss"});
  std::string notes;
  for (const ConvertStep& step : report.steps) {
    table.add({std::string(step.step), printable(step.what.empty() ? "nothing to do" : step.what),
               size_text(step.bytes_before),
               step.changes ? "-> " + size_text(step.bytes_after) : std::string(),
               printable(losses_text(step))});
    if (step.gpu_bytes_before != step.gpu_bytes_after) {
      notes += fmt::format("  GPU memory of the converted images: {} -> {}\n",
                           size_text(step.gpu_bytes_before), size_text(step.gpu_bytes_after));
    }
    notes += notes_text("left", step.left);
    notes += notes_text("refused", step.refused);
  }
  std::string text = style.bold(printable(report.path)) + "\n";
  if (!report.steps.empty()) text += table.text(2, style);
  text += notes + remaining_text(report.remaining);
  if (sizes) text += savings_text(report, style);
  for (const std::string& file : report.new_files) {
    text += fmt::format("  new file: {}\n", printable(file));
  }
  for (const std::string& warning : report.new_warnings) {
    text += wrapped(printable("new warning: " + warning), 2);
  }
  if (report.verified) text += "  verified: the picture is the same\n";
  if (!report.not_verified.empty()) {
    text += wrapped(printable("not verified: " + report.not_verified), 2);
  }
  return text;
}

std::string convert_summary_text(const ConvertSummary& summary, bool writing) {
  std::vector<std::string> parts;
  if (summary.files > 0) {
    parts.push_back(fmt::format("{}, {} {}", counted(summary.files, "file"), summary.changed,
                                writing ? "converted" : "can be converted"));
  }
  if (summary.refused > 0) parts.push_back(fmt::format("{} refused", summary.refused));
  parts.push_back(writing ? counted(summary.written, "file") + " written" : "nothing was written");
  if (summary.unreadable > 0) {
    parts.push_back(counted(summary.unreadable, "file") + " could not be read");
  }
  return fmt::format("{}\n", fmt::join(parts, "; "));
}

std::string convert_json(const ConvertReport& report, bool first) {
  return edit_json(report, first, [&](json::Writer& writer) {
    write_place(writer, report);
    writer.key("steps");
    writer.begin_array();
    for (const ConvertStep& step : report.steps) write_step(writer, step);
    writer.end_array();
    write_remaining(writer, report.remaining);
    write_savings(writer, report);
    writer.key("gpuBytes");
    writer.begin_object();
    writer.member("images", report.gpu_image_bytes);
    writer.member("meshes", report.gpu_mesh_bytes);
    writer.end_object();
    report::write_long_values(writer, "newFiles", report.new_files);
    report::write_long_values(writer, "newWarnings", report.new_warnings);
    writer.member("verified", report.verified);
    if (!report.not_verified.empty()) {
      writer.member("notVerified", report::long_value(report.not_verified));
    }
  });
}

std::string convert_json_end(const ConvertSummary& summary) {
  return edit_json_end({{"files", summary.files},
                        {"unreadable", summary.unreadable},
                        {"refused", summary.refused},
                        {"changed", summary.changed},
                        {"written", summary.written}});
}

}  // namespace gltfx::tool

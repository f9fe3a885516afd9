// SPDX-License-Identifier: Apache-2.0
#include "compare_print.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "report/safe_text.hpp"
#include "report/wording.hpp"

namespace gltfx::tool {
namespace {

using report::counted;

// "12:18", or "12:18 -> 14:18" where both texts have the value at other places.
std::string lines_of(const Change& change) {
  const auto line = [](const Location& at) {
    return at.line == 0 ? std::string() : fmt::format("{}:{}", at.line, at.column);
  };
  const std::string before = line(change.old_location);
  const std::string after = line(change.new_location);
  if (before.empty() || before == after) return after;
  return after.empty() ? before : fmt::format("{} -> {}", before, after);
}

// "usual view: changed by up to 12.3 of 255 steps; noise explains 1.4"
std::string picture_row(const ComparePicture& picture) {
  std::string row = picture.changed() ? fmt::format("{} view: changed by up to {:.1f} of 255 steps",
                                                    picture.view, picture.distance)
                                      : fmt::format("{} view: no change", picture.view);
  if (picture.limit > 1 && !picture.changed()) {
    row += fmt::format("; it differs by {:.1f} of 255 steps", picture.distance);
  }
  if (picture.limit > 1) row += fmt::format("; noise explains {:.1f}", picture.limit);
  return row;
}

}  // namespace

std::string pair_name(const CompareReport& report) {
  if (report.old_path.empty()) return report::safe(report.new_path);
  if (report.new_path.empty() || report.new_path == report.old_path) {
    return report::safe(report.old_path);
  }
  return fmt::format("{} -> {}", report::safe(report.old_path), report::safe(report.new_path));
}

std::string place_of(const Change& change) {
  if (!change.old_pointer) return fmt::format("+ {}", *change.new_pointer);
  if (!change.new_pointer) return fmt::format("- {}", *change.old_pointer);
  if (*change.old_pointer == *change.new_pointer) return *change.old_pointer;
  return fmt::format("{} -> {}", *change.old_pointer, *change.new_pointer);
}

std::string size_row(const CompareSize& size) {
  std::string text =
      fmt::format("{} {} -> {}", size.what, size_text(size.old_bytes), size_text(size.new_bytes));
  if (size.old_bytes > 0) {
    const auto before = static_cast<double>(size.old_bytes);
    const auto after = static_cast<double>(size.new_bytes);
    const double part = 100 * (after - before) / before;
    text += std::fabs(part) < 10 ? fmt::format(" ({:+.2g} %)", part)
                                 : fmt::format(" ({:+.0f} %)", part);
  }
  return text;
}

std::vector<std::string> storage_rows(const CompareReport& report) {
  std::vector<std::string> rows = report.storage;
  if (report.sizes.empty()) return rows;
  const auto& files = report.sizes.front();
  const std::uint64_t apart =
      std::max(files.old_bytes, files.new_bytes) - std::min(files.old_bytes, files.new_bytes);
  if (report.level == CompareLevel::differs && apart * 100 < files.old_bytes) return rows;
  for (const CompareSize& size : report.sizes) {
    if (size.old_bytes != size.new_bytes) rows.push_back(size_row(size));
  }
  return rows;
}

std::string parents_of(const CompareReport& report) {
  constexpr std::size_t kMost = 8;
  const auto& all = report.external_asset_of;
  std::string text = "external asset of ";
  for (std::size_t i = 0; i < std::min(all.size(), kMost); ++i) {
    text += (i == 0 ? "" : ", ") + report::safe_cut(all[i], 200);
  }
  return all.size() <= kMost ? text : fmt::format("{} and {} more", text, all.size() - kMost);
}

std::string measure_of(const CompareMeasure& measure, bool with_bound) {
  if (!std::isfinite(measure.value)) return {};
  const bool close = measure.unit.empty() || measure.unit == "%" || measure.unit == "/255";
  std::string text = fmt::format(" ({} {:.3g}{}{}", measure.quantity, measure.value,
                                 close ? "" : " ", measure.unit);
  if (with_bound) {
    text += fmt::format(", bound {:.3g}{}{}", measure.bound, close ? "" : " ", measure.unit);
  }
  return text + ')';
}

std::string sentence_of(const Change& change) {
  const bool is_named = change.name.empty() || change.what.starts_with("renamed \"");
  return is_named ? change.what : gltfx::quoted(change.name) + " " + change.what;
}

std::string kinds_of(const CompareReport& report) {
  std::map<std::string_view, std::uint64_t> kinds;
  for (const Change& change : report.changes) ++kinds[change.kind];
  std::vector<std::pair<std::string_view, std::uint64_t>> sorted(kinds.begin(), kinds.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& one, const auto& two) { return one.second > two.second; });
  std::vector<std::string> parts;
  for (const auto& [kind, count] : sorted) parts.push_back(fmt::format("{} {}", count, kind));
  constexpr std::size_t kMost = 6;
  if (parts.size() > kMost) {
    const std::size_t more = parts.size() - kMost;
    parts.resize(kMost);
    parts.push_back(fmt::format("{} more kinds", more));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void CompareSummary::add(const CompareReport& report, CompareLevel allow) {
  ++pairs;
  if (!report.error.empty()) {
    ++unreadable;
  } else {
    ++levels[static_cast<std::size_t>(report.level)];
    unproven += report.unproven.empty() ? 0U : 1U;
  }
  allowed = allowed && report.is_within(allow);
}

std::string compare_headline(const CompareReport& report) {
  if (report.old_path.empty()) return "added";
  if (report.new_path.empty()) return "removed";
  std::string text(compare_level_name(report.level));
  if (!report.changes.empty()) text += ": " + kinds_of(report);
  if (!report.unproven.empty()) text += fmt::format("; {} unproven", report.unproven.size());
  return text;
}

std::string compare_text(const CompareReport& report, std::size_t most, const Style& style) {
  std::string text =
      fmt::format("{}: {}\n", style.bold(pair_name(report)), compare_headline(report));
  if (!report.external_asset_of.empty()) text += wrapped(parents_of(report), 2);
  const std::size_t shown =
      most == 0 ? report.changes.size() : std::min(most, report.changes.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const Change& change = report.changes[i];
    const std::string lines = lines_of(change);
    text += fmt::format("  {}\n",
                        style.dim(fmt::format("{}  {}{}", report::safe_cut(place_of(change), 200),
                                              change.kind, lines.empty() ? lines : "  " + lines)));
    const std::string measure = change.measure ? measure_of(*change.measure, true) : "";
    text += wrapped(report::safe_cut(sentence_of(change) + measure, 400), 4);
  }
  if (shown < report.changes.size()) {
    text +=
        fmt::format("  ... {} more (--all)\n", counted(report.changes.size() - shown, "change"));
  }
  for (const std::string& each : storage_rows(report)) {
    text += wrapped("storage: " + report::safe_cut(each, 400), 2);
  }
  for (const std::string& each : report.unproven) {
    text += wrapped("unproven: " + report::safe_cut(each, 400), 2);
  }
  for (const ComparePicture& picture : report.pictures) {
    if (picture.has_both()) text += wrapped("picture: " + picture_row(picture), 2);
  }
  if (!report.picture_problem.empty()) {
    text += wrapped("picture: " + report::safe_cut(report.picture_problem, 400), 2);
  }
  return text;
}

void write_picture_verdict(json::Writer& writer, const ComparePicture& picture) {
  writer.member("view", picture.view);
  if (picture.change) writer.member("change", std::uint64_t{*picture.change});
  if (!picture.has_both()) return;
  writer.member("changed", picture.changed());
  writer.key("distance");
  writer.number(picture.distance);
  writer.key("limit");
  writer.number(picture.limit);
}

void write_picture_names(json::Writer& writer, const ComparePicture& picture) {
  writer.begin_object();
  write_picture_verdict(writer, picture);
  const auto name = [&](std::string_view key, const std::string& file) {
    writer.key(key);
    if (file.empty()) {
      writer.null();
    } else {
      writer.string(file);
    }
  };
  name("old", picture.old_file);
  name("new", picture.new_file);
  name("difference", picture.difference_file);
  writer.end_object();
}

namespace {

void write_line(json::Writer& writer, const char* line, const char* column, const Location& at) {
  if (at.line == 0) return;
  writer.member(line, std::uint64_t{at.line});
  writer.member(column, std::uint64_t{at.column});
}

void write_sizes(json::Writer& writer, const std::vector<CompareSize>& sizes) {
  writer.key("sizes");
  writer.begin_array();
  for (const CompareSize& size : sizes) {
    writer.begin_object();
    writer.member("what", size.what);
    writer.member("old", size.old_bytes);
    writer.member("new", size.new_bytes);
    writer.end_object();
  }
  writer.end_array();
}

void write_change(json::Writer& writer, const Change& change) {
  const auto pointer = [&](std::string_view name, const std::optional<std::string>& value) {
    writer.key(name);
    if (value) {
      writer.string(report::long_value(*value));
    } else {
      writer.null();
    }
  };
  writer.begin_object();
  writer.member("kind", change.kind);
  writer.member("level", compare_level_name(change.level));
  pointer("old", change.old_pointer);
  pointer("new", change.new_pointer);
  write_line(writer, "oldLine", "oldColumn", change.old_location);
  write_line(writer, "newLine", "newColumn", change.new_location);
  if (!change.name.empty()) writer.member("name", report::long_value(change.name));
  writer.member("what", report::long_value(change.what));
  if (!change.before.empty()) writer.member("before", report::long_value(change.before));
  if (!change.after.empty()) writer.member("after", report::long_value(change.after));
  if (change.time) {
    writer.key("time");
    writer.number(*change.time);
  }
  if (change.measure) {
    writer.key("measure");
    writer.begin_object();
    writer.member("quantity", change.measure->quantity);
    writer.key("value");
    if (std::isfinite(change.measure->value)) {
      writer.number(change.measure->value);
    } else {
      writer.null();
    }
    writer.member("unit", change.measure->unit);
    writer.key("bound");
    writer.number(change.measure->bound);
    writer.end_object();
  }
  if (!change.also.empty()) report::write_long_values(writer, "also", change.also);
  writer.end_object();
}

}  // namespace

void write_compare_pair(json::Writer& writer, const CompareReport& report,
                        const WriteComparePicture& write_picture) {
  const auto path = [&](std::string_view name, const std::string& value) {
    writer.key(name);
    if (value.empty()) {
      writer.null();
    } else {
      writer.string(value);
    }
  };
  writer.begin_object();
  path("old", report.old_path);
  path("new", report.new_path);
  if (!report.external_asset_of.empty()) {
    report::write_long_values(writer, "externalAssetOf", report.external_asset_of);
  }
  if (!report.error.empty()) writer.member("error", report::long_value(report.error));
  writer.member("level", compare_level_name(report.level));
  writer.key("changes");
  writer.begin_array();
  for (const Change& change : report.changes) write_change(writer, change);
  writer.end_array();
  report::write_long_values(writer, "storage", report.storage);
  report::write_long_values(writer, "unproven", report.unproven);
  if (!report.sizes.empty()) write_sizes(writer, report.sizes);
  if (!report.pictures.empty()) {
    writer.key("pictures");
    writer.begin_array();
    for (const ComparePicture& picture : report.pictures) write_picture(writer, picture);
    writer.end_array();
  }
  if (!report.picture_problem.empty()) {
    writer.member("pictureProblem", report::long_value(report.picture_problem));
  }
  writer.end_object();
}

void write_compare_summary(json::Writer& writer, const CompareSummary& summary) {
  writer.begin_object();
  writer.member("pairs", summary.pairs);
  for (std::size_t i = 0; i < 4; ++i) {
    writer.member(compare_level_name(static_cast<CompareLevel>(i)), summary.levels[i]);
  }
  writer.member("unproven", summary.unproven);
  writer.member("unreadable", summary.unreadable);
  writer.member("allowed", summary.allowed);
  writer.end_object();
}

}  // namespace gltfx::tool

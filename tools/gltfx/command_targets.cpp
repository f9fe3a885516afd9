// SPDX-License-Identifier: Apache-2.0
// A matrix of features and engines.
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "json/writer.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

// The outcome of a feature in one version, or an empty text.
std::string_view outcome(const TargetChoice& choice, const std::string& feature,
                         std::vector<TargetRange> TargetFeature::*way) {
  const auto found = choice.target->features.find(feature);
  if (found == choice.target->features.end()) return {};
  const TargetRange* range = outcome_of(found->second.*way, choice.version);
  return range == nullptr ? std::string_view() : target_outcome_name(range->outcome);
}

// "read", or "ignored, refused" if the outcome of a required extension differs.
std::string cell(const TargetChoice& choice, const std::string& feature) {
  const std::string_view used = outcome(choice, feature, &TargetFeature::used);
  const std::string_view required = outcome(choice, feature, &TargetFeature::required);
  if (required.empty() || required == used) return std::string(used);
  return fmt::format("{}, {}", used.empty() ? "-" : used, required);
}

using Row = std::vector<std::string>;

// The heading row first. Features that none of the versions was measured with are left out.
std::vector<Row> table_of(const std::vector<TargetChoice>& choices) {
  std::vector<Row> rows{{"feature"}};
  for (const TargetChoice& choice : choices) rows.front().push_back(choice.label());
  for (const auto& [name, feature] : target_features()) {
    Row row{name};
    bool measured = false;
    for (const TargetChoice& choice : choices) {
      row.push_back(cell(choice, name));
      measured = measured || !row.back().empty();
    }
    if (measured) rows.push_back(std::move(row));
  }
  return rows;
}

const std::string& date_of(const TargetChoice& choice) {
  return choice.target->versions[choice.version].released;
}

// A sentence for each version whose date is known.
std::string dates_of(const std::vector<TargetChoice>& choices) {
  std::string text;
  for (const TargetChoice& choice : choices) {
    if (date_of(choice).empty()) continue;
    text += fmt::format("{} was released on {}.\n", choice.label(), date_of(choice));
  }
  return text;
}

std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) line += padded(row[i], widths[i]) + "  ";
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

constexpr std::string_view kTwo = "where the extension is used, where it is required";

// "ignored, refused" as "-x".
std::string signs_of(const std::string& cell) {
  constexpr std::array<std::pair<std::string_view, char>, 5> kSigns{
      {{"refused", 'x'}, {"ignored", '-'}, {"read", 'r'}, {"drawn", 'd'}, {"-", '.'}}};
  std::string signs;
  for (std::size_t at = 0; at < cell.size();) {
    const std::size_t end = std::min(cell.find(", ", at), cell.size());
    for (const auto& [word, sign] : kSigns) {
      if (std::string_view(cell).substr(at, end - at) == word) signs += sign;
    }
    at = end + 2;
  }
  return signs;
}

// With many engines, columns are numbers and outcomes are signs.
std::string folded(std::vector<Row> rows, const std::vector<TargetChoice>& choices) {
  std::vector<Row> legend;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const std::string& date = date_of(choices[i]);
    legend.push_back({fmt::format("{:2}", i + 1), choices[i].label(),
                      date.empty() ? std::string() : "released on " + date});
    rows.front()[i + 1] = std::to_string(i + 1);
  }
  for (auto row = rows.begin() + 1; row != rows.end(); ++row) {
    for (auto field = row->begin() + 1; field != row->end(); ++field) *field = signs_of(*field);
  }
  return fmt::format(
      "{}\nx refused, - ignored, r read, d drawn, . or empty: not measured.\nTwo signs: {}.\n\n{}",
      aligned(legend), kTwo, aligned(rows));
}

std::string targets_text(const std::vector<Row>& rows, const std::vector<TargetChoice>& choices) {
  constexpr std::size_t kWidest = 100;
  const std::string text = aligned(rows);
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
    if (text.find('\n', at) - at > kWidest) return folded(rows, choices);
  }
  return fmt::format("{}\nTwo outcomes: {}. Empty: not measured.\n{}", text, kTwo,
                     dates_of(choices));
}

std::string targets_markdown(const std::vector<Row>& rows) {
  std::string text;
  for (const Row& row : rows) {
    text += '|';
    for (const std::string& field : row) text += fmt::format(" {} |", field);
    text += '\n';
    if (&row != &rows.front()) continue;
    text += '|';
    for (std::size_t i = 0; i < row.size(); ++i) text += "---|";
    text += '\n';
  }
  return text;
}

void write_ranges(json::Writer& writer, const Target& target, std::string_view name,
                  const std::vector<TargetRange>& ranges) {
  if (ranges.empty()) return;
  writer.key(name);
  writer.begin_array();
  for (const TargetRange& range : ranges) {
    writer.begin_object();
    writer.member("since", target.versions[range.first].version);
    writer.member("until", target.versions[range.last].version);
    writer.member("outcome", target_outcome_name(range.outcome));
    writer.end_object();
  }
  writer.end_array();
}

void write_target(json::Writer& writer, const Target& target) {
  writer.begin_object();
  writer.member("name", target.name);
  writer.member("title", target.title);
  writer.member("source", target.source);
  writer.member("setUp", target.set_up);
  writer.member("method", target.method);
  writer.key("versions");
  writer.begin_array();
  for (const TargetVersion& version : target.versions) {
    writer.begin_object();
    writer.member("version", version.version);
    writer.member("released", version.released);
    writer.end_object();
  }
  writer.end_array();
  writer.key("features");
  writer.begin_object();
  for (const auto& [name, feature] : target.features) {
    writer.key(name);
    writer.begin_object();
    write_ranges(writer, target, "used", feature.used);
    write_ranges(writer, target, "required", feature.required);
    write_ranges(writer, target, "requiredWithFallback", feature.required_with_fallback);
    writer.end_object();
  }
  writer.end_object();
  writer.end_object();
}

// All versions of each named target.
std::string targets_json(const std::vector<TargetChoice>& choices) {
  std::string text;
  json::Writer writer(text, true);
  writer.begin_object();
  writer.key("targets");
  writer.begin_array();
  std::map<std::string_view, const Target*> named;
  for (const TargetChoice& choice : choices) named.emplace(choice.target->name, &*choice.target);
  for (const auto& [name, target] : named) write_target(writer, *target);
  writer.end_array();
  writer.end_object();
  return text + '\n';
}

}  // namespace

ExitCode run(const TargetsRequest& request) {
  if (request.format == MatrixFormat::json) return print(targets_json(request.choices));
  const std::vector<Row> rows = table_of(request.choices);
  if (request.format == MatrixFormat::markdown) return print(targets_markdown(rows));
  return print(targets_text(rows, request.choices));
}

}  // namespace gltfx::tool

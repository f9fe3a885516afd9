// SPDX-License-Identifier: Apache-2.0
// `gltfx measures`: what can be measured and limited.
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "json/writer.hpp"
#include "suggestion.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

std::vector<std::string_view> scopes_of(const MeasureDescription& measure) {
  std::vector<std::string_view> scopes;
  for (std::size_t i = 0; i < kMeasureScopeCount; ++i) {
    const auto scope = static_cast<MeasureScope>(i);
    const bool of_asset = scope == MeasureScope::asset && measure.is_of_asset();
    if (of_asset || measure.is_on(scope)) scopes.push_back(measure_scope_name(scope));
  }
  return scopes;
}

// "B", or the type of what is no number.
std::string_view unit_of(const MeasureDescription& measure) {
  return measure.type == MeasureType::number ? measure.unit : measure_type_name(measure.type);
}

void write_measure(json::Writer& writer, const MeasureDescription& measure) {
  writer.begin_object();
  writer.member("name", measure.name);
  writer.member("code", measure.code);
  writer.key("on");
  writer.begin_array();
  for (const std::string_view scope : scopes_of(measure)) writer.string(scope);
  writer.end_array();
  writer.member("type", measure_type_name(measure.type));
  writer.member("unit", measure.unit);
  writer.member("total", measure_total_name(measure.total));
  writer.member("needs", measure_needs_name(measure.needs));
  writer.member("summary", measure.summary);
  writer.member("definition", measure.definition);
  writer.member("help", measure.help);
  writer.member("example", measure.example);
  writer.member("values", measure.values);
  writer.end_object();
}

using Chosen = std::vector<const MeasureDescription*>;

std::string measures_json(const Chosen& chosen) {
  std::string text;
  json::Writer writer(text, true);
  writer.begin_object();
  writer.key("measures");
  writer.begin_array();
  for (const MeasureDescription* measure : chosen) write_measure(writer, *measure);
  writer.end_array();
  writer.end_object();
  return text + '\n';
}

std::string scopes_text(const MeasureDescription& measure) {
  return fmt::format("{}", fmt::join(scopes_of(measure), ", "));
}

std::string measure_list(const Chosen& chosen) {
  std::size_t name = 0, scopes = 0, unit = 0;
  for (const MeasureDescription* measure : chosen) {
    name = std::max(name, measure->name.size());
    scopes = std::max(scopes, scopes_text(*measure).size());
    unit = std::max(unit, unit_of(*measure).size());
  }
  std::string text;
  for (const MeasureDescription* measure : chosen) {
    text += fmt::format("{}  {}  {}  {}\n", padded(measure->name, name),
                        padded(scopes_text(*measure), scopes), padded(unit_of(*measure), unit),
                        measure->summary);
  }
  text += fmt::format("\n{} measures. 'gltfx measures NAME' says more.\n", chosen.size());
  return text;
}

std::string measure_page(const MeasureDescription& measure, const Style& style) {
  constexpr std::size_t kPageIndent = 2;
  std::string text = fmt::format("{}: {}.\n", style.bold(measure.name), measure.summary);
  const auto section = [&](std::string_view title, std::string_view paragraph) {
    text += fmt::format("\n{}{}\n{}", std::string(kPageIndent, ' '), style.bold(title),
                        wrapped(paragraph, kPageIndent + 2));
  };
  const auto block = [&](std::string_view title, std::string_view lines) {
    text += fmt::format("\n{}{}\n", std::string(kPageIndent, ' '), style.bold(title));
    while (!lines.empty()) {
      const std::size_t end = std::min(lines.find('\n'), lines.size());
      text += fmt::format("{}{}\n", std::string(kPageIndent + 2, ' '), lines.substr(0, end));
      lines.remove_prefix(std::min(end + 1, lines.size()));
    }
  };
  section("Definition", measure.definition);
  section("How to meet a limit", measure.help);
  block("Example", measure.example);
  block("Values", measure.values);
  std::string rest =
      fmt::format("on: {}\ntype: {}\n", scopes_text(measure), measure_type_name(measure.type));
  if (!measure.unit.empty()) rest += fmt::format("unit: {}\n", measure.unit);
  if (measure.total != MeasureTotal::none) {
    rest +=
        fmt::format("value of the asset: {} of the elements\n", measure_total_name(measure.total));
  }
  rest += fmt::format("needs: {}\ncode of a limit: {}\n", measure_needs_name(measure.needs),
                      measure.code);
  block("Details", rest);
  return text;
}

}  // namespace

ExitCode run(const MeasuresRequest& request) {
  Chosen chosen;
  std::vector<std::string_view> names;
  for (const MeasureDescription& measure : measures()) {
    names.push_back(measure.name);
    if (request.name.empty() || measure.name == request.name) chosen.push_back(&measure);
  }
  if (chosen.empty()) {
    complain(fmt::format("measures: there is no measure {}.{} 'gltfx measures' lists them all.",
                         gltfx::quoted(request.name), suggestion(request.name, names)));
    return ExitCode::usage;
  }
  if (request.format == TableFormat::json) return print(measures_json(chosen));
  if (request.name.empty()) return print(measure_list(chosen));
  const Style style(colors_on_stdout(request.common.color));
  std::string text;
  for (const MeasureDescription* measure : chosen) {
    if (!text.empty()) text += '\n';
    text += measure_page(*measure, style);
  }
  return print(text);
}

}  // namespace gltfx::tool

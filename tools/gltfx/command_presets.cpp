// SPDX-License-Identifier: Apache-2.0
// `gltfx presets`: published limits, with their source and date.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "json/writer.hpp"
#include "limit_rows.hpp"
#include "presets.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

std::vector<Limit> limits_of(const Preset& preset) {
  std::vector<Limit> limits;
  for (const measure::LimitChange& change : preset.limits) measure::apply(limits, change);
  return limits;
}

void write_value(json::Writer& writer, const Limit& limit) {
  writer.key("limit");
  if (limit.op == LimitOp::allow || limit.op == LimitOp::deny) {
    writer.begin_array();
    for (const std::string& text : limit.texts) writer.string(text);
    writer.end_array();
  } else if (!limit.texts.empty()) {
    writer.string(limit.texts.front());
  } else if (limit.measure->type == MeasureType::number) {
    writer.number(limit.number);
  } else {
    writer.boolean(limit.flag);
  }
}

void write_preset(json::Writer& writer, const Preset& preset) {
  writer.begin_object();
  writer.member("id", preset.id);
  writer.member("title", preset.title);
  writer.member("source", preset.source);
  writer.member("dated", preset.dated);
  writer.member("read", preset.read);
  writer.member("evidence", preset.evidence);
  writer.key("limits");
  writer.begin_array();
  for (const Limit& limit : limits_of(preset)) {
    writer.begin_object();
    writer.member("measure", limit.measure->name);
    writer.member("on", measure_scope_name(limit.on));
    writer.member("op", limit_op_name(limit.op));
    write_value(writer, limit);
    writer.member("unit", limit.measure->unit);
    writer.member("severity", severity_name(limit.severity));
    if (!limit.note.empty()) writer.member("note", limit.note);
    writer.end_object();
  }
  writer.end_array();
  writer.end_object();
}

std::string presets_json(const std::vector<Preset>& presets) {
  std::string text;
  json::Writer writer(text, true);
  writer.begin_object();
  writer.key("presets");
  writer.begin_array();
  for (const Preset& preset : presets) write_preset(writer, preset);
  writer.end_array();
  writer.end_object();
  return text + '\n';
}

std::string preset_list(const std::vector<Preset>& presets) {
  std::size_t id = 0, dated = 0;
  for (const Preset& preset : presets) {
    id = std::max(id, preset.id.size());
    dated = std::max(dated, preset.dated.size());
  }
  std::string text;
  for (const Preset& preset : presets) {
    text += fmt::format("{}  {}  {}\n{}{}\n", padded(preset.id, id), padded(preset.dated, dated),
                        preset.title, std::string(id + 2, ' '), preset.source);
  }
  text +=
      fmt::format("\n{} presets. 'gltfx presets ID' prints the limits of one.\n", presets.size());
  return text;
}

std::string preset_page(const Preset& preset, const Style& style) {
  const char* const evidence =
      preset.evidence == "page" ? "on the page of the owner" : "in a repository of the owner";
  std::string text =
      fmt::format("{}: {}\n  source: {}\n  dated: {}\n  read: {}, {}\n\n", style.bold(preset.id),
                  preset.title, preset.source, preset.dated, preset.read, evidence);
  std::vector<ConfigRow> rows;
  for (const Limit& limit : limits_of(preset))
    rows.push_back(limit_row(limit, printable(limit.note)));
  return text + in_columns(rows);
}

}  // namespace

ExitCode run(const PresetsRequest& request) {
  std::vector<Preset> presets;
  for (const EmbeddedPreset& each : embedded_presets()) {
    if (!request.id.empty() && each.id != request.id) continue;
    auto preset = read_preset(each.id);
    if (preset) presets.push_back(*std::move(preset));
  }
  if (presets.empty()) {
    complain("presets: " + read_preset(request.id).error().message);
    return ExitCode::usage;
  }
  if (request.format == TableFormat::json) return print(presets_json(presets));
  if (request.id.empty()) return print(preset_list(presets));
  return print(preset_page(presets.front(), Style(colors_on_stdout(request.common.color))));
}

}  // namespace gltfx::tool

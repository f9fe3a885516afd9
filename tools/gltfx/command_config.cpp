// SPDX-License-Identifier: Apache-2.0
// `gltfx config`: the settings for a path, and the lines that they come from.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "commands.hpp"
#include "config_import.hpp"
#include "configuration.hpp"
#include "limit_rows.hpp"
#include "read_input.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

std::string reason(const Holding& one) {
  std::string text = fmt::format("{}:{}", printable(one.source->shown), one.value->line);
  if (one.because == nullptr) return text;
  return text + fmt::format(", for {}",
                            gltfx::quoted(fmt::format("{}", fmt::join(one.because->paths, ", "))));
}

void add_values(std::vector<ConfigRow>& rows, const ConfigKey& key, const std::vector<Holding>& all,
                const Style& style) {
  std::string name(key.name);
  if (all.empty()) rows.push_back({name, std::string(key.otherwise), style.dim("default")});
  for (const Holding& one : all) {
    rows.push_back({name, printable(one.value->word), style.dim(reason(one))});
    name.clear();
  }
}

std::string head(const Configuration& configuration, const ConfigRequest& request) {
  std::string text = "configuration: ";
  if (!configuration.file().empty()) {
    text += printable(configuration.file());
  } else {
    text += request.choice.isolated
                ? "none (--isolated)"
                : fmt::format("none: no {} here or in a folder above", kConfigName);
  }
  for (const std::string& base : configuration.bases()) {
    text += fmt::format("\nextends {}", printable(base));
  }
  if (!request.path.empty()) text += fmt::format("\nfor {}", gltfx::quoted(request.path, 200));
  return text + "\n\n";
}

ExitCode import(const std::string& file) {
  const auto text = read_text_file(file, kLongestConfig);
  const auto config = !text                    ? Result<ImportedConfig>(text.error())
                      : looks_like_json(*text) ? auditor_config_as_toml(*text, file)
                                               : khronos_config_as_toml(*text, file);
  if (!config) {
    complain(config.error().message);
    return ExitCode::usage;
  }
  for (const std::string& note : config->notes) complain("note: " + note);
  return print(config->toml);
}

}  // namespace

ExitCode run(const ConfigRequest& request) {
  if (!request.import_file.empty()) return import(request.import_file);
  const auto configuration = Configuration::load(request.choice, std::make_shared<OwnPages>());
  if (!configuration) {
    complain(configuration.error().message);
    return ExitCode::usage;
  }
  const auto overrides = request.path.empty() ? std::vector<std::size_t>()
                                              : configuration->overrides_for(request.path);
  const Style style(colors_on_stdout(request.common.color));
  std::vector<ConfigRow> rows;
  for (const KeyedOption& one : keyed_options()) {
    const ConfigKey& key = one.option.key;
    const auto limits =
        key.form == ConfigForm::limits ? configuration->limits(overrides) : std::vector<Limit>();
    if (limits.empty()) add_values(rows, key, configuration->holding(key, overrides), style);
    for (const Limit& limit : limits) {
      rows.push_back(limit_row(limit, style.dim(printable(limit.from))));
    }
  }
  return print(head(*configuration, request) + in_columns(rows));
}

}  // namespace gltfx::tool

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
#include "read_input.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

constexpr std::size_t kNameWidth = 22;
constexpr std::size_t kValueWidth = 40;

std::string reason(const Configuration& configuration, const Holding& one) {
  std::string text = fmt::format("{}:{}", printable(configuration.file()), one.value->line);
  if (one.because == nullptr) return text;
  return text + fmt::format(", for {}",
                            gltfx::quoted(fmt::format("{}", fmt::join(one.because->paths, ", "))));
}

std::string row(std::string_view name, std::string_view value, std::string_view why) {
  return fmt::format("{}{}  {}\n", padded(name, kNameWidth), padded(value, kValueWidth), why);
}

std::string rows_of(const Configuration& configuration, const ConfigKey& key,
                    const std::vector<std::size_t>& overrides, const Style& style) {
  const std::vector<Holding> all = configuration.holding(key, overrides);
  if (all.empty()) return row(key.name, key.otherwise, style.dim("default"));
  std::string text;
  for (const Holding& one : all) {
    text += row(text.empty() ? key.name : "", printable(one.value->word),
                style.dim(reason(configuration, one)));
  }
  return text;
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
  if (!request.path.empty()) text += fmt::format("\nfor {}", gltfx::quoted(request.path, 200));
  return text + "\n\n";
}

ExitCode import(const std::string& file) {
  const auto text = read_text_file(file, kLongestConfig);
  const auto config =
      text ? khronos_config_as_toml(*text, file) : Result<ImportedConfig>(text.error());
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
  const auto configuration = Configuration::load(request.choice);
  if (!configuration) {
    complain(configuration.error().message);
    return ExitCode::usage;
  }
  const auto overrides = request.path.empty() ? std::vector<std::size_t>()
                                              : configuration->overrides_for(request.path);
  const Style style(colors_on_stdout(request.common.color));
  std::string text = head(*configuration, request);
  for (const KeyedOption& one : keyed_options()) {
    text += rows_of(*configuration, one.option.key, overrides, style);
  }
  return print(text);
}

}  // namespace gltfx::tool

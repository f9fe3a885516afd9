// SPDX-License-Identifier: Apache-2.0
#include "presets.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "config_limits.hpp"
#include "suggestion.hpp"
#include "toml.hpp"

namespace gltfx::tool {

std::string Preset::origin() const {
  return fmt::format("preset {}, {}, read {}", id, dated, read);
}

Result<Preset> parse_preset(std::string_view id, std::string_view text) {
  const toml::parse_result root = toml::parse(text);
  if (!root) return Error{printable(root.error().description())};
  Preset preset;
  preset.id = id;
  std::string mistakes;
  const auto complain = [&](std::uint32_t line, const std::string& mistake) {
    mistakes += fmt::format("{}:{}: {}\n", id, line, mistake);
    return true;
  };
  const auto member = [&](const char* name) {
    const auto value = root.table()[name].value<std::string>();
    if (!value) complain(1, fmt::format("{} must be a string", name));
    return value.value_or(std::string());
  };
  preset.title = member("title");
  preset.source = member("source");
  preset.dated = member("dated");
  preset.read = member("read");
  preset.evidence = member("evidence");
  const auto from = [origin = preset.origin()](std::uint32_t) { return origin; };
  if (const toml::node* budgets = root.table().get("budgets")) {
    LimitTables(from, complain).read(*budgets, preset.limits);
  } else {
    complain(1, "there is no table budgets");
  }
  if (!mistakes.empty()) return Error{std::move(mistakes)};
  return preset;
}

Result<Preset> read_preset(std::string_view id) {
  const auto all = embedded_presets();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const EmbeddedPreset& one) { return one.id == id; });
  if (found != all.end()) return parse_preset(id, found->text);
  std::vector<std::string_view> ids;
  for (const EmbeddedPreset& one : all) ids.push_back(one.id);
  return Error{fmt::format("there is no preset {}; 'gltfx presets' lists them.{}",
                           gltfx::quoted(id), suggestion(id, ids))};
}

}  // namespace gltfx::tool

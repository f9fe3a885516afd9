// SPDX-License-Identifier: Apache-2.0
#include "limit_rows.hpp"

#include <fmt/format.h>

#include "measure/limit.hpp"
#include "terminal.hpp"

namespace gltfx::tool {
namespace {

constexpr std::size_t kNameWidth = 22;
constexpr std::size_t kValueWidth = 40;

}  // namespace

std::string config_row(std::string_view name, std::string_view value, std::string_view why) {
  std::string text =
      fmt::format("{}{}  {}", padded(name, kNameWidth), padded(value, kValueWidth), why);
  text.erase(text.find_last_not_of(' ') + 1);
  return text + '\n';
}

std::string limit_row(const Limit& limit, std::string_view why) {
  std::string name = "budgets.";
  if (limit.on != MeasureScope::asset) name.append(measure_scope_name(limit.on)).append(".");
  name.append(limit.measure->name).append(" ");
  std::string value = fmt::format("{} {}", limit_op_name(limit.op), measure::value_words(limit));
  if (limit.severity != Severity::error) {
    value += fmt::format(" ({})", severity_name(limit.severity));
  }
  return config_row(name, value, why);
}

}  // namespace gltfx::tool

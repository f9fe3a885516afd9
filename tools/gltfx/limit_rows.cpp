// SPDX-License-Identifier: Apache-2.0
#include "limit_rows.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "measure/limit.hpp"
#include "terminal.hpp"

namespace gltfx::tool {

std::string in_columns(const std::vector<ConfigRow>& rows) {
  constexpr std::size_t kLongestValue = 40;  // of those that the column makes room for
  std::size_t names = 0, values = 0;
  for (const ConfigRow& row : rows) {
    names = std::max(names, row.name.size());
    values = std::max(values, std::min(row.value.size(), kLongestValue));
  }
  std::string text;
  for (const ConfigRow& row : rows) {
    text += fmt::format("{}  {}  {}", padded(row.name, names), padded(row.value, values), row.why);
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  }
  return text;
}

ConfigRow limit_row(const Limit& limit, std::string why) {
  std::string name = "budgets.";
  if (limit.on != MeasureScope::asset) name.append(measure_scope_name(limit.on)).append(".");
  name.append(limit.measure->name);
  std::string value = fmt::format("{} {}", limit_op_name(limit.op), measure::value_words(limit));
  if (limit.severity != Severity::error) {
    value += fmt::format(" ({})", severity_name(limit.severity));
  }
  return {std::move(name), std::move(value), std::move(why)};
}

}  // namespace gltfx::tool

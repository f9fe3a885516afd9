// SPDX-License-Identifier: Apache-2.0
#include "base/loss_bounds.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/suggestion.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

/// A bound with its unit. A value is written with the unit, or "off".
struct BoundRow {
  std::string_view name;
  std::string_view unit;  ///< empty: a plain number or a fraction
  double factor;          ///< from the unit to the stored value
  std::string_view example;
  std::optional<double> LossBounds::*member;
};

constexpr double kPercent = 0.01;
constexpr std::array<BoundRow, 6> kBounds{{
    {"position", "%", kPercent, "0.01%", &LossBounds::position},
    {"normal", "deg", 1, "0.5deg", &LossBounds::normal},
    {"texcoord", "texel", 1, "0.25texel", &LossBounds::texcoord},
    {"color", "", 1, "0.5/255", &LossBounds::color},
    {"weight", "%", kPercent, "0.05%", &LossBounds::weight},
    {"animation", "%", kPercent, "0.1%", &LossBounds::animation},
}};

std::optional<double> read_all(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto read = read_double(text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value) || value <= 0) {
    return std::nullopt;
  }
  return value;
}

// "0.5" or "0.5/255".
std::optional<double> read_fraction(std::string_view text) {
  const std::size_t slash = text.find('/');
  const auto above = read_all(text.substr(0, slash));
  if (!above || slash == std::string_view::npos) return above;
  const auto below = read_all(text.substr(slash + 1));
  return below ? std::optional(*above / *below) : std::nullopt;
}

std::optional<double> read_value(const BoundRow& row, std::string_view text) {
  if (row.unit.empty()) return read_fraction(text);
  if (!text.ends_with(row.unit)) return std::nullopt;
  text.remove_suffix(row.unit.size());
  const auto value = read_all(text);
  return value ? std::optional(*value * row.factor) : std::nullopt;
}

std::optional<Error> read_bound(std::string_view item, LossBounds& bounds) {
  const std::size_t equals = item.find('=');
  const std::string_view name = item.substr(0, equals);
  for (const BoundRow& row : kBounds) {
    if (row.name != name) continue;
    const std::string_view text =
        equals == std::string_view::npos ? std::string_view() : item.substr(equals + 1);
    const auto value = text == "off" ? std::nullopt : read_value(row, text);
    if (!value && text != "off") {
      return Error{fmt::format("{} is no bound of {}; write {}={} or {}=off", quoted(text), name,
                               name, row.example, name)};
    }
    bounds.*row.member = value;
    return std::nullopt;
  }
  std::vector<std::string_view> names;
  for (const BoundRow& row : kBounds) names.push_back(row.name);
  return Error{fmt::format("{} is no bound of a loss{}", quoted(name), did_you_mean(name, names))};
}

}  // namespace

Result<LossBounds> parse_loss_bounds(std::string_view text) {
  LossBounds bounds;
  while (true) {
    const std::size_t comma = text.find(',');
    if (auto mistake = read_bound(text.substr(0, comma), bounds)) return *std::move(mistake);
    if (comma == std::string_view::npos) return bounds;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace gltfx

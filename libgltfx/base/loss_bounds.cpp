// SPDX-License-Identifier: Apache-2.0
#include "base/loss_bounds.hpp"

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/suggestion.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

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

std::optional<double> read_value(const NamedBound& row, std::string_view text) {
  if (row.unit.empty()) return read_fraction(text);
  if (!text.ends_with(row.unit)) return std::nullopt;
  text.remove_suffix(row.unit.size());
  const auto value = read_all(text);
  return value ? std::optional(*value * row.factor) : std::nullopt;
}

std::optional<Error> read_bound(std::string_view item, std::span<const NamedBound> bounds) {
  const std::size_t equals = item.find('=');
  const std::string_view name = item.substr(0, equals);
  std::vector<std::string_view> names;
  for (const NamedBound& row : bounds) {
    names.push_back(row.name);
    if (row.name != name) continue;
    const std::string_view text =
        equals == std::string_view::npos ? std::string_view() : item.substr(equals + 1);
    const auto value = text == "off" ? std::nullopt : read_value(row, text);
    if (!value && text != "off") {
      return Error{fmt::format("{} is no bound of {}; write {}={} or {}=off", quoted(text), name,
                               name, row.example, name)};
    }
    *row.value = value;
    return std::nullopt;
  }
  return Error{fmt::format("{} is no bound of a loss{}", quoted(name), did_you_mean(name, names))};
}

}  // namespace

std::vector<NamedBound> named_bounds(LossBounds& bounds) {
  constexpr double kPercent = 0.01;
  return {{"position", "%", kPercent, "0.01%", &bounds.position},
          {"normal", "deg", 1, "0.5deg", &bounds.normal},
          {"texcoord", "texel", 1, "0.25texel", &bounds.texcoord},
          {"color", "", 1, "0.5/255", &bounds.color},
          {"weight", "%", kPercent, "0.05%", &bounds.weight},
          {"animation", "%", kPercent, "0.1%", &bounds.animation}};
}

std::optional<Error> read_bounds(std::string_view text, std::span<const NamedBound> bounds) {
  while (true) {
    const std::size_t comma = text.find(',');
    if (auto mistake = read_bound(text.substr(0, comma), bounds)) return mistake;
    if (comma == std::string_view::npos) return std::nullopt;
    text.remove_prefix(comma + 1);
  }
}

Result<LossBounds> parse_loss_bounds(std::string_view text) {
  LossBounds bounds;
  if (auto mistake = read_bounds(text, named_bounds(bounds))) return *std::move(mistake);
  return bounds;
}

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
#include "measure/quantity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/suggestion.hpp"
#include "base/text.hpp"

namespace gltfx::measure {
namespace {

struct QuantityUnit {
  std::string_view name, base;
  double factor = 1;
};

constexpr std::array<QuantityUnit, 20> kQuantityUnits{{
    {"B", "B", 1},
    {"kB", "B", 1e3},
    {"MB", "B", 1e6},
    {"GB", "B", 1e9},
    {"KiB", "B", 1024},
    {"MiB", "B", 1024.0 * 1024},
    {"GiB", "B", 1024.0 * 1024 * 1024},
    {"um", "m", 1e-6},
    {"mm", "m", 1e-3},
    {"cm", "m", 1e-2},
    {"m", "m", 1},
    {"km", "m", 1e3},
    {"ms", "s", 1e-3},
    {"s", "s", 1},
    {"min", "s", 60},
    {"px", "px", 1},
    {"%", "%", 1},
    {"deg", "deg", 1},
    {"px/m", "px/m", 1},
    {"px/cm", "px/m", 100},
}};

std::vector<std::string_view> units_of(std::string_view base) {
  std::vector<std::string_view> names;
  for (const QuantityUnit& unit : kQuantityUnits) {
    if (unit.base == base) names.push_back(unit.name);
  }
  if (names.empty()) names.push_back(base);
  return names;
}

Error wrong_unit(std::string_view text, std::string_view unit, std::string_view wanted) {
  if (wanted.empty()) {
    return {fmt::format("{} has a unit, and the measure has none", gltfx::quoted(text))};
  }
  const auto names = units_of(wanted);
  const std::vector<std::string> all(names.begin(), names.end());
  return {fmt::format("{} is not in {}{}", gltfx::quoted(text), join_or(all),
                      did_you_mean(unit, names))};
}

// "1234567" as "1,234,567".
std::string with_commas(std::string digits) {
  const std::size_t first = digits.starts_with('-') ? 1 : 0;
  for (std::size_t at = digits.size(); at > first + 3;) {
    at -= 3;
    digits.insert(at, 1, ',');
  }
  return digits;
}

constexpr double kWholeNumbers = 9007199254740992.0;  // 2^53: all whole numbers up to it

}  // namespace

Result<double> read_quantity(std::string_view text, std::string_view unit) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = read_double(text.data(), end, value);
  if (error != std::errc() || !std::isfinite(value)) {
    return Error{fmt::format("{} is not a number", gltfx::quoted(text))};
  }
  std::string_view rest(stop, static_cast<std::size_t>(end - stop));
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  if (rest.empty() || rest == unit) return value;
  for (const QuantityUnit& known : kQuantityUnits) {
    if (known.name == rest && known.base == unit) return value * known.factor;
  }
  return wrong_unit(text, rest, unit);
}

std::string number_words(double value) {
  if (std::trunc(value) == value && std::fabs(value) < kWholeNumbers) {
    return with_commas(fmt::format("{:.0f}", value));
  }
  const std::string digits = fmt::format("{:.7g}", value);
  double rounded = value;
  read_double(digits.data(), digits.data() + digits.size(), rounded);
  return number_text(rounded);
}

std::string quantity_words(double value, std::string_view unit) {
  const std::string number = number_words(value);
  if (unit.empty()) return number;
  if (unit == "B") return number + (value == 1 ? " byte" : " bytes");
  if (unit == "bit") return number + (value == 1 ? " bit" : " bits");
  return fmt::format("{} {}", number, unit == "1/s" ? "per second" : unit);
}

}  // namespace gltfx::measure

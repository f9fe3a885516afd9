// SPDX-License-Identifier: Apache-2.0
#include "steps/quantize_values.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <span>

#include "steps/angle.hpp"

namespace gltfx::steps {
namespace {

using model::ComponentType;
using model::ElementType;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kWholeWeight = 65535;

ElementType vector_type(unsigned width) {
  if (width == 2) return ElementType::vec2;
  return width == 3 ? ElementType::vec3 : ElementType::vec4;
}

void append_integer(std::string& bytes, ComponentType type, std::int64_t value) {
  for (unsigned k = 0; k < model::component_size(type); ++k) {
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * k) & 0xFFU);
  }
}

IntegerElements stored(ComponentType type, bool normalized, unsigned width,
                       const std::vector<std::int64_t>& integers) {
  IntegerElements to{{vector_type(width), type, normalized}, {}};
  to.bytes.reserve(integers.size() * model::component_size(type));
  for (const std::int64_t integer : integers) append_integer(to.bytes, type, integer);
  return to;
}

bool are_within(const std::vector<float>& values, float least, float greatest) {
  return std::all_of(values.begin(), values.end(), [&](float value) {
    return value >= least && value <= greatest;  // false for NaN
  });
}

/// Rounds numbers to multiples of 1 / `most`.
struct Rounded {
  std::vector<std::int64_t> integers;
  double error = 0;  ///< greatest

  Rounded(const std::vector<float>& values, double most, double unit = 1) {
    integers.reserve(values.size());
    for (const float value : values) {
      const double scaled = static_cast<double>(value) * most;
      integers.push_back(std::llround(std::min(std::round(scaled / unit) * unit, most)));
      error = std::max(error, std::abs(static_cast<double>(integers.back()) - scaled) / most);
    }
  }
};

// The greatest power of two whose multiples, in 65535ths, keep a bound.
double coarsest_unit(double bound) {
  double unit = 1;
  while (unit < 256 && unit <= bound * UINT16_MAX) unit *= 2;
  return unit;
}

std::optional<IntegerElements> round_directions(const FloatElements& from, double bound,
                                                ComponentType type) {
  const double most = model::value_range(type).most;
  std::vector<std::int64_t> integers;
  integers.reserve(from.values.size());
  for (std::size_t at = 0; at < from.values.size(); at += from.width) {
    model::Vector3 exact{};
    for (std::size_t k = 0; k < 3; ++k) exact[k] = static_cast<double>(from.values[at + k]);
    const model::Vector3 direction = model::unit(exact);
    model::Vector3 rounded{};
    for (std::size_t k = 0; k < 3; ++k) {
      rounded[k] = std::round(direction[k] * most);
      integers.push_back(static_cast<std::int64_t>(rounded[k]));
    }
    if (!(angle_between(direction, rounded) <= bound)) return std::nullopt;
    if (from.width == 4) {
      integers.push_back(
          static_cast<std::int64_t>(static_cast<double>(from.values[at + 3]) * most));
    }
  }
  return stored(type, true, from.width, integers);
}

// The weights of one vertex in 65535ths, by the method of the largest remainder.
bool round_vertex(std::span<const float> exact, double bound, std::span<std::int64_t> to) {
  const double sum = std::accumulate(exact.begin(), exact.end(), 0.0, [](double all, float each) {
    return all + static_cast<double>(each);
  });
  std::fill(to.begin(), to.end(), 0);
  if (sum == 0) return true;
  std::vector<std::pair<double, std::size_t>> remainders;
  std::int64_t given = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double share = static_cast<double>(exact[i]) / sum * kWholeWeight;
    to[i] = static_cast<std::int64_t>(std::floor(share));
    given += to[i];
    if (exact[i] > 0) remainders.emplace_back(static_cast<double>(to[i]) - share, i);
  }
  std::sort(remainders.begin(), remainders.end());
  for (std::size_t i = 0; i < remainders.size() && given < 65535; ++i, ++given) {
    ++to[remainders[i].second];
  }
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double now = static_cast<double>(to[i]) / kWholeWeight;
    if (!(std::abs(now - static_cast<double>(exact[i])) <= bound)) return false;
  }
  return given == 65535;
}

}  // namespace

std::optional<IntegerElements> quantize_directions(const FloatElements& from, double bound) {
  for (std::size_t at = 0; at < from.values.size(); at += from.width) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (!std::isfinite(from.values[at + k])) return std::nullopt;
    }
    if (from.width == 4 && std::abs(from.values[at + 3]) != 1) return std::nullopt;
  }
  for (const ComponentType type : {ComponentType::int8, ComponentType::int16}) {
    if (auto rounded = round_directions(from, bound, type)) return rounded;
  }
  return std::nullopt;
}

// In 16 bits: the turns of several targets add up.
std::optional<IntegerElements> quantize_turns(const FloatElements& from, double bound) {
  if (!are_within(from.values, -1, 1)) return std::nullopt;
  const Rounded rounded(from.values, model::value_range(ComponentType::int16).most);
  if (rounded.error * std::sqrt(3.0) * kDegrees > bound) return std::nullopt;
  return stored(ComponentType::int16, true, from.width, rounded.integers);
}

std::optional<IntegerElements> quantize_texcoords(const FloatElements& from, double bound,
                                                  bool coarse) {
  if (!are_within(from.values, 0, 1)) return std::nullopt;
  const Rounded rounded(from.values, UINT16_MAX, coarse ? coarsest_unit(bound) : 1);
  if (rounded.error > bound) return std::nullopt;
  return stored(ComponentType::uint16, true, from.width, rounded.integers);
}

std::optional<IntegerElements> quantize_colors(const FloatElements& from, double bound,
                                               bool coarse) {
  constexpr double kSame = 1e-6;
  if (!are_within(from.values, 0, 1)) return std::nullopt;
  const Rounded bytes(from.values, model::value_range(ComponentType::uint8).most);
  if (bytes.error <= std::min(kSame, bound)) {
    return stored(ComponentType::uint8, true, from.width, bytes.integers);
  }
  const Rounded rounded(from.values, UINT16_MAX, coarse ? coarsest_unit(bound) : 1);
  if (rounded.error > bound) return std::nullopt;
  return stored(ComponentType::uint16, true, from.width, rounded.integers);
}

std::optional<std::vector<IntegerElements>> quantize_weights(const std::vector<FloatElements>& sets,
                                                             double bound) {
  const std::size_t size = sets.front().values.size();
  std::vector<std::vector<std::int64_t>> integers(sets.size());
  std::vector<float> exact;
  std::vector<std::int64_t> now;
  for (std::size_t at = 0; at < size; at += 4) {
    exact.clear();
    for (const FloatElements& set : sets) {
      exact.insert(exact.end(), set.values.begin() + static_cast<std::ptrdiff_t>(at),
                   set.values.begin() + static_cast<std::ptrdiff_t>(at + 4));
    }
    now.resize(exact.size());
    if (!are_within(exact, 0, 1) || !round_vertex(exact, bound, now)) return std::nullopt;
    for (std::size_t i = 0; i < now.size(); ++i) integers[i / 4].push_back(now[i]);
  }
  std::vector<IntegerElements> all;
  for (const auto& set : integers) all.push_back(stored(ComponentType::uint16, true, 4, set));
  return all;
}

std::optional<IntegerElements> quantize_positions(const FloatElements& from, const Grid& grid) {
  std::vector<std::int64_t> integers;
  integers.reserve(from.values.size());
  double greatest = 0;
  for (std::size_t i = 0; i < from.values.size(); ++i) {
    const double point =
        std::round((static_cast<double>(from.values[i]) - grid.origin[i % 3]) / grid.step);
    if (!(point >= 0 && point <= UINT16_MAX)) return std::nullopt;
    greatest = std::max(greatest, point);
    integers.push_back(static_cast<std::int64_t>(point));
  }
  const bool small = greatest <= UINT8_MAX;
  return stored(small ? ComponentType::uint8 : ComponentType::uint16, false, 3, integers);
}

std::optional<IntegerElements> quantize_moves(const FloatElements& from, double step) {
  std::vector<std::int64_t> integers;
  integers.reserve(from.values.size());
  double greatest = 0;
  for (const float value : from.values) {
    const double steps = std::round(static_cast<double>(value) / step);
    if (!(std::abs(steps) <= INT16_MAX)) return std::nullopt;
    greatest = std::max(greatest, std::abs(steps));
    integers.push_back(static_cast<std::int64_t>(steps));
  }
  const bool small = greatest <= INT8_MAX;
  return stored(small ? ComponentType::int8 : ComponentType::int16, false, 3, integers);
}

}  // namespace gltfx::steps

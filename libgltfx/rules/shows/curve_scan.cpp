// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/curve_scan.hpp"

#include <cmath>

#include "base/lanes.hpp"

namespace gltfx::validate {
namespace {

// The sums of each pair of lanes: two of `a`, then two of `b`.
Lanes pair_sums(const Lanes& a, const Lanes& b) {
  return __builtin_shufflevector(a, b, 0, 2, 4, 6) + __builtin_shufflevector(a, b, 1, 3, 5, 7);
}

bool any_of(const IntLanes& found) { return (found[0] | found[1] | found[2] | found[3]) != 0; }

}  // namespace

bool has_right_angle(const float* vectors, std::size_t count, float limit) {
  if (count < 2) return false;
  const Lanes most{limit, limit, limit, limit};
  IntLanes found{};
  std::size_t i = 0;
  Lanes first = load_lanes(vectors);
  const auto product = [&](std::size_t next) {
    const Lanes second = load_lanes(vectors + next * kLanes);
    const Lanes products = first * second;
    first = second;
    return products;
  };
  for (; i + kLanes < count; i += kLanes) {
    const Lanes a = product(i + 1);
    const Lanes b = product(i + 2);
    const Lanes c = product(i + 3);
    const Lanes d = product(i + 4);
    const Lanes along = pair_sums(pair_sums(a, b), pair_sums(c, d));
    found |= (along < most) & (along > -most);
  }
  bool in_rest = false;
  for (; i + 1 < count; ++i) in_rest |= std::abs(sum_of(product(i + 1))) < limit;
  return in_rest || any_of(found);
}

bool has_sign_change(const float* vectors, std::size_t count) {
  if (count < 2) return false;
  constexpr std::size_t kApart = 3;
  const std::size_t numbers = (count - 1) * kApart;
  IntLanes found{};
  std::size_t i = 0;
  for (; i + kLanes <= numbers; i += kLanes) {
    found |= load_lanes(vectors + i) * load_lanes(vectors + i + kApart) < Lanes{};
  }
  bool in_rest = false;
  for (; i < numbers; ++i) in_rest |= vectors[i] * vectors[i + kApart] < 0;
  return in_rest || any_of(found);
}

}  // namespace gltfx::validate

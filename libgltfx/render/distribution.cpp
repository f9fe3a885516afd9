// SPDX-License-Identifier: Apache-2.0
#include "render/distribution.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace gltfx::render {
namespace {

constexpr float kBelowOne = 0x1.fffffep-1F;
constexpr std::size_t kMostParts = 128;  // of a list: tables stay in the cache

double sum_of(std::span<const float> weights) {
  double sum = 0;
  for (const float weight : weights) sum += static_cast<double>(weight);
  return sum;
}

bool are_alike(std::span<const float> weights, float most) {
  const auto [least, greatest] = std::minmax_element(weights.begin(), weights.end());
  return *greatest <= *least * most;
}

}  // namespace

void PiecewiseConstant2d::Lists::add(std::span<const float> weights, float alike) {
  count = weights.size();
  parts = std::min(std::bit_ceil(count), kMostParts);
  const double total = sum_of(weights);
  const double even = 1.0 / static_cast<double>(count);
  const std::size_t first = sums.size();
  double sum = 0;
  sums.push_back(0);
  for (const float weight : weights) {
    sum += total > 0 ? static_cast<double>(weight) / total : even;
    sums.push_back(std::min(static_cast<float>(sum), 1.0F));
  }
  sums.back() = 1;
  std::vector<float> probabilities(count);
  for (std::size_t i = 0; i < count; ++i) probabilities[i] = sums[first + i + 1] - sums[first + i];
  add_bounds(probabilities, alike);
}

void PiecewiseConstant2d::Lists::add_bounds(std::span<const float> probabilities, float alike) {
  const std::size_t list = bounds.size() / (parts + 1);
  float begin = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    const float next = static_cast<float>(part + 1) / static_cast<float>(parts);
    const float end = part + 1 < parts ? std::max(search(list, next).coordinate, begin) : 1.0F;
    const std::size_t cell = cell_of(begin);
    const bool even =
        begin < end && are_alike(probabilities.subspan(cell, cell_of(end) - cell + 1), alike);
    bounds.push_back(even ? begin : -begin);
    begin = end;
  }
  bounds.push_back(1);
}

std::size_t PiecewiseConstant2d::Lists::cell_of(float coordinate) const {
  const float scaled = std::max(coordinate, 0.0F) * static_cast<float>(count);
  return std::min(static_cast<std::size_t>(static_cast<std::int64_t>(scaled)), count - 1);
}

// The last sum is 1 and `random` is below: the cell has width.
PiecewiseConstant2d::Choice PiecewiseConstant2d::Lists::search(std::size_t list,
                                                               float random) const {
  const float* first = sums.data() + list * (count + 1);
  const float* after = std::upper_bound(first, first + count, random);
  const float probability = after[0] - after[-1];
  const auto cells = static_cast<float>(count);
  const float place = static_cast<float>(after - first - 1) + (random - after[-1]) / probability;
  return {std::min(place / cells, kBelowOne), 1 / (probability * cells)};
}

PiecewiseConstant2d::Choice PiecewiseConstant2d::Lists::choose(std::size_t list,
                                                               float random) const {
  random = std::min(random, kBelowOne);
  const float scaled = random * static_cast<float>(parts);
  const auto part = static_cast<std::int32_t>(scaled);
  const float* bound = bounds.data() + list * (parts + 1) + part;
  if (std::signbit(bound[0])) return search(list, random);
  const float width = std::fabs(bound[1]) - bound[0];
  return {std::min(bound[0] + (scaled - static_cast<float>(part)) * width, kBelowOne),
          width * static_cast<float>(parts)};
}

// Bisection without unpredictable branches.
float PiecewiseConstant2d::Lists::spread(std::size_t list, float coordinate) const {
  const float* bound = bounds.data() + list * (parts + 1);
  for (std::size_t step = parts / 2; step > 0; step /= 2) {
    bound += std::fabs(bound[step]) <= coordinate ? step : 0;
  }
  if (!std::signbit(bound[0])) {
    return (std::fabs(bound[1]) - bound[0]) * static_cast<float>(parts);
  }
  const float* sum = sums.data() + list * (count + 1) + cell_of(coordinate);
  return 1 / ((sum[1] - sum[0]) * static_cast<float>(count));
}

PiecewiseConstant2d::PiecewiseConstant2d(std::size_t width, std::span<const float> weights,
                                         float alike) {
  std::vector<float> totals;
  for (std::size_t first = 0; first < weights.size(); first += width) {
    const auto row = weights.subspan(first, width);
    cells_.add(row, alike);
    totals.push_back(static_cast<float>(std::min(sum_of(row), 3e38)));
  }
  rows_.add(totals, alike);
}

PiecewiseConstant2d::Sample PiecewiseConstant2d::sample(const Float2& random) const {
  const Choice y = rows_.choose(0, random[1]);
  const Choice x = cells_.choose(rows_.cell_of(y.coordinate), random[0]);
  return {{x.coordinate, y.coordinate},
          1 / (static_cast<double>(x.spread) * static_cast<double>(y.spread))};
}

// Cells of infinite spread are never sampled.
double PiecewiseConstant2d::density(const Float2& point) const {
  const float y = rows_.spread(0, point[1]);
  const float x = cells_.spread(rows_.cell_of(point[1]), point[0]);
  return 1 / (static_cast<double>(x) * static_cast<double>(y));
}

}  // namespace gltfx::render

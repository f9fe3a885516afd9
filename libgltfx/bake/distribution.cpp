// SPDX-License-Identifier: Apache-2.0
#include "bake/distribution.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace gltfx::bake {
namespace {

constexpr float kBelowOne = 0x1.fffffep-1F;

double sum_of(std::span<const float> weights) {
  double sum = 0;
  for (const float weight : weights) sum += static_cast<double>(weight);
  return sum;
}

}  // namespace

void GridDistribution::Quantiles::add(std::span<const float> weights) {
  parts = std::bit_ceil(weights.size());
  const double total = sum_of(weights);
  const double even = 1.0 / static_cast<double>(weights.size());
  const auto probability = [&](std::size_t cell) {
    return total > 0 ? static_cast<double>(weights[cell]) / total : even;
  };
  std::size_t cell = 0;
  double sum = 0;  // of the cells before
  float last = 0;
  bounds.push_back(0);
  for (std::size_t part = 1; part < parts; ++part) {
    const double wanted = static_cast<double>(part) / static_cast<double>(parts);
    while (cell + 1 < weights.size() && sum + probability(cell) <= wanted) {
      sum += probability(cell++);
    }
    const double own = probability(cell);
    const double within = own > 0 ? std::clamp((wanted - sum) / own, 0.0, 1.0) : 0;
    const auto bound = static_cast<float>((static_cast<double>(cell) + within) * even);
    last = std::max(std::nextafter(last, 2.0F), std::min(bound, kBelowOne));
    bounds.push_back(last);
  }
  bounds.push_back(std::max(std::nextafter(last, 2.0F), 1.0F));
}

// By halves, without a branch that nobody can foresee.
const float* GridDistribution::Quantiles::before(std::size_t number, float coordinate) const {
  const float* bound = list(number);
  for (std::size_t step = parts / 2; step > 0; step /= 2) {
    bound += bound[step] <= coordinate ? step : 0;
  }
  return bound;
}

GridDistribution::Choice GridDistribution::choose(const Quantiles& quantiles, std::size_t list,
                                                  float random) {
  const float scaled = std::min(random, kBelowOne) * static_cast<float>(quantiles.parts);
  const auto part = static_cast<std::int32_t>(scaled);
  const float* bound = quantiles.list(list) + part;
  const float width = bound[1] - bound[0];
  return {std::min(bound[0] + (scaled - static_cast<float>(part)) * width, kBelowOne), width};
}

GridDistribution::GridDistribution(std::size_t width, std::span<const float> weights)
    : height_(weights.size() / width) {
  std::vector<float> totals;
  cells_.bounds.reserve(height_ * (std::bit_ceil(width) + 1));
  for (std::size_t first = 0; first < weights.size(); first += width) {
    const auto row = weights.subspan(first, width);
    cells_.add(row);
    totals.push_back(static_cast<float>(std::min(sum_of(row), 3e38)));
  }
  rows_.add(totals);
}

std::size_t GridDistribution::row_of(float coordinate) const {
  const float scaled = std::max(coordinate, 0.0F) * static_cast<float>(height_);
  return std::min(static_cast<std::size_t>(static_cast<std::int64_t>(scaled)), height_ - 1);
}

GridDistribution::Sample GridDistribution::sample(const Float2& random) const {
  const Choice y = choose(rows_, 0, random[1]);
  const Choice x = choose(cells_, row_of(y.coordinate), random[0]);
  const auto parts = static_cast<double>(rows_.parts * cells_.parts);
  const double area = static_cast<double>(y.width) * static_cast<double>(x.width);
  return {{x.coordinate, y.coordinate}, 1 / (area * parts)};
}

double GridDistribution::density(const Float2& point) const {
  const float* y = rows_.before(0, point[1]);
  const float* x = cells_.before(row_of(point[1]), point[0]);
  const auto parts = static_cast<double>(rows_.parts * cells_.parts);
  return 1 / (static_cast<double>(y[1] - y[0]) * static_cast<double>(x[1] - x[0]) * parts);
}

}  // namespace gltfx::bake

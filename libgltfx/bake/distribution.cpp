// SPDX-License-Identifier: Apache-2.0
#include "bake/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace gltfx::bake {
namespace {

constexpr float kBelowOne = 0x1.fffffep-1F;

// Turns weights into running sums that end in 1 and gives their total.
double accumulate(std::span<float> weights) {
  double total = 0;
  for (const float weight : weights) total += weight;
  const double even = 1.0 / static_cast<double>(weights.size());
  double sum = 0;
  for (float& weight : weights) {
    sum += total > 0 ? weight / total : even;
    weight = static_cast<float>(sum);
  }
  weights.back() = 1;
  return total;
}

struct Choice {
  std::size_t index = 0;
  float within = 0;  // where between the sums before and after
};

Choice choose(std::span<const float> sums, float random) {
  const auto found = std::upper_bound(sums.begin(), sums.end() - 1, random);
  const auto index = static_cast<std::size_t>(found - sums.begin());
  const float before = index > 0 ? sums[index - 1] : 0.0F;
  const float width = sums[index] - before;
  return {index, width > 0 ? std::min((random - before) / width, kBelowOne) : 0.5F};
}

float probability(std::span<const float> sums, std::size_t index) {
  return sums[index] - (index > 0 ? sums[index - 1] : 0.0F);
}

std::size_t cell_of(float coordinate, std::size_t count) {
  const auto scaled =
      static_cast<std::size_t>(std::max(coordinate, 0.0F) * static_cast<float>(count));
  return std::min(scaled, count - 1);
}

}  // namespace

GridDistribution::GridDistribution(std::size_t width, std::vector<float> weights)
    : width_(width), cells_(std::move(weights)) {
  const std::size_t height = cells_.size() / width_;
  for (std::size_t row = 0; row < height; ++row) {
    rows_.push_back(
        static_cast<float>(accumulate(std::span(cells_).subspan(row * width_, width_))));
  }
  accumulate(rows_);
}

Float2 GridDistribution::sample(const Float2& random) const {
  const Choice row = choose(rows_, random[1]);
  const Choice cell = choose(std::span(cells_).subspan(row.index * width_, width_), random[0]);
  return {(static_cast<float>(cell.index) + cell.within) / static_cast<float>(width_),
          (static_cast<float>(row.index) + row.within) / static_cast<float>(rows_.size())};
}

double GridDistribution::density(const Float2& point) const {
  const std::size_t row = cell_of(point[1], rows_.size());
  const std::size_t cell = cell_of(point[0], width_);
  const auto cells = std::span(cells_).subspan(row * width_, width_);
  return static_cast<double>(probability(rows_, row)) * probability(cells, cell) *
         static_cast<double>(cells_.size());
}

}  // namespace gltfx::bake

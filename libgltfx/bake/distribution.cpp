// SPDX-License-Identifier: Apache-2.0
#include "bake/distribution.hpp"

#include <algorithm>
#include <utility>

namespace gltfx::bake {
namespace {

constexpr float kBelowOne = 0x1.fffffep-1F;

std::size_t cell_of(float coordinate, std::size_t count) {
  const auto scaled =
      static_cast<std::size_t>(std::max(coordinate, 0.0F) * static_cast<float>(count));
  return std::min(scaled, count - 1);
}

}  // namespace

// One more list of weights. The guide says for each of as many equal parts of [0, 1) at which step
// it begins.
void GridDistribution::Steps::add(std::span<const float> weights) {
  double total = 0;
  for (const float weight : weights) total += static_cast<double>(weight);
  const double even = 1.0 / static_cast<double>(weights.size());
  double sum = 0;
  for (const float weight : weights) {
    sum += total > 0 ? static_cast<double>(weight) / total : even;
    sums.push_back(static_cast<float>(sum));
  }
  sums.back() = 1;
  const float* own = sums.data() + sums.size() - weights.size();
  std::uint32_t step = 0;
  for (std::size_t part = 0; part < weights.size(); ++part) {
    const float begin = static_cast<float>(part) / static_cast<float>(weights.size());
    while (step + 1 < weights.size() && own[step] <= begin) ++step;
    guide.push_back(step);
  }
}

GridDistribution::Choice GridDistribution::choose(const Steps& steps, std::size_t first,
                                                  std::size_t count, float random) {
  const float* sums = steps.sums.data() + first;
  std::size_t index = steps.guide[first + cell_of(random, count)];
  while (index + 1 < count && sums[index] <= random) ++index;
  while (index > 0 && sums[index - 1] > random) --index;  // where a part was rounded
  const float before = index > 0 ? sums[index - 1] : 0.0F;
  const float width = sums[index] - before;
  return {index, width > 0 ? std::clamp((random - before) / width, 0.0F, kBelowOne) : 0.5F};
}

float GridDistribution::probability(const Steps& steps, std::size_t first, std::size_t index) {
  return steps.sums[first + index] - (index > 0 ? steps.sums[first + index - 1] : 0.0F);
}

GridDistribution::GridDistribution(std::size_t width, std::vector<float> weights) : width_(width) {
  std::vector<float> totals;
  for (std::size_t first = 0; first < weights.size(); first += width_) {
    const auto row = std::span<const float>(weights).subspan(first, width_);
    cells_.add(row);
    double total = 0;
    for (const float weight : row) total += static_cast<double>(weight);
    totals.push_back(static_cast<float>(total));
  }
  rows_.add(totals);
}

Float2 GridDistribution::sample(const Float2& random) const {
  const std::size_t height = rows_.sums.size();
  const Choice row = choose(rows_, 0, height, random[1]);
  const Choice cell = choose(cells_, row.index * width_, width_, random[0]);
  return {(static_cast<float>(cell.index) + cell.within) / static_cast<float>(width_),
          (static_cast<float>(row.index) + row.within) / static_cast<float>(height)};
}

double GridDistribution::density(const Float2& point) const {
  const std::size_t row = cell_of(point[1], rows_.sums.size());
  const std::size_t cell = cell_of(point[0], width_);
  return static_cast<double>(probability(rows_, 0, row)) *
         static_cast<double>(probability(cells_, row * width_, cell)) *
         static_cast<double>(cells_.sums.size());
}

}  // namespace gltfx::bake

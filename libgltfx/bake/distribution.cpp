// SPDX-License-Identifier: Apache-2.0
#include "bake/distribution.hpp"

#include <algorithm>

namespace gltfx::bake {
namespace {

constexpr float kBelowOne = 0x1.fffffep-1F;

double sum_of(std::span<const float> weights) {
  double sum = 0;
  for (const float weight : weights) sum += static_cast<double>(weight);
  return sum;
}

std::size_t cell_of(float coordinate, std::size_t count) {
  const auto scaled =
      static_cast<std::int64_t>(std::max(coordinate, 0.0F) * static_cast<float>(count));
  return std::min(static_cast<std::size_t>(scaled), count - 1);
}

}  // namespace

// The guide says for each of as many equal parts of [0, 1) at which step it begins, or a little
// before: where a part begins is a matter of rounding.
void GridDistribution::Steps::add(std::span<const float> weights) {
  count = weights.size();
  const std::size_t first = sums.size();
  const double total = sum_of(weights);
  const double even = 1.0 / static_cast<double>(count);
  double sum = 0;
  sums.push_back(0);
  for (const float weight : weights) {
    sum += total > 0 ? static_cast<double>(weight) / total : even;
    sums.push_back(std::min(static_cast<float>(sum), 1.0F));
  }
  sums.back() = 1;
  const float* own = sums.data() + first;
  std::uint32_t step = 0;
  for (std::size_t part = 0; part < count; ++part) {
    const double begin = (static_cast<double>(part) - 0x1p-20) / static_cast<double>(count);
    while (static_cast<double>(own[step + 1]) <= begin) ++step;
    guide.push_back(step);
  }
}

float GridDistribution::Steps::probability(std::size_t list, std::size_t index) const {
  const float* own = sums.data() + list * (count + 1);
  return own[index + 1] - own[index];
}

// The last sum is 1 and `random` below: every search ends, and never at a step without width. Most
// take one step or none, which is not left to a branch that nobody can foresee.
GridDistribution::Choice GridDistribution::choose(const Steps& steps, std::size_t list,
                                                  float random) {
  random = std::min(random, kBelowOne);
  const float* sums = steps.sums.data() + list * (steps.count + 1);
  std::size_t index = steps.guide[list * steps.count + cell_of(random, steps.count)];
  index += static_cast<std::size_t>(sums[index + 1] <= random);
  while (sums[index + 1] <= random) ++index;
  const float probability = sums[index + 1] - sums[index];
  return {index, std::min((random - sums[index]) / probability, kBelowOne), probability};
}

GridDistribution::GridDistribution(std::size_t width, std::span<const float> weights)
    : width_(width) {
  std::vector<float> totals;
  for (std::size_t first = 0; first < weights.size(); first += width_) {
    const auto row = weights.subspan(first, width_);
    cells_.add(row);
    totals.push_back(static_cast<float>(std::min(sum_of(row), 3e38)));
  }
  rows_.add(totals);
}

GridDistribution::Sample GridDistribution::sample(const Float2& random) const {
  const Choice row = choose(rows_, 0, random[1]);
  const Choice cell = choose(cells_, row.index, random[0]);
  const auto width = static_cast<float>(width_);
  const auto height = static_cast<float>(rows_.count);
  return {{(static_cast<float>(cell.index) + cell.within) / width,
           (static_cast<float>(row.index) + row.within) / height},
          static_cast<double>(row.probability * cell.probability * (width * height))};
}

double GridDistribution::density(const Float2& point) const {
  const std::size_t row = cell_of(point[1], rows_.count);
  const std::size_t cell = cell_of(point[0], width_);
  return static_cast<double>(rows_.probability(0, row)) *
         static_cast<double>(cells_.probability(row, cell)) *
         (static_cast<double>(width_) * static_cast<double>(rows_.count));
}

}  // namespace gltfx::bake

// SPDX-License-Identifier: Apache-2.0
#include "measure/texel_mask.hpp"

#include <algorithm>
#include <cmath>

namespace gltfx::measure {
namespace {

constexpr double kTouch = 1.0 / 256;      // that far inside of a texel nothing is covered
constexpr double kFarthest = 1LL << 40U;  // coordinates beyond are clamped

// An index in [0, size) for any index.
std::int64_t wrapped(std::int64_t index, std::int64_t size, model::Wrap wrap) {
  if (wrap == model::Wrap::clamp_to_edge) return std::clamp<std::int64_t>(index, 0, size - 1);
  const std::int64_t period = wrap == model::Wrap::repeat ? size : 2 * size;
  const std::int64_t rest = (index % period + period) % period;
  return rest < size ? rest : period - 1 - rest;
}

struct Interval {
  double least = INFINITY, most = -INFINITY;

  void include(double value) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  // The texels whose inner part it meets: from the first one to that before `end`.
  std::int64_t first() const {
    return static_cast<std::int64_t>(std::floor(least - 1 + kTouch)) + 1;
  }
  std::int64_t end() const { return static_cast<std::int64_t>(std::ceil(most - kTouch)); }
};

// What the part of a triangle between two rows covers horizontally.
Interval part_between(const std::array<TexelPoint, 3>& triangle, double top, double bottom) {
  Interval part;
  for (std::size_t i = 0; i < 3; ++i) {
    TexelPoint from = triangle[i];
    TexelPoint to = triangle[(i + 1) % 3];
    if (from[1] > to[1]) std::swap(from, to);
    if (to[1] < top || from[1] > bottom) continue;
    const double slope = to[1] > from[1] ? (to[0] - from[0]) / (to[1] - from[1]) : 0;
    part.include(from[1] >= top ? from[0] : from[0] + slope * (top - from[1]));
    part.include(to[1] <= bottom ? to[0] : from[0] + slope * (bottom - from[1]));
  }
  return part;
}

}  // namespace

TexelMask::TexelMask(std::uint32_t width, std::uint32_t height, const model::Sampler& sampler)
    : width_(width),
      height_(height),
      wrap_s_(sampler.wrap_s),
      wrap_t_(sampler.wrap_t),
      uncovered_(std::uint64_t{width} * height) {
  words_.resize(static_cast<std::size_t>((uncovered_ + 63) / 64));
  constexpr std::int64_t kFewSteps = 1 << 22U;
  most_steps_ = kFewSteps + 4 * static_cast<std::int64_t>(uncovered_);
}

// `row` is in the image.
void TexelMask::mark(std::uint64_t row, std::uint64_t begin, std::uint64_t end) {
  const auto width = static_cast<std::uint64_t>(width_);
  const std::uint64_t last = row * width + end;
  for (std::uint64_t at = row * width + begin; at < last;) {
    const std::uint64_t stop = std::min(last, (at / 64 + 1) * 64);
    const std::uint64_t ones = ~std::uint64_t{0} >> (64 - (stop - at));
    std::uint64_t& word = words_[static_cast<std::size_t>(at / 64)];
    const std::uint64_t fresh = ones << at % 64 & ~word;
    word |= fresh;
    uncovered_ -= static_cast<unsigned>(std::popcount(fresh));
    at = stop;
    ++steps_;
  }
}

// `row` and the columns are unwrapped.
void TexelMask::cover_span(std::int64_t row, std::int64_t begin, std::int64_t end) {
  const auto in_image = static_cast<std::uint64_t>(wrapped(row, height_, wrap_t_));
  if (wrap_s_ == model::Wrap::clamp_to_edge) {
    begin = std::clamp<std::int64_t>(begin, 0, width_ - 1);
    end = std::clamp<std::int64_t>(end, begin + 1, width_);
  } else if (end - begin >= 2 * width_) {
    begin = 0;
    end = width_;
  }
  while (begin < end) {  // one piece for each tile of the texture
    const std::int64_t tile = (begin - (begin < 0 ? width_ - 1 : 0)) / width_;
    const std::int64_t stop = std::min(end, (tile + 1) * width_);
    const std::int64_t first = begin - tile * width_;
    const std::int64_t count = stop - begin;
    const bool mirrored = wrap_s_ == model::Wrap::mirrored_repeat && tile % 2 != 0;
    const std::int64_t from = mirrored ? width_ - first - count : first;
    mark(in_image, static_cast<std::uint64_t>(from), static_cast<std::uint64_t>(from + count));
    begin = stop;
  }
}

bool TexelMask::cover(const std::array<TexelPoint, 3>& corners) {
  if (uncovered_ == 0) return true;
  constexpr std::int64_t kStepsEach = 64;
  most_steps_ += kStepsEach;
  std::array<TexelPoint, 3> triangle = corners;
  Interval rows;
  TexelPoint centre{};
  for (TexelPoint& corner : triangle) {
    for (double& value : corner) value = std::clamp(value, -kFarthest, kFarthest);
    rows.include(corner[1]);
    for (std::size_t k = 0; k < 2; ++k) centre[k] += corner[k] / 3;
  }
  const auto column = static_cast<std::int64_t>(std::floor(centre[0]));
  cover_span(static_cast<std::int64_t>(std::floor(centre[1])), column, column + 1);
  for (std::int64_t row = rows.first(); row < rows.end(); ++row) {
    if (uncovered_ == 0) return true;
    if (++steps_ > most_steps_) return false;
    const auto top = static_cast<double>(row);
    const Interval part = part_between(triangle, top + kTouch, top + 1 - kTouch);
    if (part.least <= part.most && part.first() < part.end())
      cover_span(row, part.first(), part.end());
  }
  return steps_ <= most_steps_;
}

}  // namespace gltfx::measure

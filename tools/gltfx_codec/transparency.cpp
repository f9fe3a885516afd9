// SPDX-License-Identifier: Apache-2.0
#include "transparency.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "resample.hpp"

namespace gltfx::codec {
namespace {

// Numbers from 0 to 1 that differ much between neighbouring texels: the sequence R2 of M. Roberts
// ("The unreasonable effectiveness of quasirandom sequences", 2018) over both coordinates.
double spread(std::size_t x, std::size_t y) {
  const double sum =
      static_cast<double>(x) * 0.7548776662466927 + static_cast<double>(y) * 0.5698402909980532;
  return sum - std::floor(sum);
}

std::array<std::size_t, 8> neighbors(const AlphaTexels& texels, std::size_t texel,
                                     const Resize& how) {
  const auto x = static_cast<std::int64_t>(texel % texels.width);
  const auto y = static_cast<std::int64_t>(texel / texels.width);
  std::array<std::size_t, 8> found{};
  std::size_t count = 0;
  for (std::int64_t dy = -1; dy <= 1; ++dy) {
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      if (dx == 0 && dy == 0) continue;
      found[count++] = std::size_t{wrapped(y + dy, texels.height, how.wrap_v)} * texels.width +
                       wrapped(x + dx, texels.width, how.wrap_u);
    }
  }
  return found;
}

// Takes the mean colour of known neighbours.
void take_color(const AlphaTexels& texels, std::size_t texel, const std::vector<bool>& unknown,
                const Resize& how) {
  std::array<float, 3> sum{};
  float count = 0;
  for (const std::size_t each : neighbors(texels, texel, how)) {
    if (unknown[each]) continue;
    ++count;
    for (unsigned c = 0; c + 1 < texels.channels; ++c) {
      sum[c] += texels.values[each * texels.channels + c];
    }
  }
  for (unsigned c = 0; c + 1 < texels.channels; ++c) {
    texels.values[texel * texels.channels + c] = sum[c] / count;
  }
}

}  // namespace

void keep_coverage(const AlphaTexels& texels, double share, const Cutoff& cutoff) {
  const auto showing = static_cast<std::size_t>(
      std::llround(std::clamp(share, 0.0, 1.0) * static_cast<double>(texels.count())));
  std::vector<std::size_t> order(texels.count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto before = [&](std::size_t a, std::size_t b) {
    if (texels.alpha(a) != texels.alpha(b)) return texels.alpha(a) > texels.alpha(b);
    const double of_a = spread(a % texels.width, a / texels.width);
    const double of_b = spread(b % texels.width, b / texels.width);
    return of_a != of_b ? of_a < of_b : a < b;
  };
  const auto last = order.begin() + static_cast<std::ptrdiff_t>(showing);
  if (showing < order.size()) std::nth_element(order.begin(), last, order.end(), before);
  float least = 1;
  for (auto each = order.begin(); each != last; ++each) {
    least = std::min(least, texels.alpha(*each));
  }
  const float scale = showing > 0 && least > 0 ? cutoff.value / least : 1;
  for (auto each = order.begin(); each != order.end(); ++each) {
    const float alpha = std::min(texels.alpha(*each) * scale, 1.0F);
    texels.alpha(*each) =
        each < last ? std::max(alpha, cutoff.shows) : std::min(alpha, cutoff.fails);
  }
}

void fill_colors(const AlphaTexels& texels, std::vector<bool> unknown, const Resize& how) {
  std::vector<bool> queued = unknown;
  queued.flip();
  std::vector<std::size_t> layer;
  for (std::size_t i = 0; i < texels.count(); ++i) {
    if (!unknown[i]) continue;
    const auto near = neighbors(texels, i, how);
    if (std::all_of(near.begin(), near.end(), [&](auto each) { return unknown[each]; })) continue;
    queued[i] = true;
    layer.push_back(i);
  }
  while (!layer.empty()) {
    for (const std::size_t each : layer) take_color(texels, each, unknown, how);
    std::vector<std::size_t> next;
    for (const std::size_t each : layer) {
      unknown[each] = false;
      for (const std::size_t other : neighbors(texels, each, how)) {
        if (queued[other]) continue;
        queued[other] = true;
        next.push_back(other);
      }
    }
    layer = std::move(next);
  }
}

}  // namespace gltfx::codec

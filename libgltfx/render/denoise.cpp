// SPDX-License-Identifier: Apache-2.0
#include "render/denoise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

#include "base/packed.hpp"
#include "base/parallel.hpp"
#include "render/regression.hpp"

namespace gltfx::render {
namespace {

constexpr int kFilterWidth = 16;  // of a tile
constexpr int kFilterHeight = 8;
constexpr int kReach = kNeighbours;
constexpr int kMargin = kReach + kPatch;
constexpr int kWidth = kFilterWidth + 2 * kMargin;
constexpr int kHeight = kFilterHeight + 2 * kMargin;
constexpr int kPatchRowWidth = kFilterWidth + 2 * kPatch;
constexpr int kPatchRows = kFilterHeight + 2 * kPatch;
constexpr int kOffsets = (2 * kReach + 1) * (2 * kReach + 1);
constexpr std::size_t kPatchWidth = std::size_t{2} * kPatch + 1;
// k^2 of non-local means. Against pictures of many samples, 0.4 is 0.1 dB better than 0.25 in the
// mean of the figures.
constexpr float kDamping = 0.4F;
constexpr float kRidge = 1e-4F;

using Row = std::array<float, kFilterWidth>;

// A kernel as exp(-x), but with a longer tail: a pixel unlike all others still has neighbours.
inline float kernel(float x) {
  float t = 1 / (1 + x * (1.0F / 8.0F));
  t *= t;
  t *= t;
  return t * t;
}

constexpr std::size_t at(int y, int x) {
  return static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x);
}

// Part of a plane: a tile with its margin, where the edge of the picture is repeated.
using Block = std::array<float, std::size_t{kHeight} * kWidth>;

// Filters one tile. The regression has so many terms: 1, x, y, and the first of the features.
template <std::size_t Terms>
class TileFilter {
 public:
  TileFilter(const DenoiseLayer& layer, const FeaturePlanes& features, std::uint32_t left,
             std::uint32_t top)
      : layer_(layer),
        all_features_(features),
        left_(static_cast<int>(left) - kMargin),
        top_(static_cast<int>(top) - kMargin) {
    copy(layer.weight, weight_);
    copy(layer.variance, variance_);
    copy(layer.y, y_);
    clear_outside();
  }

  void run() {
    if (!has_light()) return;
    for (std::size_t c = 0; c < layer_.values.size(); ++c) copy(layer_.values[c], values_[c]);
    for (std::size_t f = 0; f < Terms - 3; ++f) copy(all_features_[f], features_[f]);
    std::size_t offset = 0;
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx, ++offset)
        compute_weights(dx, dy, weights_[offset]);
    }
    for (int row = 0; row < kFilterHeight; ++row) filter(row);
  }

  /// Filtered values of a row, by channel.
  const std::array<Row, 3>& filtered(std::size_t row) const { return filtered_[row]; }

 private:
  using Equations = NormalEquations<Terms, kFilterWidth>;
  using PatchRows = std::array<std::array<float, kPatchRowWidth>, kPatchRows>;

  void copy(const Plane& plane, Block& block) const {
    for (int y = 0; y < kHeight; ++y) {
      const int row = std::clamp(top_ + y, 0, static_cast<int>(layer_.height) - 1);
      const float* line = plane.data() + static_cast<std::size_t>(row) * layer_.width;
      for (int x = 0; x < kWidth; ++x) {
        block[at(y, x)] = line[std::clamp(left_ + x, 0, static_cast<int>(layer_.width) - 1)];
      }
    }
  }

  // Whether the tile or its margin has any light; else it stays black.
  bool has_light() const {
    const auto is_set = [](float each) { return each != 0; };
    return std::any_of(y_.begin(), y_.end(), is_set) ||
           std::any_of(variance_.begin(), variance_.end(), is_set);
  }

  void clear_outside() {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const bool inside = left_ + x >= 0 && left_ + x < static_cast<int>(layer_.width) &&
                            top_ + y >= 0 && top_ + y < static_cast<int>(layer_.height);
        if (!inside) weight_[at(y, x)] = 0;
      }
    }
  }

  // The weights of neighbours at an offset, from the distance of patches beyond the variance.
  void compute_weights(int dx, int dy, std::array<Row, kFilterHeight>& weights) const {
    PatchRows distance;
    PatchRows confidence;
    for (int y = 0; y < kPatchRows; ++y) {
      const std::size_t a = at(y + kReach, kReach);
      const std::size_t b = at(y + kReach + dy, kReach + dx);
      auto& distances = distance[static_cast<std::size_t>(y)];
      auto& confidences = confidence[static_cast<std::size_t>(y)];
      for (std::size_t x = 0; x < kPatchRowWidth; ++x) {
        const float difference = y_[a + x] - y_[b + x];
        const float expected = variance_[a + x] + std::min(variance_[a + x], variance_[b + x]);
        const float unit = 1e-5F + kDamping * (variance_[a + x] + variance_[b + x]);
        confidences[x] = weight_[a + x] * weight_[b + x];
        distances[x] = confidences[x] * (difference * difference - expected) / unit;
      }
    }
    add_rows(distance);
    add_rows(confidence);
    for (int y = 0; y < kFilterHeight; ++y) {
      const Row distances = add_columns(distance, y);
      const Row confidences = add_columns(confidence, y);
      const std::size_t b = at(y + kMargin + dy, kMargin + dx);
      Row& row = weights[static_cast<std::size_t>(y)];
      for (std::size_t x = 0; x < kFilterWidth; ++x) {
        const float weight = kernel(std::max(distances[x] / std::max(confidences[x], 1e-6F), 0.0F));
        row[x] = confidences[x] > 0 ? weight * weight_[b + x] : 0.0F;
      }
      if constexpr (Terms > 3) weigh_normals(at(y + kMargin, kMargin), b, row);
    }
  }

  // Light is linear in the normal only between neighbours with similar normals. A pixel within
  // which normals differ has the mean of their light: it is similar to more neighbours.
  void weigh_normals(std::size_t a, std::size_t b, Row& weights) const {
    constexpr float kSimilar = 1.0F / 32;
    Row apart{};    // squared
    Row lengths{};  // squared; less than 1 where normals differ within a pixel
    for (std::size_t f = 0; f < 3; ++f) {
      for (std::size_t x = 0; x < kFilterWidth; ++x) {
        const float from = features_[f][a + x];
        const float to = features_[f][b + x];
        apart[x] += (to - from) * (to - from);
        lengths[x] += (from * from + to * to) / 2;
      }
    }
    for (std::size_t x = 0; x < kFilterWidth; ++x) {
      weights[x] *= kernel(apart[x] / (kSimilar + std::max(1 - lengths[x], 0.0F)));
    }
  }

  static void add_rows(PatchRows& rows) {
    for (auto& line : rows) {
      std::array<float, kPatchRowWidth> sums{};
      for (std::size_t k = 0; k < kPatchWidth; ++k) {
        for (std::size_t x = 0; x < kFilterWidth; ++x) sums[x] += line[x + k];
      }
      line = sums;
    }
  }

  static Row add_columns(const PatchRows& rows, int y) {
    Row sums{};
    for (std::size_t k = 0; k < kPatchWidth; ++k) {
      for (std::size_t x = 0; x < kFilterWidth; ++x)
        sums[x] += rows[static_cast<std::size_t>(y) + k][x];
    }
    return sums;
  }

  // The terms of the regression for neighbours of a row, relative to its pixels.
  void set_terms(int row, int dx, int dy, std::array<Row, Terms>& terms) const {
    terms[1].fill(static_cast<float>(dx) / kReach);
    terms[2].fill(static_cast<float>(dy) / kReach);
    const std::size_t a = at(row + kMargin, kMargin);
    const std::size_t b = at(row + kMargin + dy, kMargin + dx);
    for (std::size_t f = 0; f < Terms - 3; ++f) {
      const Block& feature = features_[f];
      for (std::size_t x = 0; x < kFilterWidth; ++x)
        terms[3 + f][x] = feature[b + x] - feature[a + x];
    }
  }

  // Values for which the equations have no solution do not change.
  void filter(int row) {
    auto& values = filtered_[static_cast<std::size_t>(row)];
    for (std::size_t c = 0; c < layer_.values.size(); ++c) {
      std::copy_n(values_[c].data() + at(kMargin + row, kMargin), kFilterWidth, values[c].data());
    }
    equations_of(row).solve(kRidge, values);
  }

  Equations equations_of(int row) const {
    Equations equations;
    std::array<Row, Terms> terms;
    terms[0].fill(1);
    std::size_t offset = 0;
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx, ++offset) {
        set_terms(row, dx, dy, terms);
        add(weights_[offset][static_cast<std::size_t>(row)], terms,
            at(row + kMargin + dy, kMargin + dx), equations);
      }
    }
    return equations;
  }

  void add(const Row& weights, const std::array<Row, Terms>& terms, std::size_t first,
           Equations& equations) const {
    std::size_t product = 0;
    for (std::size_t i = 0; i < Terms; ++i) {
      Row weighted;
      for (std::size_t x = 0; x < kFilterWidth; ++x) weighted[x] = weights[x] * terms[i][x];
      for (std::size_t j = 0; j <= i; ++j, ++product) {
        Row& sum = equations.products[product];
        for (std::size_t x = 0; x < kFilterWidth; ++x) sum[x] += weighted[x] * terms[j][x];
      }
      for (std::size_t c = 0; c < layer_.values.size(); ++c) {
        const float* value = values_[c].data() + first;
        Row& sum = equations.colors[c][i];
        for (std::size_t x = 0; x < kFilterWidth; ++x) sum[x] += weighted[x] * value[x];
      }
    }
  }

  const DenoiseLayer& layer_;
  const FeaturePlanes& all_features_;
  int left_, top_;  // of the margin
  Block weight_, variance_, y_;
  std::array<Block, 3> values_{};
  std::array<Block, Terms - 3 == 0 ? 1 : Terms - 3> features_;
  std::array<std::array<Row, kFilterHeight>, static_cast<std::size_t>(kOffsets)> weights_;
  std::array<std::array<Row, 3>, kFilterHeight> filtered_{};
};

#ifdef __x86_64__
template <class Filter>
[[gnu::target("avx2"), gnu::flatten]] void run_with_avx2(Filter& filter) {
  filter.run();
}
#endif

// With AVX2, eight numbers are computed at a time instead of four. The values are the same.
template <class Filter>
void run_on_this_processor(Filter& filter) {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx2")) return run_with_avx2(filter);
#endif
  filter.run();
}

// Filters the layers one after the other, so that one is in memory at a time.
class Denoiser {
 public:
  Denoiser(const Film& film, const Rows& rows, unsigned jobs, Framebuffer& buffer)
      : film_(film), rows_(rows), jobs_(jobs), buffer_(buffer) {}

  void run(const DepthRange& depths) {
    start();
    const FeaturePlanes features = features_of(film_, depths, jobs_);
    for (const LightPart part : {LightPart::scattered, LightPart::reflected}) {
      const DenoiseLayer layer = light_layer(film_, part, jobs_);
      const auto light = [part](const FeatureSums& seen, const Rgb& value) {
        return value * albedo_of(seen, part);
      };
      if (part == LightPart::scattered) {
        smooth<kScatteredTerms>(layer, features, light);
      } else {
        smooth<kReflectedTerms>(layer, features, light);
      }
    }
    smooth<kShadowTerms>(
        shadow_layer(film_, jobs_), features, [](const FeatureSums& seen, const Rgb& value) {
          return to_vec(seen.background) * ((1 - value.x) / std::max(seen.count, 1U));
        });
  }

 private:
  static constexpr std::size_t kScatteredTerms = 3 + kFeatures;
  static constexpr std::size_t kReflectedTerms = 7;  // without the colour
  static constexpr std::size_t kShadowTerms = 3;

  std::size_t pixel(std::uint32_t x, std::uint32_t y) const {
    return std::size_t{y} * film_.width() + x;
  }

  // Emission has no noise.
  void start() {
    for (std::size_t i = pixel(0, rows_.first); i < pixel(0, rows_.last); ++i) {
      const FeatureSums& seen = film_.features(i);
      buffer_.radiance[i] = to_float3(to_vec(seen.emitted) / Rgb(std::max(seen.count, 1U)));
    }
  }

  // light(features, value of the layer) is what is added to the radiance.
  template <std::size_t Terms, class Light>
  void smooth(const DenoiseLayer& layer, const FeaturePlanes& features, const Light& light) {
    const std::uint32_t columns = (film_.width() + kFilterWidth - 1) / kFilterWidth;
    const std::uint32_t lines = (rows_.last - rows_.first + kFilterHeight - 1) / kFilterHeight;
    parallel_ordered(
        std::size_t{columns} * lines, jobs_,
        [&](std::size_t tile) {
          const auto number = static_cast<std::uint32_t>(tile);
          const std::uint32_t left = number % columns * kFilterWidth;
          const std::uint32_t top = rows_.first + number / columns * kFilterHeight;
          const auto filter =
              std::make_unique<TileFilter<Terms>>(layer, features, left, top - film_.held().first);
          add_tile(*filter, left, top, light);
        },
        [](std::size_t) {});
  }

  template <class Filter, class Light>
  void add_tile(Filter& filter, std::uint32_t left, std::uint32_t top, const Light& light) {
    run_on_this_processor(filter);
    for (std::uint32_t y = 0; y < kFilterHeight && top + y < rows_.last; ++y) {
      const std::array<Row, 3>& values = filter.filtered(y);
      for (std::uint32_t x = 0; x < kFilterWidth && left + x < film_.width(); ++x) {
        const std::size_t i = pixel(left + x, top + y);
        const Float3 value{values[0][x], values[1][x], values[2][x]};
        const Rgb more = light(film_.features(i), to_vec(value));
        buffer_.radiance[i] = to_float3(to_vec(buffer_.radiance[i]) + more);
      }
    }
  }

  const Film& film_;
  const Rows rows_;
  const unsigned jobs_;
  Framebuffer& buffer_;
};

}  // namespace

void denoise(const Film& film, const Rows& rows, const DepthRange& depths, unsigned jobs,
             Framebuffer& buffer) {
  Denoiser(film, rows, jobs, buffer).run(depths);
}

}  // namespace gltfx::render

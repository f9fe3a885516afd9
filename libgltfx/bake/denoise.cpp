// SPDX-License-Identifier: Apache-2.0
#include "bake/denoise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

#include "bake/denoise_planes.hpp"
#include "bake/regression.hpp"
#include "bake/storage.hpp"
#include "base/parallel.hpp"

namespace gltfx::bake {
namespace {

constexpr int kTile = 16;  // pixels along a side that are worked on together
constexpr int kReach = 5;  // how far neighbours are looked for
constexpr int kPatch = 3;  // half width of what is compared
constexpr int kCompared = kTile + 2 * kPatch;
constexpr float kStrictness = 0.25F;  // squared: standard deviations that are left to noise
constexpr float kRidge = 1e-4F;

using Row = std::array<float, kTile>;

// exp(-x) for x >= 0, near enough, without a call: it is taken for every pair of pixels.
inline float falling(float x) {
  float t = std::max(0.0F, 1 - x * (1.0F / 16.0F));
  t *= t;
  t *= t;
  t *= t;
  return t * t;
}

// One tile. `Terms`: of the regression: 1, x,
// y, and the first of the features.
template <std::size_t Terms>
class TileFilter {
 public:
  static constexpr std::size_t kTerms = Terms;
  static constexpr std::size_t kProducts = NormalEquations<kTerms>::kProducts;

  TileFilter(const DenoiseLayer& layer, std::uint32_t left, std::uint32_t top)
      : p_(layer),
        left_(static_cast<int>(left)),
        top_(static_cast<int>(top)),
        channels_(layer.values.size()) {}

  /// Whether there is something in the tile at all.
  bool matters() const {
    for (int y = 0; y < kTile; ++y) {
      for (int x = 0; x < kTile; ++x) {
        const std::size_t i = pixel(left_ + x, top_ + y);
        if (p_.weight[i] > 0 && (p_.variance[i] > 0 || p_.y[i] != 0)) return true;
      }
    }
    return false;
  }

  void run() {
    for (int dy = -kReach; dy <= kReach; ++dy) {
      for (int dx = -kReach; dx <= kReach; ++dx) {
        compare(dx, dy);
        for (int y = 0; y < kTile; ++y) add_row(y, dx, dy);
      }
    }
  }

  /// False where nothing can be said.
  bool value(int x, int y, Float3& value) const {
    NormalEquations<kTerms> equations;
    const auto column = static_cast<std::size_t>(x);
    for (std::size_t i = 0; i < kProducts; ++i) {
      equations.products[i] = products_[row(y)][i][column];
    }
    for (std::size_t c = 0; c < channels_; ++c) {
      for (std::size_t i = 0; i < kTerms; ++i) {
        equations.colors[c][i] = colors_[row(y)][c][i][column];
      }
    }
    return equations.solve(kRidge, value);
  }

 private:
  using Square = std::array<std::array<float, kCompared>, kCompared>;

  static std::size_t row(int y) { return static_cast<std::size_t>(y); }

  // Pixels beyond the edge are those at the edge.
  std::size_t pixel(int x, int y) const {
    const int column = std::clamp(x, 0, static_cast<int>(p_.width) - 1);
    const int line = std::clamp(y, 0, static_cast<int>(p_.height) - 1);
    return static_cast<std::size_t>(line) * p_.width + static_cast<std::size_t>(column);
  }

  bool is_inside(int x, int y) const {
    return x >= 0 && y >= 0 && x < static_cast<int>(p_.width) && y < static_cast<int>(p_.height);
  }

  // How far the pixels differ from those at an offset, beyond what noise explains.
  void compare(int dx, int dy) {
    const Plane& light = p_.y;
    const Plane& variance = p_.variance;
    for (int y = 0; y < kCompared; ++y) {
      for (int x = 0; x < kCompared; ++x) {
        const std::size_t a = pixel(left_ - kPatch + x, top_ - kPatch + y);
        const std::size_t b = pixel(left_ - kPatch + x + dx, top_ - kPatch + y + dy);
        const float difference = light[a] - light[b];
        const float expected = variance[a] + std::min(variance[a], variance[b]);
        const float unit = 1e-5F + kStrictness * (variance[a] + variance[b]);
        const float say = p_.weight[a] * p_.weight[b];
        distance_[row(y)][row(x)] = say * (difference * difference - expected) / unit;
        say_[row(y)][row(x)] = say;
      }
    }
    blur_rows(distance_);
    blur_rows(say_);
  }

  static void blur_rows(Square& square) {
    for (auto& line : square) {
      std::array<float, kCompared> sums{};
      for (std::size_t x = 0; x < kTile; ++x) {
        for (std::size_t k = 0; k <= 2 * kPatch; ++k) sums[x] += line[x + k];
      }
      line = sums;
    }
  }

  Row weights(int y, int dx, int dy) const {
    Row sums{};
    Row says{};
    for (std::size_t k = 0; k <= 2 * kPatch; ++k) {
      for (std::size_t x = 0; x < kTile; ++x) {
        sums[x] += distance_[row(y) + k][x];
        says[x] += say_[row(y) + k][x];
      }
    }
    for (std::size_t x = 0; x < kTile; ++x) {
      const int column = left_ + static_cast<int>(x) + dx;
      const bool there = is_inside(column, top_ + y + dy) && says[x] > 0;
      const float alike = falling(std::max(sums[x] / std::max(says[x], 1e-6F), 0.0F));
      sums[x] = there ? alike * p_.weight[pixel(column, top_ + y + dy)] : 0.0F;
    }
    return sums;
  }

  // What distinguishes the pixels of a row from those at an offset.
  std::array<Row, kTerms> terms(int y, int dx, int dy) const {
    std::array<Row, kTerms> t;
    t[0].fill(1);
    t[1].fill(static_cast<float>(dx) / kReach);
    t[2].fill(static_cast<float>(dy) / kReach);
    for (std::size_t f = 0; f < kTerms - 3; ++f) {
      for (int x = 0; x < kTile; ++x) {
        const Plane& plane = p_.features[f];
        t[3 + f][row(x)] =
            plane[pixel(left_ + x + dx, top_ + y + dy)] - plane[pixel(left_ + x, top_ + y)];
      }
    }
    return t;
  }

  void add_row(int y, int dx, int dy) {
    const Row weight = weights(y, dx, dy);
    const std::array<Row, kTerms> t = terms(y, dx, dy);
    auto& products = products_[row(y)];
    std::size_t product = 0;
    for (std::size_t i = 0; i < kTerms; ++i) {
      Row weighted;
      for (std::size_t x = 0; x < kTile; ++x) weighted[x] = weight[x] * t[i][x];
      for (std::size_t j = 0; j <= i; ++j, ++product) {
        for (std::size_t x = 0; x < kTile; ++x) products[product][x] += weighted[x] * t[j][x];
      }
      for (std::size_t c = 0; c < channels_; ++c) {
        const Plane& light = p_.values[c];
        for (std::size_t x = 0; x < kTile; ++x) {
          const int column = left_ + static_cast<int>(x) + dx;
          colors_[row(y)][c][i][x] += weighted[x] * light[pixel(column, top_ + y + dy)];
        }
      }
    }
  }

  const DenoiseLayer& p_;
  int left_, top_;
  std::size_t channels_;
  Square distance_{}, say_{};
  std::array<std::array<Row, kProducts>, kTile> products_{};
  std::array<std::array<std::array<Row, kTerms>, 3>, kTile> colors_{};
};

class Denoiser {
 public:
  explicit Denoiser(const Film& film)
      : film_(film),
        scattered_(light_layer(film, LightPart::scattered)),
        reflected_(light_layer(film, LightPart::reflected)),
        shadow_(shadow_layer(film)) {}

  std::vector<Rgb> run(unsigned jobs) {
    result_.resize(film_.size());
    const std::uint32_t columns = (film_.width() + kTile - 1) / kTile;
    const std::uint32_t rows = (film_.height() + kTile - 1) / kTile;
    parallel_ordered(
        std::size_t{columns} * rows, jobs,
        [&](std::size_t tile) {
          const auto number = static_cast<std::uint32_t>(tile);
          filter(number % columns * kTile, number / columns * kTile);
        },
        [](std::size_t) {});
    return std::move(result_);
  }

 private:
  // Mean of the halves, each by its number of samples.
  void filter(std::uint32_t left, std::uint32_t top) {
    const auto scattered = smooth<kLightTerms>(scattered_, left, top);
    const auto reflected = smooth<kLightTerms>(reflected_, left, top);
    const auto shadow = smooth<kShadowTerms>(shadow_, left, top);
    for (std::uint32_t y = 0; y < kTile && top + y < film_.height(); ++y) {
      for (std::uint32_t x = 0; x < kTile && left + x < film_.width(); ++x) {
        const std::size_t i = std::size_t{top + y} * film_.width() + left + x;
        const Sights seen = film_.sights(i);
        const double count = std::max(seen.count, 1U);
        const std::size_t at = std::size_t{y} * kTile + x;
        const Rgb shown = to_vec(seen.behind) * (1 - shadow[at].x);
        result_[i] = (to_vec(seen.direct) + shown) / Rgb(count) +
                     scattered[at] * surface_color(seen, LightPart::scattered) +
                     reflected[at] * surface_color(seen, LightPart::reflected);
      }
    }
  }

  static constexpr std::size_t kLightTerms = 3 + DenoiseLayer::kFeatures;
  static constexpr std::size_t kShadowTerms = 3;

  template <std::size_t Terms>
  static std::vector<Rgb> smooth(const DenoiseLayer& layer, std::uint32_t left, std::uint32_t top) {
    std::vector<Rgb> result(std::size_t{kTile} * kTile);
    const auto filter = std::make_unique<TileFilter<Terms>>(layer, left, top);
    if (!filter->matters()) return result;
    filter->run();
    for (std::uint32_t y = 0; y < kTile && top + y < layer.height; ++y) {
      for (std::uint32_t x = 0; x < kTile && left + x < layer.width; ++x) {
        const std::size_t i = std::size_t{top + y} * layer.width + left + x;
        Float3 value{};
        for (std::size_t c = 0; c < layer.values.size(); ++c) value[c] = layer.values[c][i];
        filter->value(static_cast<int>(x), static_cast<int>(y), value);
        result[std::size_t{y} * kTile + x] = to_vec(value);
      }
    }
    return result;
  }

  const Film& film_;
  const DenoiseLayer scattered_, reflected_, shadow_;
  std::vector<Rgb> result_;
};

}  // namespace

std::vector<Rgb> denoise(const Film& film, unsigned jobs) { return Denoiser(film).run(jobs); }

}  // namespace gltfx::bake

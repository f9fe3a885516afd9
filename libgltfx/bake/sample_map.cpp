// SPDX-License-Identifier: Apache-2.0
#include "bake/sample_map.hpp"

#include <algorithm>
#include <cmath>

#include "bake/camera_sample.hpp"
#include "bake/render_rows.hpp"
#include "bake/storage.hpp"
#include "bake/tonemap.hpp"
#include "base/parallel.hpp"

namespace gltfx::bake {
namespace {

constexpr std::uint32_t kFewest = 16;  // of a pixel, for which it pays to find out
constexpr std::uint32_t kRange = 4;    // times more or less than on average
constexpr double kLoudest = 0.25;      // of the range from black to white: more counts as this
constexpr double kDark = 0.02;         // colours below it say little of the light on them

// Light of one part of the samples of a pixel, without what is known of the surfaces there.
struct PartSpread {
  double color = 0, light = 0, square = 0;

  void add(const Rgb& sent, const Rgb& by) {
    const double tint = luminance(by);
    if (!(tint > 0)) return;
    const double value = luminance(sent) / std::max(tint, kDark);
    color += tint;
    light += value;
    square += value * value;
  }
  // Of what is sent.
  double variance(double count) const {
    const double scale = color / count;
    const double sum = square - light * light / count;
    return std::max(sum, 0.0) / (count - 1) * scale * scale;
  }
};

// Samples of a pixel, as the denoiser takes them.
class Spread {
 public:
  void add(const PathSample& sample) {
    ++count_;
    radiance_ += luminance(sample.radiance());
    scattered_.add(sample.scattered, sample.features.albedo);
    reflected_.add(sample.reflected, sample.features.specular_albedo);
    shadow_.add(sample.background * sample.shadow, Rgb(1));
    steady_.add(sample.emitted + sample.background, Rgb(1));
    clear_ = clear_ || sample.features.clear;
  }

  /// Variance of a sample as it shows in the finished picture.
  double visible() const {
    constexpr double kShadow = 0.04;  // of its variance: denoised best, since it is smooth
    const double error =
        std::sqrt(scattered_.variance(count_) + reflected_.variance(count_) +
                  shadow_.variance(count_) * kShadow + (clear_ ? steady_.variance(count_) : 0.0));
    const double mean = radiance_ / count_;
    const double shown = shown_luminance(mean + error) - shown_luminance(mean);
    return std::min(shown * shown, kLoudest * kLoudest);
  }

 private:
  double count_ = 0;
  double radiance_ = 0;
  PartSpread scattered_, reflected_, shadow_;
  PartSpread steady_;   // without noise, but for what is seen through glass
  bool clear_ = false;  // there is such
};

// Pixels of part of a picture.
struct Square {
  std::uint32_t left, top, right, bottom;

  Square(std::uint32_t column, std::uint32_t row, std::uint32_t side, const RenderOptions& options)
      : left(column * side),
        top(row * side),
        right(std::min(left + side, options.width)),
        bottom(std::min(top + side, options.height)) {}
  double pixels() const { return static_cast<double>(right - left) * (bottom - top); }
};

}  // namespace

SampleMap::SampleMap(const TraceContext& context, const View& view, const RenderOptions& options)
    : SampleMap(options.samples) {
  if (options.samples < kFewest || options.seconds > 0 || options.noise > 0) return;
  columns_ = (options.width + kSide - 1) / kSide;
  rows_ = (options.height + kSide - 1) / kSide;
  std::vector<float> noise = find_noise(context, view, options);
  blur(noise);
  for (float& each : noise) each = std::sqrt(each);
  share_out(noise, options);
}

std::vector<float> SampleMap::find_noise(const TraceContext& context, const View& view,
                                         const RenderOptions& options) const {
  const std::uint32_t samples = std::clamp(options.samples / kFewest, 2U, 4U);
  // Others than those of the picture: pixels that were lucky once must not be given more of it.
  const std::uint32_t seed = mix_bits(options.seed, 1);
  const auto variance_at = [&](std::uint32_t x, std::uint32_t y) {
    Spread spread;
    for (std::uint32_t i = 0; i < samples; ++i) {
      const auto [ray, point, random] =
          camera_sample(view, options.width, options.height, seed, x, y, i);
      spread.add(trace_path(context, ray, point, random));
    }
    return spread.visible();
  };
  const auto mean_of = [&](const Square& square) {
    double sum = 0;
    for (std::uint32_t y = square.top; y < square.bottom; ++y) {
      for (std::uint32_t x = square.left; x < square.right; ++x) sum += variance_at(x, y);
    }
    return static_cast<float>(sum / square.pixels());
  };
  std::vector<float> noise(std::size_t{columns_} * rows_);
  const auto row_of_squares = [&](std::size_t row) {
    for (std::uint32_t column = 0; column < columns_; ++column) {
      noise[row * columns_ + column] =
          mean_of({column, static_cast<std::uint32_t>(row), kSide, options});
    }
  };
  parallel_ordered(rows_, options.jobs, row_of_squares, [](std::size_t) {});
  return noise;
}

// Few samples tell little: each square takes part in what its neighbours found.
void SampleMap::blur(std::vector<float>& values) const {
  const std::vector<float> from = values;
  for (std::uint32_t y = 0; y < rows_; ++y) {
    for (std::uint32_t x = 0; x < columns_; ++x) {
      float sum = 0;
      float weight = 0;
      for (std::uint32_t v = std::max(y, 1U) - 1; v < std::min(y + 2, rows_); ++v) {
        for (std::uint32_t u = std::max(x, 1U) - 1; u < std::min(x + 2, columns_); ++u) {
          const float part = u == x && v == y ? 2 : 1;
          sum += part * from[std::size_t{v} * columns_ + u];
          weight += part;
        }
      }
      values[std::size_t{y} * columns_ + x] = sum / weight;
    }
  }
}

// What is left of a variance v by n samples is v / n. Its sum is least for n in proportion to the
// root of v; what that has to be multiplied by is found by halving intervals.
void SampleMap::share_out(const std::vector<float>& noise, const RenderOptions& options) {
  const std::uint32_t least = (options.samples / kRange + 1) / 2 * 2;  // even, for the halves
  const auto count = [&](float each, double scale) {
    const double even = std::floor(scale * static_cast<double>(each) / 2) * 2;
    return std::clamp(even, static_cast<double>(least),
                      static_cast<double>(options.samples) * kRange);
  };
  const auto sum = [&](double scale) {
    double total = 0;
    for (std::uint32_t y = 0; y < rows_; ++y) {
      for (std::uint32_t x = 0; x < columns_; ++x) {
        total += count(noise[std::size_t{y} * columns_ + x], scale) *
                 Square(x, y, kSide, options).pixels();
      }
    }
    return total;
  };
  const double all = static_cast<double>(options.samples) * options.width * options.height;
  double low = 0;
  double high = 1e9;
  for (int step = 0; step < 64; ++step) {
    const double scale = (low + high) / 2;
    (sum(scale) <= all ? low : high) = scale;
  }
  counts_.reserve(noise.size());
  for (const float each : noise) counts_.push_back(static_cast<std::uint32_t>(count(each, low)));
  most_ = *std::max_element(counts_.begin(), counts_.end());
}

}  // namespace gltfx::bake

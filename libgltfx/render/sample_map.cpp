// SPDX-License-Identifier: Apache-2.0
#include "render/sample_map.hpp"

#include <algorithm>
#include <cmath>

#include "base/packed.hpp"
#include "base/parallel.hpp"
#include "render/camera_packet.hpp"
#include "render/render.hpp"
#include "render/surface.hpp"
#include "render/tonemap.hpp"

namespace gltfx::render {
namespace {

constexpr std::uint32_t kFewest = 16;  // of a pixel, to make an estimate worthwhile
// The range of a pixel's count around the average:
constexpr std::uint32_t kTimesLess = 10, kTimesMore = 4;
// With a deviation, the least average as part of RenderOptions::samples: of pictures of opaque
// surfaces; of those with surfaces that transmit light, behind which the denoiser has no features;
// and of those without the sky, where a sample has fewer shadow rays: it is cheap, and adds less.
// 11/32 gives 48.7 dB for a scene of common materials and 50.1 dB for a statue at 256 x 256.
constexpr double kLeastOpaque = 11.0 / 32, kLeastTransmissive = 14.0 / 32, kLeastWithoutSky = 1;
constexpr double kMostError =
    0.25;                       // of the range from black to white; larger errors count as this
constexpr double kDark = 0.02;  // least albedo by which light is divided

// The variance of one part of the light of a pixel, which is divided by the albedo as the denoiser
// does: variance of the albedo does not count.
class PartVariance {
 public:
  void add(const Rgb& light, const Rgb& albedo) {
    const double tint = luminance(albedo);
    if (!(tint > 0)) return;
    const double value = luminance(light) / std::max(tint, kDark);
    albedo_ += tint;
    sum_ += value;
    square_ += value * value;
  }
  double of_samples(double count) const {
    const double scale = albedo_ / count;
    const double sum = square_ - sum_ * sum_ / count;
    return std::max(sum, 0.0) / (count - 1) * scale * scale;
  }

 private:
  double albedo_ = 0, sum_ = 0, square_ = 0;
};

class PixelVariance {
 public:
  void add(const PathSample& sample) {
    ++count_;
    radiance_ += luminance(sample.radiance());
    scattered_.add(sample.scattered, sample.features.albedo);
    reflected_.add(sample.reflected, sample.features.specular_albedo);
    shadow_.add(sample.background * sample.shadow, Rgb(1));
    unlit_.add(sample.emitted + sample.background, Rgb(1));
    clear_ = clear_ || sample.features.clear;
  }

  /// Variance of a sample in the tone mapped picture.
  double tone_mapped() const {
    constexpr double kShadow = 0.04;  // part of its variance: smooth, so that it is denoised best
    constexpr double kClear = 12;  // behind glass: sharp and coloured, so that it is denoised least
    const double lit = scattered_.of_samples(count_) + reflected_.of_samples(count_);
    const double error = std::sqrt((clear_ ? (lit + unlit_.of_samples(count_)) * kClear : lit) +
                                   shadow_.of_samples(count_) * kShadow);
    const double mean = radiance_ / count_;
    const double shown = shown_luminance(mean + error) - shown_luminance(mean);
    return std::min(shown * shown, kMostError * kMostError);
  }

 private:
  double count_ = 0;
  double radiance_ = 0;
  PartVariance scattered_, reflected_, shadow_;
  PartVariance unlit_;  // emission and background, which have noise behind glass only
  bool clear_ = false;
};

double least_average(const TraceContext& context) {
  if (!context.world.sky) return kLeastWithoutSky;
  const auto transmits = [](const SceneMaterial& each) { return is_transmissive(each.factors); };
  const auto& materials = context.scene.materials;
  return std::any_of(materials.begin(), materials.end(), transmits) ? kLeastTransmissive
                                                                    : kLeastOpaque;
}

// Pixels of part of a picture.
struct PixelBlock {
  std::uint32_t left, top, right, bottom;

  PixelBlock(std::uint32_t column, std::uint32_t row, std::uint32_t side,
             const RenderOptions& options)
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
  std::vector<float> variances = estimate_variance(context, view, options);
  blur(variances);
  for (float& each : variances) each = std::sqrt(each);
  allocate(variances, options, least_average(context));
}

std::vector<float> SampleMap::estimate_variance(const TraceContext& context, const View& view,
                                                const RenderOptions& options) const {
  const std::uint32_t samples = std::clamp(options.samples / kFewest, 2U, 4U);
  // Independent of the seed of the picture: otherwise pixels with bright samples would get more of
  // them.
  const std::uint32_t seed = mix_bits(options.seed, 1);
  const auto variance_at = [&](std::uint32_t x, std::uint32_t y) {
    PixelVariance variance;
    const PixelSamples pixel(options.width, options.height, seed, x, y);
    visit_camera_samples(context.bvh, 0, samples, view, pixel,
                         [&](const CameraSample& camera, const auto& hit) {
                           variance.add(trace_path(context, camera, hit));
                         });
    return variance.tone_mapped();
  };
  // Of every second pixel, as the fields of one colour on a checkerboard.
  const auto mean_of = [&](const PixelBlock& block) {
    double sum = 0;
    std::uint32_t count = 0;
    for (std::uint32_t y = block.top; y < block.bottom; ++y) {
      for (std::uint32_t x = block.left + (y & 1U); x < block.right; x += 2, ++count)
        sum += variance_at(x, y);
    }
    return static_cast<float>(sum / std::max(count, 1U));
  };
  std::vector<float> variances(std::size_t{columns_} * rows_);
  const auto row_of_blocks = [&](std::size_t row) {
    for (std::uint32_t column = 0; column < columns_; ++column) {
      variances[row * columns_ + column] =
          mean_of({column, static_cast<std::uint32_t>(row), kSide, options});
    }
  };
  parallel_ordered(rows_, options.jobs, row_of_blocks, [](std::size_t) {});
  return variances;
}

// Few samples give a rough estimate: each block contributes to those of its neighbours.
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

// The variance of a mean of n samples is v / n. The sum over the picture is least for n in
// proportion to the root of v; bisection finds the factor.
void SampleMap::allocate(const std::vector<float>& deviations, const RenderOptions& options,
                         double least_average) {
  const std::uint32_t least = (options.samples / kTimesLess + 1) / 2 * 2;  // even, for the halves
  const auto count = [&](float each, double factor) {
    const double even = std::floor(factor * static_cast<double>(each) / 2) * 2;
    return std::clamp(even, static_cast<double>(least),
                      static_cast<double>(options.samples) * kTimesMore);
  };
  const auto sum = [&](double factor) {
    double total = 0;
    for (std::uint32_t y = 0; y < rows_; ++y) {
      for (std::uint32_t x = 0; x < columns_; ++x) {
        total += count(deviations[std::size_t{y} * columns_ + x], factor) *
                 PixelBlock(x, y, kSide, options).pixels();
      }
    }
    return total;
  };
  const auto factor_for = [&](double average) {
    const double all = average * options.width * options.height;
    double low = 0;
    double high = 1e9;
    for (int step = 0; step < 64; ++step) {
      const double factor = (low + high) / 2;
      (sum(factor) <= all ? low : high) = factor;
    }
    return low;
  };
  double factor = factor_for(options.samples);
  if (options.deviation > 0) {
    factor = std::clamp(options.samples / options.deviation,
                        factor_for(least_average * options.samples), factor);
  }
  counts_.reserve(deviations.size());
  for (const float each : deviations)
    counts_.push_back(static_cast<std::uint32_t>(count(each, factor)));
  most_ = *std::max_element(counts_.begin(), counts_.end());
}

}  // namespace gltfx::render

// SPDX-License-Identifier: Apache-2.0
#include "render/render.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "base/packed.hpp"
#include "base/parallel.hpp"
#include "render/camera_packet.hpp"
#include "render/denoise.hpp"
#include "render/edge_map.hpp"
#include "render/pixel_surface.hpp"
#include "render/tonemap.hpp"

namespace gltfx::render {
namespace {

constexpr std::uint32_t kRound = 8;  // samples of a pixel between two checks of time and noise
// Numbers of feature samples that miss no edge, far from edges between bodies and near them:
constexpr std::uint32_t kSure = 16, kSureNearEdge = 64;
constexpr std::uint32_t kAtOnce =
    PixelSurface::kRays;  // feature samples between two checks for differences

class Renderer {
 public:
  Renderer(const TraceContext& context, const View& view, const RenderOptions& options,
           const SampleMap& samples, const Rows& rows, Film& film)
      : context_(context),
        view_(view),
        options_(options),
        samples_(samples),
        rows_(rows),
        film_(film),
        columns_((options.width + kTileWidth - 1) / kTileWidth),
        done_(std::size_t{columns_} * ((rows.last - rows.first + kTileHeight - 1) / kTileHeight),
              0) {}

  void run() {
    const bool steady = options_.seconds <= 0 && options_.noise <= 0;
    const std::uint32_t most = samples_.most();
    const std::uint32_t round = steady ? most : kRound;
    for (std::uint32_t first = 0; first < most; first += round) {
      const std::uint32_t last = std::min(first + round, most);
      if (!render_round(first, last) || out_of_time()) break;
    }
    if (options_.feature_samples > 0) add_feature_samples();
  }

 private:
  // False if all tiles have enough samples.
  bool render_round(std::uint32_t first, std::uint32_t last) {
    bool any = false;
    parallel_ordered(
        done_.size(), options_.jobs,
        [&](std::size_t tile) {
          if (done_[tile] == 0) render_tile(static_cast<std::uint32_t>(tile), first, last);
        },
        [&](std::size_t tile) {
          any = any || done_[tile] == 0;
          report((first + static_cast<double>(last - first) * static_cast<double>(tile + 1) /
                              static_cast<double>(done_.size())) /
                 samples_.most());
        });
    return any;
  }

  struct PixelFeatures {
    std::size_t pixel;
    FeatureSums sums;
    std::uint32_t material;
  };

  // Parameters of the feature samples of a tile.
  struct FeatureSampling {
    double stratification = 1;  // variance of a mean albedo, as part of that of random samples
    std::uint32_t most = 0;     // of a pixel
  };

  // Estimated from the two halves of the light samples, as the denoiser does for its variance.
  double stratification(std::uint32_t tile) const {
    double random = 0;
    double stratified = 0;
    for_pixels(tile, [&](std::uint32_t x, std::uint32_t y) {
      const PixelSums& sums = film_.at(std::size_t{y} * options_.width + x);
      if (sums.samples < 2) return;
      const Vec3d odd = to_vec(sums.odd_albedo);
      const Vec3d even = to_vec(sums.features.albedo) - odd;
      const Vec3d apart = (even - odd) / static_cast<double>(sums.samples);
      stratified += dot(apart, apart);
      random += sums.feature_variance().albedo / (sums.samples - 1);
    });
    return random > 0 ? std::min(stratified / random, 1.0) : 1;
  }

  // Whether the means of so many samples are exact enough. Over an edge, the variance of a mean of
  // stratified samples falls with the power 1.5 of their number.
  bool is_certain(const FeatureVariance& variance, double stratification, double count) const {
    constexpr double kAlbedo = 5e-6;
    constexpr double kNormal = 12;  // relative to alpha
    const double part = count / options_.feature_samples;
    const double edge =
        part * std::sqrt(part) / 4;  // the variance for half a pixel with all samples
    return variance.alpha <= edge && variance.normal <= kNormal * edge &&
           variance.albedo * stratification <= kAlbedo * count;
  }

  // A tile with few edges has more samples for each.
  FeatureSampling feature_sampling(std::uint32_t tile) const {
    FeatureSampling sampling{stratification(tile)};
    const std::uint32_t few = std::max(options_.feature_samples / 4, 8U);
    std::uint32_t edges = 0;
    for_pixels(tile, [&](std::uint32_t x, std::uint32_t y) {
      const PixelSums& sums = film_.at(std::size_t{y} * options_.width + x);
      edges += is_certain(sums.feature_variance(), sampling.stratification, few) ? 0U : 1U;
    });
    const std::uint32_t share = few * kTileWidth * kTileHeight / std::max(edges, 1U);
    sampling.most = std::min(options_.feature_samples, std::bit_floor(share));
    return sampling;
  }

  // Edges and textures are finer than the samples of the light.
  void add_feature_samples() {
    std::vector<std::vector<PixelFeatures>> found(done_.size());
    parallel_ordered(
        done_.size(), options_.jobs,
        [&](std::size_t tile) {
          const auto number = static_cast<std::uint32_t>(tile);
          const FeatureSampling sampling = feature_sampling(number);
          const EdgeMap edges(context_.bvh, view_, options_, left_of(number), top_of(number));
          for_pixels(number, [&](std::uint32_t x, std::uint32_t y) {
            const auto seen = sample_pixel_features(x, y, edges.is_near_edge(x, y), sampling);
            if (seen.sums.count > 0) found[tile].push_back(seen);
          });
        },
        [&](std::size_t tile) {
          for (const auto& [pixel, sums, material] : found[tile]) {
            film_.set_features(pixel, sums, material);
          }
          found[tile] = {};
        });
  }

  // None, to save memory, if all samples of the pixel are nearly the same.
  PixelFeatures sample_pixel_features(std::uint32_t x, std::uint32_t y, bool near_edge,
                                      const FeatureSampling& sampling) const {
    constexpr double kSmooth = 1e-3;  // variance of normals
    const std::uint32_t enough = near_edge ? kSureNearEdge : std::min(kSure, options_.samples);
    const std::size_t pixel = std::size_t{y} * options_.width + x;
    PixelSums sums = film_.at(pixel);
    PixelSurface surface(context_.scene);
    bool fits = false;
    bool same = true;  // at every check
    for (std::uint32_t i = samples_.samples(x, y);;) {
      const std::uint32_t count = sums.features.count;
      const bool certain = is_certain(sums.feature_variance(), sampling.stratification, count);
      same = sums.clear || (same && certain);
      if (sums.clear || (certain && count >= enough) || i >= sampling.most) break;
      const std::uint32_t end = std::min(i + kAtOnce, sampling.most);
      if (fits) {
        samples_of(x, y).visit_points(
            i, end, [&](const Float2& point) { sums.add_features(surface.at(point)); });
        i = end;
        continue;
      }
      visit_samples(x, y, i, end, [&](const CameraSample& camera, const auto& hit) {
        const PathSample sample = sample_features(context_, camera, hit);
        surface.add(camera.point, hit, sample);
        sums.add_features(sample);
      });
      i = end;
      const FeatureVariance variance = sums.feature_variance();
      // The texture of one smooth surface needs no more rays.
      fits = !near_edge && variance.alpha <= 0 && variance.normal <= kSmooth && surface.fit();
    }
    return {pixel, same ? FeatureSums() : sums.features, sums.material};
  }

  std::uint32_t left_of(std::uint32_t tile) const { return tile % columns_ * kTileWidth; }
  std::uint32_t top_of(std::uint32_t tile) const {
    return rows_.first + tile / columns_ * kTileHeight;
  }

  template <class Visit>
  void for_pixels(std::uint32_t tile, const Visit& visit) const {
    const std::uint32_t left = left_of(tile);
    const std::uint32_t top = top_of(tile);
    for (std::uint32_t y = top; y < std::min(top + kTileHeight, rows_.last); ++y) {
      for (std::uint32_t x = left; x < std::min(left + kTileWidth, options_.width); ++x)
        visit(x, y);
    }
  }

  void report(double part) {
    if (options_.progress) options_.progress(part);
  }

  // A tile has enough samples if its worst row has.
  void render_tile(std::uint32_t tile, std::uint32_t first, std::uint32_t last) {
    std::array<double, kTileHeight> errors{};
    for_pixels(tile, [&](std::uint32_t x, std::uint32_t y) {
      const std::uint32_t end = std::min(last, samples_.samples(x, y));
      const std::size_t pixel = std::size_t{y} * options_.width + x;
      visit_samples(x, y, first, end, [&](const CameraSample& camera, const auto& hit) {
        film_.add(pixel, trace_path(context_, camera, hit));
      });
      errors[(y - rows_.first) % kTileHeight] += visible_error(pixel);
    });
    const double worst = *std::max_element(errors.begin(), errors.end()) / kTileWidth;
    if (options_.noise > 0 && last >= 2 * kRound && worst < options_.noise) done_[tile] = 1;
  }

  // The standard error in the tone mapped picture.
  double visible_error(std::size_t pixel) const {
    if (options_.noise <= 0) return 0;
    const double error = film_.error(pixel);
    const Rgb mean = film_.radiance(pixel);
    const double y = luminance(mean);
    return shown_luminance(y + error) - shown_luminance(y);
  }

  PixelSamples samples_of(std::uint32_t x, std::uint32_t y) const {
    return {options_.width, options_.height, options_.seed, x, y};
  }

  template <class Visit>
  void visit_samples(std::uint32_t x, std::uint32_t y, std::uint32_t first, std::uint32_t last,
                     const Visit& visit) const {
    visit_camera_samples(context_.bvh, first, last, view_, samples_of(x, y), visit);
  }

  bool out_of_time() const {
    if (options_.seconds <= 0) return false;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
    return passed.count() >= options_.seconds;
  }

  const TraceContext& context_;
  const View& view_;
  const RenderOptions& options_;
  const SampleMap& samples_;
  const Rows rows_;
  Film& film_;
  std::uint32_t columns_;
  std::vector<std::uint8_t> done_;  // by tile; not bool, because neighbours would share a byte
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// An estimate by a grid of rays.
DepthRange depth_range(const TraceContext& context, const View& view) {
  constexpr std::uint32_t kProbes = 96;  // along a side
  const auto fill = [&view](std::uint32_t i, std::span<CameraSample> samples) {
    for (CameraSample& sample : samples) {
      const std::uint32_t column = i % kProbes;
      const std::uint32_t row = i / kProbes;
      sample.ray = view.ray((column + 0.5) / kProbes, (row + 0.5) / kProbes);
      ++i;
    }
  };
  DepthRange range;
  const auto add = [&range](const CameraSample& /*sample*/, const std::optional<Hit>& hit) {
    if (!hit) return;
    const auto z = static_cast<float>(hit->distance);
    range.nearest = range.nearest == 0 ? z : std::min(range.nearest, z);
    range.farthest = std::max(range.farthest, z);
  };
  visit_camera_samples(context.bvh, 0, kProbes * kProbes, fill, add);
  return range;
}

// Enough tiles that threads seldom wait for each other, but fewer in wide pictures: the denoiser
// also holds rows above and below. Values do not depend on it. At 256 x 256, 32 tiles for each
// thread take 2 % less time than 16.
std::uint32_t rows_at_once(const RenderOptions& options) {
  constexpr std::uint32_t kMostTilesPerJob = 32, kLeastTilesPerJob = 16;
  constexpr std::uint32_t kHeldPixels = 16'384;
  if (options.seconds > 0) return options.height;
  const std::uint32_t jobs = std::min(options.jobs == 0 ? default_jobs() : options.jobs, 256U);
  const std::uint32_t columns = (options.width + kTileWidth - 1) / kTileWidth;
  const auto rows_of = [columns](std::uint32_t tiles) {
    return (tiles + columns - 1) / columns * kTileHeight;
  };
  const std::uint32_t held = kHeldPixels / options.width;
  const std::uint32_t fitting = (held - std::min(held, 2 * kDenoiseReach)) / kTileHeight;
  return std::clamp(fitting * kTileHeight, rows_of(kLeastTilesPerJob * jobs),
                    rows_of(kMostTilesPerJob * jobs));
}

// Progress of the picture by the progress of some rows.
RenderOptions part_of(const RenderOptions& options, const Rows& rows) {
  RenderOptions part = options;
  if (!options.progress) return part;
  part.progress = [&options, rows](double within) {
    options.progress((rows.first + within * (rows.last - rows.first)) / options.height);
  };
  return part;
}

}  // namespace

void render_rows(const TraceContext& context, const View& view, const RenderOptions& options,
                 const SampleMap& samples, const Rows& rows, Film& film) {
  Renderer(context, view, options, samples, rows, film).run();
}

Framebuffer render(const TraceContext& context, const View& view, const PictureOptions& options) {
  const RenderOptions& render = options.render;
  Framebuffer buffer(render.width, render.height, options.layers);
  const DepthRange depths = options.denoise ? depth_range(context, view) : DepthRange();
  const SampleMap samples =
      options.denoise ? SampleMap(context, view, render) : SampleMap(render.samples);
  const std::uint32_t reach = options.denoise ? kDenoiseReach : 0;
  const std::uint32_t step = rows_at_once(render);
  Film film(render.width, render.height, {});
  film.reserve(std::min(step + 2 * reach, render.height));
  std::uint32_t finished = 0;
  while (finished < render.height) {
    const Rows fresh{film.held().last, std::min(film.held().last + step, render.height)};
    film.hold({finished - std::min(finished, reach), fresh.last});
    render_rows(context, view, part_of(render, fresh), samples, fresh, film);
    const bool last = fresh.last == render.height;
    const Rows ready{finished, last ? fresh.last : fresh.last - std::min(reach, fresh.last)};
    if (ready.first == ready.last) continue;
    resolve(film, ready, buffer);
    if (options.denoise) denoise(film, ready, depths, render.jobs, buffer);
    finished = ready.last;
  }
  return buffer;
}

}  // namespace gltfx::render

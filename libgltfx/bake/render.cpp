// SPDX-License-Identifier: Apache-2.0
#include "bake/render.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "bake/camera_sample.hpp"
#include "bake/storage.hpp"
#include "bake/tonemap.hpp"
#include "base/parallel.hpp"

namespace gltfx::bake {
namespace {

constexpr std::uint32_t kRound = 8;  // samples between two looks at clock and noise
constexpr std::uint32_t kSure = 16;  // samples and looks that miss no edge

class Renderer {
 public:
  Renderer(const PathSetting& setting, const View& view, const RenderOptions& options,
           const SampleMap& samples, const Rows& rows, Film& film)
      : setting_(setting),
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
    if (options_.looks > 0) look_again();
  }

 private:
  // False when all tiles have enough.
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

  struct Found {
    std::size_t pixel;
    FeatureSums feature_sums;
    std::uint32_t material;
  };

  // Edges and textures are finer than samples tell.
  void look_again() {
    std::vector<std::vector<Found>> found(done_.size());
    parallel_ordered(
        done_.size(), options_.jobs,
        [&](std::size_t tile) {
          for_pixels(static_cast<std::uint32_t>(tile), [&](std::uint32_t x, std::uint32_t y) {
            if (const auto seen = look_at(x, y)) found[tile].push_back(*seen);
          });
        },
        [&](std::size_t tile) {
          for (const auto& [pixel, feature_sums, material] : found[tile]) {
            film_.add_sights(pixel, feature_sums, material);
          }
          found[tile] = {};
        });
  }

  // Nothing where all that is seen is alike.
  std::optional<Found> look_at(std::uint32_t x, std::uint32_t y) const {
    const std::size_t pixel = std::size_t{y} * options_.width + x;
    const std::uint32_t enough = std::min(kSure, options_.samples);
    PixelSums sums = film_.at(pixel);
    FeatureSums seen;
    for (std::uint32_t i = 0; i < options_.looks; ++i) {
      if (sums.clear || (sums.feature_sums.count >= enough && !sums.is_mixed())) return {};
      const auto [ray, point, random] = sample_of(x, y, samples_.samples(x, y) + i);
      const PathSample sample = sample_features(setting_, ray, point, random);
      add(seen, sample);
      add_sight(sums, sample);
    }
    return Found{pixel, seen, sums.material};
  }

  template <class Visit>
  void for_pixels(std::uint32_t tile, const Visit& visit) const {
    const std::uint32_t left = tile % columns_ * kTileWidth;
    const std::uint32_t top = rows_.first + tile / columns_ * kTileHeight;
    for (std::uint32_t y = top; y < std::min(top + kTileHeight, rows_.last); ++y) {
      for (std::uint32_t x = left; x < std::min(left + kTileWidth, options_.width); ++x)
        visit(x, y);
    }
  }

  void report(double part) {
    if (options_.progress) options_.progress(part);
  }

  // The worst row of a tile tells whether it has enough.
  void render_tile(std::uint32_t tile, std::uint32_t first, std::uint32_t last) {
    std::array<double, kTileHeight> errors{};
    for_pixels(tile, [&](std::uint32_t x, std::uint32_t y) {
      const std::uint32_t end = std::min(last, samples_.samples(x, y));
      for (std::uint32_t sample = first; sample < end; ++sample) render_sample(x, y, sample);
      errors[(y - rows_.first) % kTileHeight] += visible_error(std::size_t{y} * options_.width + x);
    });
    const double worst = *std::max_element(errors.begin(), errors.end()) / kTileWidth;
    if (options_.noise > 0 && last >= 2 * kRound && worst < options_.noise) done_[tile] = 1;
  }

  // The error as it is seen in the finished picture.
  double visible_error(std::size_t pixel) const {
    if (options_.noise <= 0) return 0;
    const double error = film_.error(pixel);
    const Rgb mean = film_.radiance(pixel);
    const double y = luminance(mean);
    return shown_luminance(y + error) - shown_luminance(y);
  }

  CameraSample sample_of(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    return camera_sample(view_, options_.width, options_.height, options_.seed, x, y, sample);
  }

  void render_sample(std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
    const auto [ray, point, random] = sample_of(x, y, sample);
    film_.add(std::size_t{y} * options_.width + x, trace_path(setting_, ray, point, random));
  }

  bool out_of_time() const {
    if (options_.seconds <= 0) return false;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
    return passed.count() >= options_.seconds;
  }

  const PathSetting& setting_;
  const View& view_;
  const RenderOptions& options_;
  const SampleMap& samples_;
  const Rows rows_;
  Film& film_;
  std::uint32_t columns_;
  std::vector<std::uint8_t> done_;  // tiles; not bool, of which neighbours share a byte
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

void render_rows(const PathSetting& setting, const View& view, const RenderOptions& options,
                 const SampleMap& samples, const Rows& rows, Film& film) {
  Renderer(setting, view, options, samples, rows, film).run();
}

Film render(const PathSetting& setting, const View& view, const RenderOptions& options) {
  Film film(options.width, options.height);
  render_rows(setting, view, options, SampleMap(options.samples), film.held(), film);
  return film;
}

}  // namespace gltfx::bake

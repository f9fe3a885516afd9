// SPDX-License-Identifier: Apache-2.0
#include "pipeline/picture_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "pipeline/bake_picture.hpp"

namespace gltfx {
namespace {

constexpr std::uint32_t kSide = 64;   // pixels
constexpr std::uint32_t kSquare = 8;  // pixels
constexpr std::uint32_t kSamples = 24;
constexpr std::uint32_t kViews = 2;
// Of 150 pairs of seeds for the legacy fixtures, the greatest difference was 2.1 times that of the
// first pair. One step is what rounding can do.
constexpr double kNoiseFactor = 3;
constexpr double kRounding = 1;

// The mean difference of one channel over a square.
double mean_difference(const preview::Picture& a, const preview::Picture& b, std::size_t first) {
  double sum = 0;
  for (std::uint32_t y = 0; y < kSquare; ++y) {
    for (std::uint32_t x = 0; x < kSquare; ++x) {
      const std::size_t at = first + (std::size_t{y} * a.width + x) * a.channels;
      sum += static_cast<double>(a.bytes[at]) - static_cast<double>(b.bytes[at]);
    }
  }
  return std::fabs(sum) / (kSquare * kSquare);
}

double greatest_difference(const preview::Picture& a, const preview::Picture& b) {
  double greatest = 0;
  for (std::uint32_t y = 0; y < a.height; y += kSquare) {
    for (std::uint32_t x = 0; x < a.width; x += kSquare) {
      for (std::uint32_t channel = 0; channel < 3; ++channel) {
        const std::size_t first = (std::size_t{y} * a.width + x) * a.channels + channel;
        greatest = std::max(greatest, mean_difference(a, b, first));
      }
    }
  }
  return greatest;
}

}  // namespace

PictureCheck::PictureCheck(const validate::ValidatedAsset& before, const std::string& root,
                           std::shared_ptr<const schema::Set> schemas, unsigned jobs) {
  options_.sizes = {{kSide, kSide}};
  options_.turntable = kViews;
  options_.samples = kSamples;
  options_.denoise = false;  // noise is to be measured
  options_.root = root;
  options_.schemas = std::move(schemas);
  options_.jobs = jobs;
  const BakeScene scene = load_bake_scene_of(before, options_);
  if (!scene.ready()) {
    obstacle_ = scene.report.error;
    return;
  }
  views_ = *choose_views(scene, options_, 1);
  double noise = 0;
  for (const render::View& view : views_) {
    pictures_.push_back(draw(scene, view, 0));
    noise = std::max(noise, greatest_difference(pictures_.back(), draw(scene, view, 1)));
  }
  limit_ = kRounding + kNoiseFactor * noise;
  subject_ = scene.subject;
  subject_->forget_faces();
}

std::string PictureCheck::find_difference(const validate::ValidatedAsset& after) const {
  BakeScene scene = load_bake_scene_of(after, options_);
  if (!scene.ready()) return "the new asset cannot be drawn: " + scene.report.error;
  scene.subject = subject_;  // lit and framed as before
  double difference = 0;
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const preview::Picture now = draw(scene, views_[i], 0);
    difference = std::max(difference, greatest_difference(pictures_[i], now));
  }
  if (difference <= limit_) return {};
  return fmt::format(
      "the picture would change by {:.1f} of 255 steps; noise explains at most {:.1f}", difference,
      limit_);
}

preview::Picture PictureCheck::draw(const BakeScene& scene, const render::View& view,
                                    std::uint32_t seed) const {
  BakeOptions options = options_;
  options.seed = seed;
  return preview::tone_mapped_picture(
      draw_picture(scene, view, options_.sizes.front(), options, {}, {}), false,
      preview::PixelType::bytes);
}

}  // namespace gltfx

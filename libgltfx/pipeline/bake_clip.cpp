// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_clip.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/result.hpp"
#include "base/text.hpp"
#include "model/keyframes.hpp"
#include "pipeline/bake_names.hpp"

namespace gltfx {
namespace {

constexpr std::uint32_t kFramed = 8;  // frames that decide where the camera is

double rate_of_clip(const BakeOptions& options) { return options.fps > 0 ? options.fps : 24; }

Result<std::optional<std::uint32_t>> find_clip(const model::OpenedAsset& asset,
                                               const BakeOptions& options) {
  const model::Asset document(asset.document());
  return find_named("animation", options.clip, names_in(document, model::RootArray::animations));
}

// A clip that is repeated does not end with its first frame.
Result<std::uint32_t> count_frames(const model::OpenedAsset& asset, std::uint32_t animation,
                                   const BakeOptions& options) {
  const model::Views& views = asset.views();
  const double seconds =
      model::duration_of(model::Asset(asset.document()), views, views.animations[animation]);
  const double frames = std::max(1.0, std::round(seconds * rate_of_clip(options)));
  if (frames <= kMostBakeFrames) return static_cast<std::uint32_t>(frames);
  return Error{fmt::format("animation {} has {} frames, but the maximum is {}; use a lower --fps",
                           quoted(options.clip, 60), frames, kMostBakeFrames)};
}

void enlarge(std::optional<preview::Subject>& all, std::optional<preview::Subject> more) {
  if (!more) return;
  if (!all) {
    all = std::move(more);
    return;
  }
  all->points.insert(all->points.end(), more->points.begin(), more->points.end());
  all->faces.insert(all->faces.end(), more->faces.begin(), more->faces.end());
  const auto widen = [](Vec3d& least, Vec3d& greatest, const Vec3d& point) {
    least = {std::min(least.x, point.x), std::min(least.y, point.y), std::min(least.z, point.z)};
    greatest = {std::max(greatest.x, point.x), std::max(greatest.y, point.y),
                std::max(greatest.z, point.z)};
  };
  widen(all->least, all->greatest, more->least);
  widen(all->least, all->greatest, more->greatest);
  all->flat = all->flat && more->flat;
}

// Of an asset that lacks the clip.
BakeScene load_still(validate::ValidatedAsset asset, const BakeOptions& options,
                     const Error& reason) {
  const bool others = !asset.asset().views().animations.empty();
  BakeOptions still = options;
  still.clip.clear();
  BakeScene scene = load_bake_scene(std::move(asset), still);
  if (others) scene.report.notes.push_back(reason.message);
  return scene;
}

}  // namespace

BakeOptions Clip::options_of(std::uint32_t frame) const {
  BakeOptions options = options_;
  options.animation = std::exchange(options.clip, {});
  options.time = frame / rate_of_clip(options);
  return options;
}

BakeScene Clip::scene_of(std::uint32_t frame, const preview::Subject& subject,
                         const Vec3d& origin) const {
  const BakeOptions options = options_of(frame);
  BakeScene scene = build_bake_scene(asset_, {}, options, origin);
  if (scene.scene) scene.subject = scene.framed = subject;
  return prepare_bake_scene(std::move(scene), options);
}

double frame_rate(const BakeOptions& options) {
  if (!options.clip.empty()) return rate_of_clip(options);
  return options.fps > 0 ? options.fps : 12;
}

BakeScene load_clip(validate::ValidatedAsset asset, const BakeOptions& options) {
  const auto animation = find_clip(asset.asset(), options);
  if (!animation && options.if_present) {
    return load_still(std::move(asset), options, animation.error());
  }
  const auto frames = animation ? count_frames(asset.asset(), **animation, options)
                                : Result<std::uint32_t>(animation.error());
  if (!frames) {
    BakeScene failed;
    failed.report.path = failed.report.validation.path = asset.asset().name();
    failed.report.problem = BakeProblem::refused;
    failed.report.error = frames.error().message;
    return failed;
  }
  auto clip = std::make_shared<const Clip>(std::move(asset), options, *frames);
  BakeScene first = load_bake_scene_of(clip->asset(), clip->options_of(0));
  if (!first.ready()) return first;
  const std::uint32_t steps = std::min(kFramed, *frames);
  for (std::uint32_t i = 1; i < steps; ++i) {
    const BakeOptions moment = clip->options_of(i * (*frames - 1) / (steps - 1));
    BakeScene later = build_bake_scene(clip->asset(), {}, moment, first.origin);
    if (first.framed && later.scene && !later.scene->framed.empty()) {
      enlarge(first.framed, preview::find_subject(*later.scene, preview::Which::framed));
    }
    enlarge(first.subject, std::move(later.subject));
  }
  first.clip = std::move(clip);
  return first;
}

}  // namespace gltfx

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
#include "preview/framing_faces.hpp"
#include "preview/markers.hpp"

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
  preview::FaceBox box{all->least, all->greatest};
  box.add(more->least);
  box.add(more->greatest);
  all->least = box.least;
  all->greatest = box.greatest;
  all->flat = all->flat && more->flat;
}

// Those of the scene of a frame.
BakeOptions options_at(BakeOptions options, std::uint32_t frame) {
  options.animation = std::exchange(options.clip, {});
  options.time = frame / rate_of_clip(options);
  return options;
}

// What is visible in some frames of a clip, all of them together.
struct Extent {
  std::optional<preview::Subject> all, framed;
  std::optional<Vec3d> origin;  // of the first frame in which anything is visible
  bool markers = false;         // some of it are

  const preview::Subject* subject() const { return framed ? &*framed : all ? &*all : nullptr; }
};

// `radius`: of markers; 0: not known yet.
Result<Extent> find_extent(const validate::ValidatedAsset& asset, const BakeOptions& options,
                           std::uint32_t frames, double radius) {
  Extent extent;
  const std::uint32_t steps = std::min(kFramed, frames);
  for (std::uint32_t i = 0; i < steps; ++i) {
    const std::uint32_t frame = i * (frames - 1) / std::max(steps - 1, 1U);
    auto outline = build_outline(asset, options_at(options, frame), extent.origin);
    if (!outline) return outline.error();
    if (preview::has_markers(outline->scene)) {
      extent.markers = true;
      preview::give_markers_size(outline->scene, radius);
      outline->subject = preview::find_subject(outline->scene);
    }
    if (!outline->subject) continue;
    if (!extent.origin) extent.origin = outline->origin;
    if (!outline->scene.framed.empty()) {
      enlarge(extent.framed, preview::find_subject(outline->scene, preview::Which::framed));
    }
    enlarge(extent.all, std::move(outline->subject));
  }
  return extent;
}

struct Staging {
  ClipStage stage;
  Extent extent;
};

Result<Staging> find_staging(const validate::ValidatedAsset& asset, const BakeOptions& options,
                             std::uint32_t frames) {
  auto extent = find_extent(asset, options, frames, 0);
  if (!extent) return extent.error();
  ClipStage stage{extent->origin.value_or(Vec3d())};
  if (extent->subject() != nullptr) {  // other frames may have markers
    const BakeSize& size = options.sizes.front();
    stage.marker_radius =
        preview::marker_radius(*extent->subject(), std::max(size.width, size.height));
  }
  if (extent->markers && stage.marker_radius > 0) {
    extent = find_extent(asset, options, frames, stage.marker_radius);
    if (!extent) return extent.error();
  }
  if (extent->all) stage.size = extent->all->size();
  return Staging{stage, *std::move(extent)};
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

BakeScene Clip::scene_of(std::uint32_t frame, const preview::Subject& subject) const {
  const BakeOptions options = options_at(options_, frame);
  BakeScene scene = build_bake_scene(asset_, {}, options, &stage_);
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
  const auto refused = [&asset](const Error& reason) {
    return failed_scene(asset.asset().name(), BakeProblem::refused, reason.message);
  };
  if (!frames) return refused(frames.error());
  const BakeOptions start = options_at(options, 0);
  BakeScene begun = begin_bake_scene(asset, asset.report(), start);
  if (begun.report.problem != BakeProblem::none) return begun;
  auto staging = find_staging(asset, options, *frames);
  if (!staging) return refused(staging.error());
  BakeScene first = build_bake_scene(asset, asset.report(), start, &staging->stage);
  if (!first.scene) return first;
  first.subject = std::move(staging->extent.all);
  first.framed = std::move(staging->extent.framed);
  first = prepare_bake_scene(std::move(first), start);
  if (first.ready()) {
    first.clip = std::make_shared<const Clip>(std::move(asset), options, *frames, staging->stage);
  }
  return first;
}

}  // namespace gltfx

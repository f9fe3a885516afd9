// SPDX-License-Identifier: Apache-2.0
/// An animation as a sequence of scenes.
#pragma once

#include <gltfx/bake.hpp>

#include <cstdint>
#include <utility>

#include "pipeline/bake_scene.hpp"
#include "rules/validated_asset.hpp"

namespace gltfx {

/// The frames of BakeOptions::clip.
class Clip {
 public:
  Clip(validate::ValidatedAsset asset, BakeOptions options, std::uint32_t frames,
       const ClipStage& stage)
      : asset_(std::move(asset)), options_(std::move(options)), frames_(frames), stage_(stage) {}

  std::uint32_t frames() const { return frames_; }
  /// The scene of a frame, ready even where nothing is visible in it. `subject`: of all frames.
  BakeScene scene_of(std::uint32_t frame, const preview::Subject& subject) const;

 private:
  validate::ValidatedAsset asset_;
  BakeOptions options_;
  std::uint32_t frames_;
  ClipStage stage_;
};

/// Frames a second of a turntable or clip.
double frame_rate(const BakeOptions& options);

/// The first frame of the clip, with the subject of all frames; nothing need be visible in it.
BakeScene load_clip(validate::ValidatedAsset asset, const BakeOptions& options);

}  // namespace gltfx

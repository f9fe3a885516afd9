// SPDX-License-Identifier: Apache-2.0
/// An animation as a sequence of scenes.
#pragma once

#include <gltfx/bake.hpp>

#include <cstdint>
#include <optional>

#include "pipeline/bake_scene.hpp"
#include "rules/validated_asset.hpp"

namespace gltfx {

/// The frames of BakeOptions::clip.
class Clip {
 public:
  Clip(validate::ValidatedAsset asset, BakeOptions options, std::uint32_t frames)
      : asset_(std::move(asset)), options_(std::move(options)), frames_(frames) {}

  std::uint32_t frames() const { return frames_; }
  const validate::ValidatedAsset& asset() const { return asset_; }
  /// The options of the scene of a frame.
  BakeOptions options_of(std::uint32_t frame) const;
  /// The scene of a frame, ready even where nothing is visible in it. `subject`: of all frames,
  /// around `origin`.
  BakeScene scene_of(std::uint32_t frame, const preview::Subject& subject,
                     const Vec3d& origin) const;

 private:
  validate::ValidatedAsset asset_;
  BakeOptions options_;
  std::uint32_t frames_;
};

/// Frames a second of a turntable or clip.
double frame_rate(const BakeOptions& options);

/// The first frame of the clip, with the subject of all frames.
BakeScene load_clip(validate::ValidatedAsset asset, const BakeOptions& options);

}  // namespace gltfx

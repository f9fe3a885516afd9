// SPDX-License-Identifier: Apache-2.0
/// From an opened asset to what the renderer draws: one scene at one moment.
#pragma once

#include <gltfx/vec3.hpp>

#include <cstdint>
#include <optional>
#include <string>

#include "preview/framing.hpp"
#include "render/scene.hpp"
#include "rules/validated_asset.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// What is to be drawn. Numbers beyond the asset's own count as absent.
struct SceneOptions {
  std::optional<std::uint32_t> scene;      ///< else the default scene
  std::optional<std::uint32_t> animation;  ///< else everything as it is written
  double time = 0;                         ///< of the animation, in seconds
  std::optional<std::uint32_t> variant;    ///< of materials
  /// What is chosen in external assets, which have indices of their own.
  struct InExternalAssets {
    std::string variant, animation;  ///< names; empty: none
    bool pose = false;               ///< that of find_pose(), in place of an animation
  } external;
  std::optional<std::uint32_t> frame;  ///< node whose subtree the picture is of; else all
  bool uvs = false;                    ///< texture coordinates also where no texture is
  bool textures = true;                ///< else their images are not decoded
  bool environment = true;             ///< else the scene has none
  /// BuiltScene::origin; nothing: one that suits the scene.
  std::optional<Vec3d> origin;
  unsigned jobs = 0;  ///< threads; 0: as many as are worth it
  /// Pixels along the longer side of pictures of the whole scene: images are decoded with the
  /// detail that these show. 0: with all there is.
  std::uint32_t picture_side = 0;
  /// Size of what these pictures show, where it is more than this moment of the scene; 0: as large
  /// as the scene.
  double shown_size = 0;
  /// Most bytes that meshes, their poses and their instances may take, with all that rays need of
  /// them, beside 16 for each byte of the asset's buffers (32 where geometry is compressed).
  std::uint64_t free_bytes = std::uint64_t{192} << 20U;
  /// Most bytes of pixels, beside 32 for each byte of buffers and images.
  std::uint64_t free_pixel_bytes = std::uint64_t{1} << 30U;
};

struct BuiltScene {
  render::Scene scene;
  std::optional<preview::Subject> subject;  ///< as preview::find_subject() finds it there
  /// What is at 0 there, in the coordinates of the asset; 0 unless the asset is far from it.
  Vec3d origin;
  bool complete = true;  ///< no part was left out
};

/// Reads, decodes and poses what is visible. What is invalid is left out, and named in the notes
/// of the scene, as is all else that is not drawn. External assets are drawn at their nodes.
/// Nothing outside of the resolver's root is opened; images and Draco bitstreams are decoded by
/// worker processes. Keeps no reference. Precondition: the asset has a document.
BuiltScene build_scene(const validate::ValidatedAsset& validated, const schema::Set& schemas,
                       const SceneOptions& options);

}  // namespace gltfx

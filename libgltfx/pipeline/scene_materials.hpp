// SPDX-License-Identifier: Apache-2.0
/// Materials of an asset as those of a scene.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "bake/scene.hpp"
#include "model/material.hpp"
#include "pipeline/scene_textures.hpp"

namespace gltfx {

/// What meshes need to know of their material.
struct MaterialNeeds {
  std::uint32_t material = bake::kNone;  ///< index in the scene
  /// The n of each TEXCOORD_n that is read. The material's uses count along this list.
  std::vector<std::uint32_t> tex_coords;
  /// What tangents are needed for, if any: its set is in the list above.
  std::optional<bake::TextureUse> tangents;
};

/// Translates each material that is used once. The asset, the scene and the textures must outlive
/// it.
class SceneMaterials {
 public:
  SceneMaterials(const model::Asset& asset, const model::AnimatedValues& animated,
                 SceneTextures& textures, bake::Scene& scene)
      : asset_(asset), animated_(animated), textures_(textures), scene_(scene) {}

  /// Of a material of the asset; nothing: the default material.
  const MaterialNeeds& use(const std::optional<std::uint32_t>& material);

 private:
  MaterialNeeds translate(const model::Material& material);

  const model::Asset& asset_;
  const model::AnimatedValues& animated_;
  SceneTextures& textures_;
  bake::Scene& scene_;
  std::unordered_map<std::uint32_t, MaterialNeeds> known_;
  MaterialNeeds default_;
};

}  // namespace gltfx

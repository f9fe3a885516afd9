// SPDX-License-Identifier: Apache-2.0
/// The material of a scene at a point of a surface: factors times textures.
#pragma once

#include <gltfx/material.hpp>

#include <optional>
#include <span>

#include "render/ray.hpp"
#include "render/scene.hpp"
#include "render/texture.hpp"

namespace gltfx::render {

/// Reads the texture slots of a material at one hit, by the texture coordinates of the mesh.
/// References and spans must outlive it.
class SlotReader {
 public:
  /// `uvs`: by set of the mesh, in place of those at the hit.
  SlotReader(const Scene& scene, const Mesh& mesh, const SceneMaterial& material, const Hit& hit,
             std::span<const Float2> uvs = {})
      : scene_(scene), mesh_(mesh), material_(material), hit_(hit), uvs_(uvs) {}

  const Mesh& mesh() const { return mesh_; }
  const SceneMaterial& material() const { return material_; }
  const Hit& hit() const { return hit_; }

  bool has(Slot slot) const { return material_.use(slot).texture != kNone; }
  /// Precondition of this and the next one: the slot has a texture.
  bool is_missing(Slot slot) const { return scene_.textures[material_.use(slot).texture].missing; }
  Float4 texel(Slot slot) const;
  /// Scales by the texture of the slot, if there is one.
  void scale(Rgb& value, Slot slot) const;
  /// Scales by one channel: that of the slot unless the use names another.
  void scale(double& value, Slot slot, std::uint32_t channel) const;

 private:
  Float2 uv_of(const TextureUse& use) const;
  const TexelPatch& patch_of(const Texture& texture, const Float2& uv) const;

  const Scene& scene_;
  const Mesh& mesh_;
  const SceneMaterial& material_;
  const Hit& hit_;
  std::span<const Float2> uvs_;  // empty: those at the hit
  // The last results: most slots of a material share them.
  mutable std::uint32_t set_ = kNone;
  mutable Float2 uv_{};  // of set_
  mutable const Texture* patched_ = nullptr;
  mutable Float2 patch_uv_{};
  mutable TexelPatch patch_;  // of patched_ at patch_uv_
};

/// All parameters except the normals, times the vertex colour.
Material material_at(const SlotReader& reader);

/// The normal of a normal map, scaled, in tangent space and of unit length; nothing if there is no
/// map. `slot`: normal or clearcoat_normal.
std::optional<Vec3d> mapped_normal(const SlotReader& reader, Slot slot);

}  // namespace gltfx::render

// SPDX-License-Identifier: Apache-2.0
/// The material of a scene at a point of a surface: factors times textures.
#pragma once

#include <gltfx/material.hpp>

#include <optional>

#include "bake/ray.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

/// All parameters but the normals. Texture coordinates and vertex colour are those of `mesh` at
/// `hit`.
Material material_at(const Scene& scene, const Mesh& mesh, const SceneMaterial& material,
                     const Hit& hit);

/// The normal that a normal map holds at the hit, scaled, in tangent space and of unit length;
/// nothing when there is no map. `slot`: normal or clearcoat_normal.
std::optional<Vec3d> mapped_normal(const Scene& scene, const Mesh& mesh,
                                   const SceneMaterial& material, const Hit& hit, Slot slot);

}  // namespace gltfx::bake

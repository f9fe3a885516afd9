// SPDX-License-Identifier: Apache-2.0
/// Alpha, and the culling of back faces.
#pragma once

#include "bake/ray.hpp"
#include "bake/scene.hpp"

namespace gltfx::bake {

/// The material of a mesh, or the default one.
const SceneMaterial& material_of(const Scene& scene, const Mesh& mesh);

/// Whether alpha can make holes into surfaces of the material.
bool has_holes(const SceneMaterial& material);

/// Whether rays from behind pass through surfaces of the material. The surface of a volume has two
/// sides whatever `doubleSided` says: light has to get out again.
bool is_culled(const SceneMaterial& material);

/// Texture coordinates and vertex colour at a hit; zeros and ones where the mesh has none.
Float2 uv_at(const Mesh& mesh, std::uint32_t set, const Hit& hit);
Float4 color_at(const Mesh& mesh, const Hit& hit);

/// The coverage at a hit by alpha and alphaMode, from 0 (a hole) to 1 (solid).
float coverage_at(const Scene& scene, const Mesh& mesh, const SceneMaterial& material,
                  const Hit& hit);

}  // namespace gltfx::bake

// SPDX-License-Identifier: Apache-2.0
/// Small scenes.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "render/scene.hpp"

namespace gltfx::render {

/// A square in the plane of x and y, its middle at the origin, front towards +z, uv from the upper
/// left.
inline Mesh quad(float half = 1) {
  Mesh mesh;
  mesh.positions = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}};
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  mesh.uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// An axis-aligned cube around the origin, flat, fronts outside.
inline Mesh cube(float half = 1) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < 8; ++i) {
    mesh.positions.push_back(
        {(i & 1U) != 0 ? half : -half, (i & 2U) != 0 ? half : -half, (i & 4U) != 0 ? half : -half});
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A sphere around the origin of `rings` times twice as many fields, with smooth normals.
inline Mesh sphere(float radius = 1, std::uint32_t rings = 24) {
  Mesh mesh;
  const std::uint32_t columns = rings * 2;
  mesh.uvs.emplace_back();
  for (std::uint32_t row = 0; row <= rings; ++row) {
    const float v = static_cast<float>(row) / static_cast<float>(rings);
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const float u = static_cast<float>(column) / static_cast<float>(columns);
      const float ring = std::sin(v * std::numbers::pi_v<float>);
      const Float3 n{ring * std::sin(u * 2 * std::numbers::pi_v<float>),
                     std::cos(v * std::numbers::pi_v<float>),
                     ring * std::cos(u * 2 * std::numbers::pi_v<float>)};
      mesh.normals.push_back(n);
      mesh.positions.push_back({n[0] * radius, n[1] * radius, n[2] * radius});
      mesh.uvs[0].push_back({u, v});
      if (row == rings || column == columns) continue;
      const std::uint32_t at = row * (columns + 1) + column;
      const std::uint32_t below = at + columns + 1;
      if (row > 0) mesh.triangles.push_back({at, below, at + 1});
      if (row + 1 < rings) mesh.triangles.push_back({at + 1, below, below + 1});
    }
  }
  return mesh;
}

inline Matrix34 moved(float x, float y, float z, float scale = 1) {
  return {{{scale, 0, 0, x}, {0, scale, 0, y}, {0, 0, scale, z}}};
}

/// One mesh with one material, once.
inline Scene scene_of(Mesh mesh, SceneMaterial material = {}) {
  Scene scene;
  mesh.material = 0;
  scene.meshes.push_back(std::move(mesh));
  scene.materials.push_back(std::move(material));
  scene.instances.push_back({0, kIdentity});
  return scene;
}

}  // namespace gltfx::render

// SPDX-License-Identifier: Apache-2.0
/// Rooms and furniture for them.
#pragma once

#include <utility>

#include "pipeline/baking.hpp"

namespace gltfx::test {

/// An axis-aligned box from one corner to the other; fronts outside, or inside for a room.
inline render::Mesh box(const Float3& from, const Float3& to, bool inside = false) {
  render::Mesh mesh = render::cube();
  for (Float3& p : mesh.positions) {
    for (std::size_t i = 0; i < 3; ++i) p[i] = p[i] < 0 ? from[i] : to[i];
  }
  if (!inside) return mesh;
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  for (Float3& normal : mesh.normals) {
    for (float& component : normal) component = -component;
  }
  return mesh;
}

/// A bed, a wardrobe, a table with a ball on it, a carpet.
inline void furnish(AssetText& asset) {
  asset.draw(box({-1.4F, 0, -1.9F}, {0.2F, 0.5F, 0.2F}), dielectric({0.8, 0.8, 0.75, 1}, 0.8));
  asset.draw(box({-1.4F, 0.5F, -1.9F}, {0.2F, 0.65F, -1.3F}), dielectric({0.6, 0.2, 0.2, 1}, 0.8));
  asset.draw(box({1.3F, 0, -1.9F}, {2.3F, 2, -1.3F}), dielectric({0.4, 0.25, 0.15, 1}, 0.4));
  asset.draw(box({0.9F, 0.7F, 0.3F}, {2.1F, 0.75F, 1.2F}), dielectric({0.5, 0.35, 0.2, 1}, 0.3));
  for (const float x : {0.95F, 2.0F}) {
    for (const float z : {0.35F, 1.1F}) {
      asset.draw(box({x, 0, z}, {x + 0.06F, 0.7F, z + 0.06F}), dielectric({0.3, 0.2, 0.1, 1}, 0.5));
    }
  }
  asset.draw(render::sphere(0.2F, 16), dielectric({0.2, 0.4, 0.8, 1}, 0.2),
             {{"translation", {1.5, 0.95, 0.7}}});
  asset.draw(box({-1.8F, 0, 0.4F}, {0.5F, 0.02F, 1.8F}), dielectric({0.3, 0.35, 0.5, 1}, 1));
}

/// 5 by 2.6 by 4 metres, its walls single-sided with their fronts inside, or double-sided.
inline AssetText room(bool double_sided, bool furnished = true) {
  AssetText asset;
  Json wall = dielectric({0.85, 0.8, 0.7, 1}, 0.9);
  wall["doubleSided"] = double_sided;
  asset.draw(box({-2.5F, 0, -2}, {2.5F, 2.6F, 2}, true), wall);
  if (furnished) furnish(asset);
  return asset;
}

}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
/// Bodies and sheets as assets, for tests of measures.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "measure/measured.hpp"
#include "model/packed_bytes.hpp"

namespace gltfx::measure::test {

/// Triangles over vertices.
struct Body {
  std::vector<std::array<float, 3>> places;
  std::vector<std::uint32_t> corners;  ///< three a triangle, or as the mode says
  int mode = 4;
};

/// The corners of a cube from (x, y, z), one long: twelve triangles that face outwards.
inline Body cube(float x = 0, float y = 0, float z = 0) {
  Body body;
  for (int i = 0; i < 8; ++i) {
    body.places.push_back({x + static_cast<float>(i & 1), y + static_cast<float>(i >> 1 & 1),
                           z + static_cast<float>(i >> 2)});
  }
  body.corners = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return body;
}

inline Body both(Body one, const Body& other) {
  const auto begin = static_cast<std::uint32_t>(one.places.size());
  one.places.insert(one.places.end(), other.places.begin(), other.places.end());
  for (const std::uint32_t corner : other.corners) one.corners.push_back(corner + begin);
  return one;
}

/// Adds an accessor with the places and returns its index.
inline std::size_t add_places(gltfx::test::AssetBuilder& asset, const Body& body) {
  std::string bytes;
  for (const auto& place : body.places) {
    bytes += gltfx::test::floats({place[0], place[1], place[2]});
  }
  return asset.accessor("VEC3", 5126, body.places.size(), bytes);
}
/// The same of the corners.
inline std::size_t add_corners(gltfx::test::AssetBuilder& asset, const Body& body) {
  return asset.accessor("SCALAR", 5125, body.corners.size(), gltfx::test::packed(body.corners));
}
/// A primitive; without corners it has no indices.
inline gltfx::test::AssetBuilder::Json add_primitive(gltfx::test::AssetBuilder& asset,
                                                     const Body& body) {
  gltfx::test::AssetBuilder::Json primitive;
  primitive["attributes"]["POSITION"] = add_places(asset, body);
  if (!body.corners.empty()) primitive["indices"] = add_corners(asset, body);
  if (body.mode != 4) primitive["mode"] = body.mode;
  return primitive;
}

/// One mesh with a primitive for each body.
inline gltfx::test::AssetBuilder asset_of(const std::vector<Body>& bodies) {
  gltfx::test::AssetBuilder asset;
  gltfx::test::AssetBuilder::Json mesh;
  for (const Body& body : bodies) mesh["primitives"].push_back(add_primitive(asset, body));
  asset.add("meshes", mesh);
  return asset;
}

}  // namespace gltfx::measure::test

// SPDX-License-Identifier: Apache-2.0
/// Assets of triangles with texture coordinates.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "image/png_builder.hpp"
#include "measure/uv_plane.hpp"
#include "model/packed_bytes.hpp"
#include "support/asset_builder.hpp"

namespace gltfx::test {

using UvTriangles = std::vector<measure::UvTriangle>;

/// Two triangles from corner to corner, not mirrored.
inline UvTriangles quad(float u0, float v0, float u1, float v1) {
  return {{{{u0, v1}, {u1, v1}, {u1, v0}}}, {{{u0, v1}, {u1, v0}, {u0, v0}}}};
}
inline UvTriangles operator+(UvTriangles all, const UvTriangles& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// A mesh with one primitive for each material, drawn by one node.
struct UvAsset {
  using Json = AssetBuilder::Json;

  UvAsset() {
    made.json["scene"] = 0;
    made.json["scenes"][0]["nodes"] = {0};
    made.json["nodes"][0]["mesh"] = 0;
  }

  /// A primitive with triangles of their own vertices; they cover in space what they cover in the
  /// texture. `material`: an index, or -1.
  UvAsset& add(const UvTriangles& triangles, int material = 0, float size = 1,
               const std::string& set = "TEXCOORD_0") {
    std::vector<float> uv, positions;
    for (const measure::UvTriangle& triangle : triangles) {
      for (const auto& [u, v] : triangle) {
        uv.insert(uv.end(), {u, v});
        const bool finite = std::isfinite(u) && std::isfinite(v);
        positions.insert(positions.end(), {finite ? size * u : 0, finite ? -size * v : 1, 0});
      }
    }
    const std::size_t count = triangles.size() * 3;
    Json primitive;
    primitive["attributes"]["POSITION"] = made.accessor("VEC3", 5126, count, packed(positions));
    if (!set.empty()) primitive["attributes"][set] = made.accessor("VEC2", 5126, count, packed(uv));
    if (material >= 0) primitive["material"] = material;
    made.json["meshes"][0]["primitives"].push_back(primitive);
    return *this;
  }
  /// A material whose texture is an image of that many pixels, of which there is the header only.
  UvAsset& texture(std::uint32_t width, std::uint32_t height,
                   const Json& sampler = Json::object()) {
    PngHeader header;
    header.width = width;
    header.height = height;
    return texture(png({}, header), sampler);
  }
  /// A base color texture of that PNG.
  UvAsset& texture(const std::string& image, const Json& sampler = Json::object()) {
    const auto view = made.view(image);
    const auto source = made.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    const auto own = made.add("samplers", sampler);
    const auto index = made.add("textures", {{"source", source}, {"sampler", own}});
    made.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", index}}}}}});
    return *this;
  }
  /// Members of the node.
  UvAsset& node(const Json& members) {
    made.json["nodes"][0].update(members);
    return *this;
  }
  std::string text() const { return made.text(buffer_uri(made.bytes)); }

  AssetBuilder made;
};

}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
/// Drawn assets with pictures: for rules about textures, and what triangles show of them.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "codec/support/png_encoder.hpp"
#include "rules/shows_assets.hpp"

namespace gltfx::test {

using Pair = std::array<float, 2>;
using Texel = std::array<int, 4>;
using Painter = std::function<Texel(int x, int y)>;

inline Json textured_base(const Json& texture, const Json& more = Json::object()) {
  Json base{{"baseColorTexture", texture}, {"metallicFactor", 0}};
  base.update(more);
  return base;
}

/// Usually fewer than of other assets: each is decoded.
inline unsigned picture_draws() {
  constexpr unsigned kUsual = 8;
  return std::getenv("GLTFX_DRAWS") == nullptr ? kUsual : draws();
}
inline void expect_found_in_pictures(const std::string& code, const std::string& pointer,
                                     const std::vector<Generator>& generators) {
  expect_found(code, pointer, generators, picture_draws());
}
inline void expect_silent_in_pictures(const std::vector<Generator>& generators) {
  expect_silent(generators, {"DUPLICATE_ACCESSORS"}, picture_draws());
}

/// A PNG of 8 bits; the color says how many of the four numbers of a texel it has.
inline std::string painted(int width, int height, PngColor color, const Painter& paint) {
  std::string texels;
  const std::size_t channels = color == PngColor::grey ? 1 : color == PngColor::rgb ? 3 : 4;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Texel texel = paint(x, y);
      for (std::size_t k = 0; k < channels; ++k) {
        texels += static_cast<char>(std::clamp(texel[k], 0, 255));
      }
    }
  }
  return encode_png(
      {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), color, 8, texels});
}

/// A texture info of a new texture.
inline Json texture_of(Drawn& drawn, const std::string& png, const std::string& name = {},
                       const Json& sampler = Json::object()) {
  Json image{{"uri", "data:image/png;base64," + base64(png)}};
  if (!name.empty()) image["name"] = name;
  Json texture{{"source", drawn.made.add("images", std::move(image))}};
  if (!sampler.empty()) texture["sampler"] = drawn.made.add("samplers", sampler);
  return {{"index", drawn.made.add("textures", std::move(texture))}};
}
/// Colors at random.
inline Json colors(Drawn& drawn, int size = 32, const Json& sampler = Json::object()) {
  return texture_of(
      drawn,
      painted(size, size, PngColor::rgb,
              [&](int, int) {
                return Texel{drawn.pick(0, 255), drawn.pick(0, 255), drawn.pick(0, 160), 255};
              }),
      {}, sampler);
}

/// A grid of triangles, and where each corner is in a texture.
struct UvSheet {
  std::vector<Point> points;
  std::vector<Pair> uvs;
  std::vector<std::uint16_t> corners;
};

inline UvSheet sheet_over(Drawn& drawn, double left, double top, double right, double bottom) {
  UvSheet sheet;
  const int columns = drawn.pick(2, 9);
  const int rows = drawn.pick(2, 9);
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const double u = static_cast<double>(column) / columns;
      const double v = static_cast<double>(row) / rows;
      sheet.points.push_back({static_cast<float>(u), static_cast<float>(-v),
                              static_cast<float>(drawn.number(0, 0.05))});
      sheet.uvs.push_back({static_cast<float>(left + u * (right - left)),
                           static_cast<float>(top + v * (bottom - top))});
      if (row == rows || column == columns) continue;
      const int at = row * (columns + 1) + column;
      for (const int corner :
           {at, at + columns + 1, at + 1, at + 1, at + columns + 1, at + columns + 2}) {
        sheet.corners.push_back(static_cast<std::uint16_t>(corner));
      }
    }
  }
  return sheet;
}
inline UvSheet whole_sheet(Drawn& drawn) { return sheet_over(drawn, 0, 0, 1, 1); }

/// A primitive with a material of its own.
inline Json primitive_of(Drawn& drawn, const UvSheet& sheet, const Json& material,
                         const Json& attributes = Json::object()) {
  Json primitive = drawn.primitive({sheet.points, sheet.corners});
  primitive["attributes"]["TEXCOORD_0"] = drawn.values("VEC2", sheet.uvs, {{"target", 34962}});
  primitive["attributes"].update(attributes);
  primitive["material"] = drawn.made.add("materials", material);
  return primitive;
}
inline void show(Drawn& drawn, const UvSheet& sheet, const Json& material,
                 const Json& attributes = Json::object()) {
  drawn.root({{"mesh", drawn.mesh(primitive_of(drawn, sheet, material, attributes))}});
}
inline void show(Drawn& drawn, const Json& material) { show(drawn, whole_sheet(drawn), material); }

}  // namespace gltfx::test

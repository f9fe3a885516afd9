// SPDX-License-Identifier: Apache-2.0
// Skins and textures that leave nothing to see.
#include "codec/support/png_encoder.hpp"
#include "rules/shows_assets.hpp"

namespace gltfx::test {
namespace {

Json along(double x, double y, double z) { return Json::array({x, y, z}); }

// A triangle that follows two joints, which have the members.
void skinned(Drawn& d, const Json& first, const Json& second) {
  Json primitive = d.primitive({{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {0, 1, 2}});
  const std::vector<std::uint8_t> joints{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0};
  primitive["attributes"]["JOINTS_0"] =
      d.made.accessor("VEC4", 5121, 3, packed(joints), Json::object(), {{"target", 34962}});
  primitive["attributes"]["WEIGHTS_0"] =
      d.values("VEC4", std::vector<Four>(3, Four{1, 0, 0, 0}), {{"target", 34962}});
  Json hip = first;
  hip["children"] = Json::array({1});
  d.root(hip);
  d.made.add("nodes", second);
  d.root({{"mesh", d.mesh(std::move(primitive))}, {"skin", 0}});
  d.made.add("skins", {{"joints", {0, 1}}});
}

TEST(NothingVisible, OfASkinIsFoundAtItsJoints) {
  const Json flat{{"scale", along(0, 0, 0)}};
  const Json sound{{"translation", along(0, 0, 0)}};
  expect_found("NOTHING_VISIBLE", "/nodes/0",
               {
                   [&](Drawn& d) { skinned(d, flat, sound); },
                   [&](Drawn& d) { skinned(d, flat, flat); },
                   [&](Drawn& d) {
                     skinned(d, {{"scale", along(0, d.number(1, 2), 0)}}, sound);
                   },
               });
  expect_silent({
      [&](Drawn& d) { skinned(d, sound, flat); },
      [&](Drawn& d) { skinned(d, sound, sound); },
      [&](Drawn& d) {
        skinned(d, {{"scale", along(1, d.number(0.1, 2), 0)}}, sound);
      },
  });
}

// A mesh with a texture of that alpha.
std::string textured(const std::string& mode, std::uint8_t alpha, double cutoff) {
  Drawn drawn(1);
  std::string texels(8 * 8 * 4, '\x7f');
  for (std::size_t i = 3; i < texels.size(); i += 4) texels[i] = static_cast<char>(alpha);
  texels[2] = '\x10';
  const std::size_t view = drawn.made.view(encode_png({8, 8, PngColor::rgba, 8, texels, {}}));
  drawn.made.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
  drawn.made.add("textures", {{"source", 0}});
  Json material{{"alphaMode", mode}};
  material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  if (mode == "MASK") material["alphaCutoff"] = cutoff;
  const Shape shape = drawn.shape(1);
  Json primitive = drawn.primitive(shape);
  primitive["attributes"]["TEXCOORD_0"] = drawn.values(
      "VEC2", std::vector<std::array<float, 2>>(shape.points.size()), {{"target", 34962}});
  primitive["material"] = drawn.made.add("materials", std::move(material));
  drawn.root({{"mesh", drawn.mesh(std::move(primitive))}});
  return drawn.text();
}

std::uint64_t warnings(const std::string& asset, PixelLevel pixels) {
  ValidateOptions options;
  options.select = {"NOTHING_VISIBLE"};
  options.pixels = pixels;
  return validate_bytes(asset, "test", options).counts.warnings;
}

TEST(NothingVisible, IsFoundInTexelsThatAreDecoded) {
  EXPECT_EQ(warnings(textured("BLEND", 0, 0), PixelLevel::needed), 1U);
  EXPECT_EQ(warnings(textured("BLEND", 0, 0), PixelLevel::headers), 0U);
  EXPECT_EQ(warnings(textured("BLEND", 1, 0), PixelLevel::needed), 0U);
  EXPECT_EQ(warnings(textured("MASK", 100, 0.5), PixelLevel::needed), 1U);
  EXPECT_EQ(warnings(textured("MASK", 200, 0.5), PixelLevel::needed), 0U);
  EXPECT_EQ(warnings(textured("OPAQUE", 0, 0), PixelLevel::needed), 0U);
}

}  // namespace
}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
// What the makers of models look at: edges, texture coordinates, density of texels, sides.
#include <gmock/gmock.h>

#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

class Overlays : public Baking {
 protected:
  Overlays() {
    options.sizes = {{40, 40}};
    options.samples = 16;
  }
  struct Color {
    int r = 0, g = 0, b = 0;
  };
  // `x` and `y` from -1 to 1, as the camera of the asset sees them.
  Color at(double x, double y) const {
    const auto column = static_cast<std::size_t>((x + 1) / 2 * 40);
    const auto row = static_cast<std::size_t>((1 - y) / 2 * 40);
    const std::uint8_t* p = &pixels_.bytes[(row * 40 + column) * 3];
    return {p[0], p[1], p[2]};
  }
  void draw(AssetText asset) {
    const BakeReport done = report(asset);
    ASSERT_EQ(done.problem, BakeProblem::none) << done.error;
    pixels_ = done.pixels;
  }
  static AssetText square(const Json& material, const Json& place = Json::object()) {
    AssetText asset;
    asset.draw(render::quad(), material, place);
    asset.orthographic(1.25, 5);
    return asset;
  }
  // A square whose base color has so many texels along a side, in a node of that scale.
  static AssetText textured(std::uint32_t texels, double scale) {
    const preview::Picture image{
        texels, texels, 3, std::vector<std::uint8_t>(std::size_t{texels} * texels * 3, 200), {}};
    AssetText asset = square({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}},
                             {{"scale", {scale, scale, scale}}});
    const auto png = gltfx::encode_png(image);
    EXPECT_TRUE(png);
    const int view = asset.add_view(*png);
    asset.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    asset.add("textures", {{"source", 0}});
    return asset;
  }

 private:
  BakedPixels pixels_;
};

TEST_F(Overlays, FrontsAreBlueAndBacksRed) {
  options.overlay = BakeOverlay::facing;
  const Json red = dielectric({1, 0, 0, 1}, 0.5);
  draw(square(red));
  EXPECT_GT(at(0, 0).b, at(0, 0).r + 100);
  const Json turned{{"rotation", {0, 1, 0, 0}}};
  draw(square(red, turned));
  EXPECT_GT(at(0, 0).r, at(0, 0).b + 100) << "a back that other pictures do not show";
  draw(square(red, {{"scale", {-1, 1, 1}}}));
  EXPECT_GT(at(0, 0).b, at(0, 0).r + 100) << "mirrored twice, by its order and its node";
}

TEST_F(Overlays, CoordinatesAreColorsAndSquares) {
  options.overlay = BakeOverlay::uv;
  draw(square(dielectric({0, 0, 0, 1}, 0.5)));
  // Squares are 0.2 wide in this picture; each second one is darker.
  const Color left_upper = at(-0.69, 0.69);
  const Color right_upper = at(0.71, 0.69);
  const Color left_lower = at(-0.69, -0.71);
  EXPECT_GT(right_upper.r, left_upper.r + 40) << "u grows to the right";
  EXPECT_GT(left_lower.g, left_upper.g + 40) << "v grows downwards";
  const Color first = at(-0.7, 0.5);
  const Color second = at(-0.5, 0.5);
  EXPECT_GT(std::abs(first.b - second.b), 30) << "two neighbours";
  AssetText plain;
  render::Mesh bare = render::quad();
  bare.uvs.clear();
  plain.draw(bare, plastic());
  plain.orthographic(1.25, 5);
  draw(plain);
  EXPECT_EQ(at(0.3, 0.2).r, at(0.3, 0.2).b) << "grey without coordinates";
}

TEST_F(Overlays, DensityIsTexelsAMetre) {
  options.overlay = BakeOverlay::density;
  options.cameras = {"front"};
  draw(textured(128, 1));  // 64 a metre
  EXPECT_GT(at(0, 0).b, 200);
  EXPECT_LT(at(0, 0).g, 40);
  draw(textured(128, 1.0 / 16));  // 1024
  EXPECT_GT(at(0, 0).g, 200);
  EXPECT_LT(std::max(at(0, 0).b, at(0, 0).r), 40);
  draw(textured(128, 1.0 / 256));  // 16384
  EXPECT_GT(at(0, 0).r, 200);
  EXPECT_LT(at(0, 0).g, 40);
  draw(square(plastic()));
  EXPECT_EQ(at(0.3, 0.2).r, at(0.3, 0.2).g) << "grey without a texture";
}

TEST_F(Overlays, ClayIsGreyAndWireframeHasEdges) {
  const Json red = dielectric({1, 0, 0, 0.2}, 0.1);
  options.overlay = BakeOverlay::clay;
  Json clear = red;
  clear["alphaMode"] = "BLEND";
  draw(square(clear));
  const Color clay = at(-0.4, 0.2);
  EXPECT_NEAR(clay.r, clay.b, 15);
  EXPECT_GT(clay.r, 90);
  options.overlay = BakeOverlay::wireframe;
  draw(square(clear));
  EXPECT_NEAR(at(-0.4, 0.2).r, clay.r, 12) << "between edges";
  EXPECT_LT(at(0.21, 0.21).r, clay.r - 60) << "the diagonal";
  EXPECT_LT(at(-0.79, 0).r, clay.r - 30) << "the left edge";
}

TEST_F(Overlays, LayersAndBackgroundsStay) {
  options.overlay = BakeOverlay::facing;
  options.layers = {BakeLayer::normal};
  options.background = {BakeBackground::Kind::color, {1, 2, 3}};
  options.output = (folder.path() / "a.png").native();
  AssetText asset = square(plastic());
  const BakeReport done = report(asset);
  ASSERT_EQ(done.problem, BakeProblem::none) << done.error;
  EXPECT_EQ(done.written.size(), 2U);
  EXPECT_THAT(std::vector<int>(done.pixels.bytes.begin(), done.pixels.bytes.begin() + 3),
              testing::ElementsAre(1, 2, 3));
}

}  // namespace
}  // namespace gltfx::test

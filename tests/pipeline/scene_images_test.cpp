// SPDX-License-Identifier: Apache-2.0
// Images are decoded once for all pictures that show them, and not for those that do not.
#include "pipeline/scene_images.hpp"

#include <variant>

#include "base/work_count.hpp"
#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

// Two pixels in PNG.
std::string pixels(std::uint8_t first) {
  const auto png = encode_png({2, 1, 3, {first, 10, 20, 30, 40, 50}, {}});
  EXPECT_TRUE(png);
  return png ? *png : std::string();
}

class ImagesOfPictures : public Baking {
 protected:
  ImagesOfPictures() {
    options.cameras = {"front"};
    options.quality = BakeQuality::draft;
    options.output = (folder.path() / "a.png").native();
  }

  // A square that turns for a second, with a texture of its own.
  BakeReport draw(std::uint8_t color) {
    AssetText asset;
    const int view = asset.add_view(pixels(color));
    asset.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    asset.add("textures", {{"source", 0}});
    render::Mesh square;
    square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    Json material = plastic();
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    const int node = asset.draw(square, material);
    const int times =
        asset.accessor("SCALAR", 5126, 2, floats({0, 1}), {{"min", {0}}, {"max", {1}}});
    const int turns = asset.accessor("VEC4", 5126, 2, floats({0, 0, 0, 1, 0, 0, 1, 0}));
    const Json channel{{"sampler", 0}, {"target", {{"node", node}, {"path", "rotation"}}}};
    asset.add("animations", {{"channels", Json::array({channel})},
                             {"samplers", Json::array({{{"input", times}, {"output", turns}}})}});
    return report(asset);
  }
  std::uint64_t decoded_by(std::uint8_t color) {
    const std::uint64_t before = work_count.decoded;
    const BakeReport done = draw(color);
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
    return work_count.decoded - before;
  }
};

TEST_F(ImagesOfPictures, AreDecodedOnceForAllFramesOfAClip) {
  surround(0.4F);
  options.clip = "0";
  options.fps = 9;
  EXPECT_EQ(decoded_by(1), 2U) << "the texture and the environment";
  EXPECT_EQ(decoded_by(2), 1U) << "the environment is that of the last picture";
  surround(0.6F);
  EXPECT_EQ(decoded_by(2), 1U) << "the file of the environment has changed";
}

TEST_F(ImagesOfPictures, AreNotDecodedForClay) {
  for (const BakeOverlay overlay : {BakeOverlay::clay, BakeOverlay::wireframe}) {
    options.overlay = overlay;
    EXPECT_EQ(decoded_by(3), 0U);
  }
}

TEST(SceneImages, KnowWhatOthersKeep) {
  SceneImages images(1);
  codec::ImageRequest request;
  const std::string png = pixels(4);
  request.bytes = std::as_bytes(std::span(png));
  request.format = codec::ImageFormat::png;
  request.pixels = true;
  request.origin = new_origin();
  const auto decode = [&] {
    const auto result = images.decode(codec::Client::shared(), request);
    const auto* image = std::get_if<codec::Image>(&result);
    EXPECT_NE(image, nullptr);
    return image == nullptr ? codec::Image() : *image;
  };
  const std::uint64_t before = work_count.decoded;
  codec::Image shown = decode();
  EXPECT_EQ(decode().pixels.data(), shown.pixels.data());
  EXPECT_EQ(work_count.decoded - before, 1U);
  shown = {};
  EXPECT_EQ(decode().pixels.size(), 6U);
  EXPECT_EQ(work_count.decoded - before, 2U) << "there is room for nothing";
}

}  // namespace
}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
// Images are decoded once for all pictures that show them, and not for those that do not.
#include "pipeline/scene_images.hpp"

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/work_count.hpp"
#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

std::string png_of(std::uint32_t width, std::uint32_t height, std::uint8_t first) {
  std::vector<std::uint8_t> bytes(std::size_t{width} * height * 3, 90);
  bytes[0] = first;
  const auto png = encode_png({width, height, 3, bytes, {}});
  EXPECT_TRUE(png);
  return png ? *png : std::string();
}

// Two pixels in PNG.
std::string pixels(std::uint8_t first) { return png_of(2, 1, first); }

class ImagesOfPictures : public Baking {
 protected:
  ImagesOfPictures() {
    options.cameras = {"front"};
    options.quality = BakeQuality::draft;
    options.output = (folder.path() / "a.png").native();
  }

  // A square with a texture.
  static int add_square(AssetText& asset, const std::string& image) {
    const int view = asset.add_view(image);
    asset.add("images", {{"bufferView", view}, {"mimeType", "image/png"}});
    asset.add("textures", {{"source", 0}});
    render::Mesh square;
    square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.uvs = {{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    Json material = plastic();
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    return asset.draw(square, material);
  }

  // A square that turns for a second, with a texture of its own.
  BakeReport draw(std::uint8_t color) {
    AssetText asset;
    const int node = add_square(asset, pixels(color));
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

// What moves away is in the picture, too: a pixel shows as much in all frames.
TEST_F(ImagesOfPictures, HaveOneDetailInAllFramesOfAClip) {
  AssetText asset;
  add_square(asset, png_of(512, 512, 7));
  const int moved = asset.draw(render::quad(0.25F), plastic());
  const int times = asset.accessor("SCALAR", 5126, 2, floats({0, 1}), {{"min", {0}}, {"max", {1}}});
  const int places = asset.accessor("VEC3", 5126, 2, floats({0, 0, 0, 40, 0, 0}));
  const Json channel{{"sampler", 0}, {"target", {{"node", moved}, {"path", "translation"}}}};
  asset.add("animations", {{"channels", Json::array({channel})},
                           {"samplers", Json::array({{{"input", times}, {"output", places}}})}});
  options.clip = "0";
  options.fps = 6;
  const std::uint64_t before = work_count.decoded;
  EXPECT_EQ(report(asset).problem, BakeProblem::none);
  EXPECT_EQ(work_count.decoded - before, 1U);
}

TEST_F(ImagesOfPictures, AreNotDecodedForClay) {
  for (const BakeOverlay overlay : {BakeOverlay::clay, BakeOverlay::wireframe}) {
    options.overlay = overlay;
    EXPECT_EQ(decoded_by(3), 0U);
  }
}

codec::Image image_from(SceneImages& images, const std::string& png, const Origin& origin) {
  codec::ImageRequest request;
  request.bytes = std::as_bytes(std::span(png));
  request.format = codec::ImageFormat::png;
  request.pixels = true;
  request.origin = origin;
  const auto result = images.decode(codec::Client::shared(), request);
  const auto* image = std::get_if<codec::Image>(&result);
  EXPECT_NE(image, nullptr);
  return image == nullptr ? codec::Image() : *image;
}

TEST(SceneImages, KnowWhatOthersKeep) {
  SceneImages images(1);
  const Origin origin = new_origin();
  const std::string png = pixels(4);
  const auto decode = [&] { return image_from(images, png, origin); };
  const std::uint64_t before = work_count.decoded;
  codec::Image shown = decode();
  EXPECT_EQ(decode().pixels.data(), shown.pixels.data());
  EXPECT_EQ(work_count.decoded - before, 1U);
  shown = {};
  EXPECT_EQ(decode().pixels.size(), 6U);
  EXPECT_EQ(work_count.decoded - before, 2U) << "there is room for nothing";
}

TEST(SceneImages, StayWhereOneIsTooLargeToBeKept) {
  SceneImages images(8);
  const Origin origin = new_origin();
  const std::string small = pixels(5);
  const std::string large = png_of(4, 1, 5);
  const std::uint64_t before = work_count.decoded;
  EXPECT_EQ(image_from(images, small, origin).pixels.size(), 6U);
  EXPECT_EQ(image_from(images, large, origin).pixels.size(), 12U);
  EXPECT_EQ(image_from(images, small, origin).pixels.size(), 6U);
  EXPECT_EQ(work_count.decoded - before, 2U);
}

}  // namespace
}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
/// Animations by their motion, images by their content, and broken assets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "prove/edited_asset.hpp"
#include "prove/images.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {
namespace {

using test::EditedAsset;
using test::Json;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path kFixtures = std::filesystem::path(GLTFX_SOURCE_DIR) / "fixtures";

// A node that is moved or rotated by an animation. `values` has equally many components for each of
// `times`.
EditedAsset moving(const std::vector<float>& times, const std::vector<float>& values,
                   const char* interpolation = "LINEAR", const char* path = "translation") {
  const std::size_t components = values.size() / times.size();
  EditedAsset asset = EditedAsset::made(R"({"asset": {"version": "2.0"}, "nodes": [{}],
    "animations": [{"samplers": [{"input": 0, "output": 1}],
                    "channels": [{"sampler": 0, "target": {"node": 0}}]}]})");
  Json& json = asset.json;
  json["animations"][0]["channels"][0]["target"]["path"] = path;
  json["animations"][0]["samplers"][0]["interpolation"] = interpolation;
  const std::size_t split = times.size() * sizeof(float);
  std::string bytes(reinterpret_cast<const char*>(times.data()), split);
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  json["bufferViews"] = {
      {{"buffer", 0}, {"byteLength", split}},
      {{"buffer", 0}, {"byteOffset", split}, {"byteLength", bytes.size() - split}}};
  json["accessors"] = {
      {{"bufferView", 0}, {"componentType", 5126}, {"count", times.size()}, {"type", "SCALAR"}},
      {{"bufferView", 1},
       {"componentType", 5126},
       {"count", times.size()},
       {"type", components == 4 ? "VEC4" : "VEC3"}}};
  json["buffers"] = {{{"uri", "motion.bin"}, {"byteLength", bytes.size()}}};
  asset.files["motion.bin"] = std::move(bytes);
  return asset;
}

MeaningRequest by_curves(double tolerance = 0) {
  MeaningRequest request;
  request.animations = AnimationComparison::curves;
  request.tolerance.animation = tolerance;
  return request;
}

TEST(AnimationMeaning, IsWhatCurvesSay) {
  const EditedAsset full = moving({0, 1, 2, 3}, {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0});
  const EditedAsset fewer = moving({0, 3}, {0, 0, 0, 3, 0, 0});
  EXPECT_FALSE(test::compare(full, fewer).same());
  EXPECT_THAT(test::text(test::compare(full, fewer, by_curves())), IsEmpty());
  const EditedAsset bent = moving({0, 1, 3}, {0, 0, 0, 1.5F, 0, 0, 3, 0, 0});
  const Meaning meaning = test::compare(full, bent, by_curves());
  EXPECT_THAT(test::text(meaning), HasSubstr("/animations/0/channels/0 is 0.5 away at 1 s"));
  EXPECT_TRUE(test::compare(full, bent, by_curves(0.5)).same());
  ASSERT_EQ(meaning.measured.size(), 1U);
  EXPECT_EQ(meaning.measured[0].quantity, "translation");
}

TEST(AnimationMeaning, KeepsStepsAndLength) {
  const EditedAsset steps = moving({0, 1, 2}, {0, 0, 0, 0, 0, 0, 2, 0, 0}, "STEP");
  EXPECT_TRUE(test::compare(steps, moving({0, 2}, {0, 0, 0, 2, 0, 0}, "STEP"), by_curves()).same());
  EXPECT_FALSE(
      test::compare(steps, moving({0, 1, 2}, {0, 0, 0, 0, 0, 0, 2, 0, 0}), by_curves()).same());
  const EditedAsset still = moving({0, 1, 2}, {5, 0, 0, 5, 0, 0, 5, 0, 0});
  EXPECT_TRUE(test::compare(still, moving({0, 2}, {5, 0, 0, 5, 0, 0}), by_curves()).same());
  EXPECT_THAT(test::text(test::compare(still, moving({0, 1}, {5, 0, 0, 5, 0, 0}), by_curves())),
              HasSubstr("lasts from 0 to 1 s in place of 0 to 2"));
}

TEST(AnimationMeaning, BothSignsOfAQuaternionTurnAlike) {
  const EditedAsset turn = moving({0, 1}, {0, 0, 0, 1, 0, 0, 0.6F, 0.8F}, "LINEAR", "rotation");
  const EditedAsset other = moving({0, 1}, {0, 0, 0, -1, 0, 0, 0.6F, 0.8F}, "LINEAR", "rotation");
  EXPECT_TRUE(test::compare(turn, other, by_curves()).same());
  EXPECT_FALSE(test::compare(turn, other).same());
  const EditedAsset away = moving({0, 1}, {0, 0, 0, 1, 0, 0, -0.6F, 0.8F}, "LINEAR", "rotation");
  EXPECT_FALSE(test::compare(turn, away, by_curves(0.5)).same());
}

codec::Image image(std::uint32_t channels, std::uint32_t bits, const std::string& pixels) {
  codec::Image made;
  made.width = 2;
  made.height = 1;
  made.channels = channels;
  made.bits = bits;
  auto owner = std::make_shared<std::string>(pixels);
  made.pixels = std::as_bytes(std::span(*owner));
  made.owner = owner;
  return made;
}

TEST(Texels, AreComparedAsColors) {
  using std::string_literals::operator""s;
  const codec::Image grey = image(1, 8, "\x10\x20"s);
  EXPECT_FALSE(compare_texels(grey, image(3, 8, "\x10\x10\x10\x20\x20\x20"s)));
  EXPECT_FALSE(compare_texels(grey, image(2, 8, "\x10\xff\x20\xff"s)));
  EXPECT_FALSE(compare_texels(grey, image(1, 16, "\x10\x10\x20\x20"s)));
  const auto transparent = compare_texels(grey, image(2, 8, "\x10\xff\x20\xfe"s));
  ASSERT_TRUE(transparent);
  EXPECT_EQ(transparent->x, 1U);
  EXPECT_EQ(transparent->steps, 1);
  EXPECT_TRUE(compare_texels(grey, image(1, 16, "\x10\x10\x21\x20"s)));
  EXPECT_TRUE(compare_texels(grey, image(3, 8, "\x10\x10\x10\x20\x20\x23"s)));
}

TEST(Texels, OfFloatsAreNoSteps) {
  const std::string ones{"\0\0\x80\x3f\0\0\x80\x3f", 8};
  const std::string halves{"\0\0\x80\x3f\0\0\0\x3f", 8};
  const auto far = compare_texels(image(1, 32, ones), image(1, 32, halves));
  ASSERT_TRUE(far);
  EXPECT_EQ(distance_text(*far, true), "is 0.5 away");
  EXPECT_EQ(distance_text(*far, false), "is 0.5 of 255 steps away");
}

// The image of a fixture as the same texels in another file, and as another picture.
TEST(ImageMeaning, IsWhatTexelsShow) {
  const EditedAsset before = EditedAsset::load(kFixtures / "good/pebble.gltf");
  const auto with = [&](const std::string& bytes) {
    EditedAsset after = before;
    after.json["images"][0]["uri"] = "other.png";
    after.files["other.png"] = bytes;
    return after;
  };
  auto file = container::open_file(kFixtures / "good/pebble_albedo.png");
  const std::string png(file->bytes.text());
  EXPECT_THAT(test::text(test::compare(before, with(png))), IsEmpty());
  const model::OpenedAsset opened = before.open();
  codec::ImageRequest request;
  request.bytes = file->bytes.view();
  request.pixels = true;
  const auto decoded = codec::Client::shared().decode_image(request);
  const auto* texels = std::get_if<codec::Image>(&decoded);
  ASSERT_NE(texels, nullptr);
  std::string pixels(reinterpret_cast<const char*>(texels->pixels.data()), texels->pixels.size());
  const auto encode = [&] {
    codec::EncodeRequest wanted;
    wanted.raster = {texels->width, texels->height, texels->channels, texels->bits};
    wanted.pixels = std::as_bytes(std::span(pixels));
    const auto encoded = codec::Client::shared().encode_image(wanted);
    const auto& bytes = std::get<codec::EncodedImage>(encoded).bytes;
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  const std::string again = encode();
  ASSERT_NE(again, png);
  EXPECT_THAT(test::text(test::compare(before, with(again))), IsEmpty());
  MeaningRequest by_bytes;
  by_bytes.images = ImageComparison::bytes;
  EXPECT_FALSE(test::compare(before, with(again), by_bytes).same());
  pixels[0] = static_cast<char>(pixels[0] ^ 1);
  EXPECT_THAT(test::text(test::compare(before, with(encode()))),
              HasSubstr("/images/0 has a texel 0, 0 that is 1 of 255 steps away"));
  EXPECT_THAT(test::text(test::compare(before, with("no image"))), HasSubstr("/images/0"));
}

// Truncated data is a difference; nothing crashes, whichever of the two is broken.
TEST(BrokenMeaning, IsNoEqualOfTheWhole) {
  for (const auto& path : test::assets_in(kFixtures / "good")) {
    const EditedAsset whole = EditedAsset::load(path);
    for (const auto& [name, bytes] : whole.files) {
      EditedAsset cut = whole;
      cut.files[name].resize(bytes.size() / 3);
      EXPECT_FALSE(test::compare(whole, cut).same()) << path << " without the end of " << name;
      test::compare(cut, whole);
    }
  }
}

TEST(BrokenMeaning, OfAnyTwoDoesNotCrash) {
  const auto paths = test::assets_in(kFixtures / "bad");
  const auto open = [](const std::filesystem::path& path) {
    return model::OpenedAsset(path, *container::open_file(path),
                              container::Resolver(path.parent_path(), path.parent_path()));
  };
  for (std::size_t i = 0; i < paths.size(); ++i) {
    for (const std::size_t step : {std::size_t{1}, std::size_t{7}}) {
      const auto& other = paths[(i + step) % paths.size()];
      compare_meaning(open(paths[i]), open(other), *schema::builtin_set(), {});
    }
  }
}

TEST(Side, OpensWhatIsAskedFor) {
  const model::OpenedAsset opened = EditedAsset::load(kFixtures / "good/pebble.gltf").open();
  const auto has_image = [&](Scope scope) {
    const Side side(opened, *schema::builtin_set(), scope, 1);
    EXPECT_EQ(side.resources().images.size(), side.asset().count(model::RootArray::images));
    EXPECT_EQ(side.pointer(side.views().meshes[0].node), "/meshes/0");
    return side.resources().images[0].bytes.has_value();
  };
  EXPECT_TRUE(has_image(Scope::all));
  EXPECT_FALSE(has_image(Scope::without_images));
}

}  // namespace
}  // namespace gltfx::prove

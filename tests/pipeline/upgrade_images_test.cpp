// SPDX-License-Identifier: Apache-2.0
// Factor maps of the first translucency: R moves to A in an image of its own, or need not.
#include <random>
#include <tuple>

#include <gmock/gmock.h>

#include "base/leftover.hpp"
#include "codec/support/png_encoder.hpp"
#include "legacy_asset.hpp"

namespace gltfx::test {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::string noise(std::size_t bytes, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::string text(bytes, '\0');
  for (char& c : text) c = static_cast<char>(random() & 0xFFU);
  return text;
}

std::string noisy_png(PngColor color, char bits, std::size_t bits_per_texel,
                      const std::string& chunks = {}, unsigned seed = 1) {
  constexpr std::size_t kSide = 16;
  return encode_png(
      {kSide, kSide, color, bits, noise(kSide * kSide * bits_per_texel / 8, seed), chunks});
}

std::string encoded(codec::EncodedFormat format, const codec::Raster& raster,
                    std::uint32_t quality) {
  const std::string texels = noise(std::size_t{raster.width} * raster.height * raster.channels);
  const auto result =
      codec::Client::shared().encode_image({format, raster, quality, bytes_of(texels)});
  const auto* image = std::get_if<codec::EncodedImage>(&result);
  if (image == nullptr) return {};
  return {reinterpret_cast<const char*>(image->bytes.data()), image->bytes.size()};
}

const std::string kBasisFiles = GLTFX_SOURCE_DIR "/tests/codec/basis/";

struct Map {
  const char* name;
  std::string bytes;
};

std::vector<Map> maps() {
  const std::string colors = png_encoder::chunk("PLTE", noise(256 * 3, 7));
  const std::string alphas = png_encoder::chunk("tRNS", noise(256, 8));
  const std::string key = png_encoder::chunk("tRNS", std::string("\0\1\0\2\0\3", 6));
  using codec::EncodedFormat;
  return {{"grey_1", noisy_png(PngColor::grey, 1, 1)},
          {"grey_2", noisy_png(PngColor::grey, 2, 2)},
          {"grey_4", noisy_png(PngColor::grey, 4, 4)},
          {"grey_8", noisy_png(PngColor::grey, 8, 8)},
          {"grey_16", noisy_png(PngColor::grey, 16, 16)},
          {"rgb_8", noisy_png(PngColor::rgb, 8, 24)},
          {"rgb_16", noisy_png(PngColor::rgb, 16, 48)},
          {"rgb_8_key", noisy_png(PngColor::rgb, 8, 24, key)},
          {"palette_4", noisy_png(PngColor::palette, 4, 4, colors)},
          {"palette_8", noisy_png(PngColor::palette, 8, 8, colors)},
          {"palette_alpha", noisy_png(PngColor::palette, 8, 8, colors + alphas)},
          {"grey_alpha_8", noisy_png(PngColor::grey_alpha, 8, 16)},
          {"grey_alpha_16", noisy_png(PngColor::grey_alpha, 16, 32)},
          {"rgba_8", noisy_png(PngColor::rgba, 8, 32)},
          {"rgba_16", noisy_png(PngColor::rgba, 16, 64)},
          {"jpeg_rgb", encoded(EncodedFormat::jpeg, {16, 16, 3, 8}, 90)},
          {"jpeg_grey", encoded(EncodedFormat::jpeg, {16, 16, 1, 8}, 90)},
          {"webp_lossy", encoded(EncodedFormat::webp, {16, 16, 3, 8}, 80)},
          {"webp_alpha", encoded(EncodedFormat::webp, {16, 16, 4, 8}, 0)},
          {"basis_etc1s", content(kBasisFiles + "etc1s-photo-32x20-200-mipmaps.ktx2")},
          {"basis_uastc", content(kBasisFiles + "uastc-photo-32x20-2-mipmaps-zstd.ktx2")}};
}

// Alpha of the new image is the old R, bit for bit, and the rest is white.
TEST(UpgradeImages, AlphaIsTheOldRedInEveryTexel) {
  for (const Map& map : maps()) {
    const TempFolder folder;
    const std::string kind = map.name;
    const std::string extension = kind.starts_with("webp")    ? "EXT_texture_webp"
                                  : kind.starts_with("basis") ? "KHR_texture_basisu"
                                                              : "";
    folder.write("leaf.img", map.bytes);
    Json before = document({mapped()}, {{{"uri", "leaf.img"}}});
    if (!extension.empty()) {
      before["textures"][0] = {{"extensions", {{extension, {{"source", 0}}}}}};
      before["extensionsUsed"].push_back(extension);
      before["extensionsRequired"] = {extension};
    }
    const auto path = folder.write("a.gltf", before.dump());
    UpgradeOptions options = in_place();
    options.generation = "v1";
    const UpgradeReport report = upgrade_file(path.native(), options);
    ASSERT_TRUE(report.written) << map.name << ": " << report.error;
    EXPECT_EQ(report.actions[0].outcome, UpgradeOutcome::safe) << map.name;
    const Json after = Json::parse(content(path));
    EXPECT_EQ(upgraded_extension(after).dump(),
              R"({"diffuseTransmissionFactor":1.0,"diffuseTransmissionTexture":{"index":1}})")
        << map.name;
    EXPECT_EQ(after["textures"][1].dump(), R"({"source":1})");
    const codec::Image old = decoded(map.bytes);
    const codec::Image fresh = decoded(image_bytes(after, 1, folder.path()));
    EXPECT_EQ(fresh.bits, old.bits) << map.name;
    EXPECT_EQ(fresh.channels, 4U);
    EXPECT_EQ(channel(fresh, 3), channel(old, 0)) << map.name;
    for (const std::size_t i : {0U, 1U, 2U}) EXPECT_THAT(channel(fresh, i), Each(fresh.full()));
    EXPECT_TRUE(upgrade_file(path.native(), options).actions.empty());
  }
}

TEST(UpgradeImages, TheWorkedExample) {
  const TempFolder folder;
  folder.write("map.png", noisy_png(PngColor::rgb, 8, 24));
  folder.write("base.png", noisy_png(PngColor::rgb, 8, 24, {}, 2));
  Json before = document({}, {{{"uri", "map.png"}}, {{"uri", "base.png"}}});
  before["materials"].push_back(Json::parse(
      R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.8,0.2,1],"baseColorTexture":{"index":1,)"
      R"("texCoord":1,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}}},"extensions":)"
      R"({"KHR_materials_translucency":{"translucencyFactor":0.7,"translucencyTexture":0}}})"));
  before["extensionsUsed"].push_back("KHR_texture_transform");
  const auto path = folder.write("a.gltf", before.dump());
  const UpgradeReport report = upgrade_file(path.native(), in_place());
  ASSERT_TRUE(report.written) << report.error;
  const Json after = Json::parse(content(path));
  EXPECT_EQ(upgraded_extension(after).dump(),
            R"({"diffuseTransmissionFactor":0.7,"diffuseTransmissionTexture":{"index":2},)"
            R"("diffuseTransmissionColorFactor":[0.5,0.8,0.2],"diffuseTransmissionColorTexture":)"
            R"({"index":1,"texCoord":1,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}}})");
  EXPECT_EQ(channel(decoded(image_bytes(after, 2, folder.path())), 3),
            channel(decoded(content(folder.path() / "map.png")), 0));
  ASSERT_THAT(report.orphans, SizeIs(2));
  EXPECT_EQ(report.orphans[0].pointer, "/images/0");
  EXPECT_EQ(report.orphans[0].bytes, content(folder.path() / "map.png").size());
}

TEST(UpgradeImages, ANewTextureKeepsTheSamplerAndWhereItLies) {
  const TempFolder folder;
  folder.write("leaf.png", noisy_png(PngColor::rgb, 8, 24));
  Json map = mapped();
  map["translucencyTexture"]["texCoord"] = 0;
  map["translucencyTexture"]["extensions"]["KHR_texture_transform"]["offset"] = {0.5, 0};
  Json before = document({map}, {{{"uri", "leaf.png"}}});
  before["extensionsUsed"].push_back("KHR_texture_transform");
  before["samplers"] = {{{"wrapS", 33071}}};
  before["textures"][0]["sampler"] = 0;
  const auto path = folder.write("a.gltf", before.dump());
  ASSERT_TRUE(upgrade_file(path.native(), in_place()).written);
  const Json after = Json::parse(content(path));
  EXPECT_EQ(after["textures"][1].dump(), R"({"sampler":0,"source":1})");
  EXPECT_EQ(
      upgraded_extension(after)["diffuseTransmissionTexture"].dump(),
      R"({"index":1,"texCoord":0,"extensions":{"KHR_texture_transform":{"offset":[0.5,0]}}})");
}

TEST(UpgradeImages, MaterialsAndEqualImagesShareTheNewOne) {
  const TempFolder folder;
  const std::string map = noisy_png(PngColor::rgb, 8, 24);
  folder.write("leaf.png", map);
  folder.write("copy.png", map);
  const Json before = document({mapped(1, 0), mapped(0.5, 1), mapped(0.25, 0)},
                               {{{"uri", "leaf.png"}}, {{"uri", "copy.png"}}});
  const auto path = folder.write("a.gltf", before.dump());
  const UpgradeReport report = upgrade_file(path.native(), in_place());
  EXPECT_THAT(report.new_files, SizeIs(1));
  const Json after = Json::parse(content(path));
  EXPECT_THAT(after["images"], SizeIs(3));
  for (const std::size_t i : {0U, 1U, 2U}) {
    EXPECT_EQ(upgraded_extension(after, i)["diffuseTransmissionTexture"]["index"], 2);
  }
}

struct Folded {
  PngColor color;
  std::string texel;
  double factor;
  std::string is;  ///< the new extension
};

TEST(UpgradeImages, AMapThatIsTheSameEverywhereGoesIntoTheFactor) {
  const std::vector<Folded> all{
      {PngColor::rgb, "\xFF\1\2", 0.5, R"({"diffuseTransmissionFactor":0.5})"},
      {PngColor::grey, "\x33", 0.5, R"({"diffuseTransmissionFactor":0.1})"},
      {PngColor::rgba, "\x33\1\2\3", 1, R"({"diffuseTransmissionFactor":0.2})"},
      {PngColor::rgb, std::string("\0\1\2", 3), 1, "null"}};
  for (const Folded& map : all) {
    const TempFolder folder;
    std::string texels;
    for (int i = 0; i < 6; ++i) texels += map.texel;
    folder.write("leaf.png", encode_png({3, 2, map.color, 8, texels}));
    const auto path =
        folder.write("a.gltf", document({mapped(map.factor)}, {{{"uri", "leaf.png"}}}).dump());
    const UpgradeReport report = upgrade_file(path.native(), in_place());
    ASSERT_TRUE(report.written) << report.error;
    EXPECT_EQ(report.actions[0].removed, map.is == "null");
    const Json after = Json::parse(content(path));
    EXPECT_EQ(
        after["materials"][0].contains("extensions") ? upgraded_extension(after).dump() : "null",
        map.is);
    EXPECT_THAT(after["textures"], SizeIs(1));
    EXPECT_THAT(report.orphans, SizeIs(2));
  }
}

TEST(UpgradeImages, AnAnimatedFactorKeepsItsMap) {
  const TempFolder folder;
  folder.write("leaf.png", encode_png({1, 1, PngColor::rgb, 8, "\x33\1\2"}));
  Json before = document({mapped()}, {{{"uri", "leaf.png"}}});
  before["extras"] = 1;
  before["animations"] = Json::parse(
      R"([{"channels":[{"target":{"path":"pointer","extensions":)"
      R"({"KHR_animation_pointer":{"pointer":"/materials/0/extensions/KHR_materials_translucency/)"
      R"(translucencyFactor"}}}}]}])");
  const auto path = folder.write("a.gltf", before.dump());
  ASSERT_TRUE(upgrade_file(path.native(), in_place()).written);
  const Json after = Json::parse(content(path));
  EXPECT_EQ(upgraded_extension(after).dump(),
            R"({"diffuseTransmissionFactor":1.0,"diffuseTransmissionTexture":{"index":1}})");
  EXPECT_THAT(channel(decoded(image_bytes(after, 1, folder.path())), 3), ElementsAre(0x33));
}

TEST(UpgradeImages, AnImageWhoseAlphaIsItsRedIsUsedAgain) {
  for (const char bits : {'\x8', '\x10'}) {
    const TempFolder folder;
    std::string texels;
    for (int i = 0; i < 8; ++i) {
      const std::string red =
          noise(static_cast<std::size_t>(bits) / 8, 20 + static_cast<unsigned>(i));
      texels += red + noise(static_cast<std::size_t>(bits) / 4, 3) + red;
    }
    folder.write("leaf.png", encode_png({4, 2, PngColor::rgba, bits, texels}));
    const auto path = folder.write("a.gltf", document({mapped()}, {{{"uri", "leaf.png"}}}).dump());
    const UpgradeReport report = upgrade_file(path.native(), in_place());
    ASSERT_TRUE(report.written) << report.error;
    EXPECT_EQ(report.actions[0].outcome, UpgradeOutcome::safe);
    EXPECT_EQ(upgraded_extension(Json::parse(content(path)))["diffuseTransmissionTexture"]["index"],
              0);
    EXPECT_THAT(report.new_files, IsEmpty());
    EXPECT_THAT(report.orphans, IsEmpty());
  }
}

TEST(UpgradeImages, AlphaThatVariesSpeaksForALaterGeneration) {
  const TempFolder folder;
  folder.write("leaf.png", noisy_png(PngColor::rgba, 8, 32));
  const std::string text = document({mapped()}, {{{"uri", "leaf.png"}}}).dump();
  const auto path = folder.write("a.gltf", text);
  const UpgradeReport doubtful = upgrade_file(path.native(), in_place());
  EXPECT_EQ(doubtful.actions[0].outcome, UpgradeOutcome::unsafe);
  EXPECT_THAT(doubtful.actions[0].notes, Contains(HasSubstr("--generation")));
  EXPECT_EQ(content(path), text);
  UpgradeOptions options = in_place();
  options.generation = "v2";
  EXPECT_TRUE(upgrade_file(path.native(), options).written);
  EXPECT_EQ(upgraded_extension(Json::parse(content(path)))["diffuseTransmissionTexture"]["index"],
            0);
  folder.write("b.gltf", text);
  options.generation = "v1";
  EXPECT_EQ(upgrade_file((folder.path() / "b.gltf").native(), options).actions[0].outcome,
            UpgradeOutcome::safe);
}

TEST(UpgradeImages, WhatCannotBeReadIsNamedAndLeftAlone) {
  const std::string pointer =
      "version https://git-lfs.github.com/spec/v1\noid sha256:" + std::string(64, 'a') +
      "\nsize 12345\n";
  const std::string png = noisy_png(PngColor::rgb, 8, 24);
  const std::string ktx2 = "\xABKTX 20\xBB\r\n\x1A\n" + std::string(80, '\0');
  const std::vector<std::pair<std::string, std::string>> all{{"", "format is unknown"},
                                                             {"hello", "format is unknown"},
                                                             {pointer, "Git LFS"},
                                                             {png.substr(0, 200), "image 0"},
                                                             {ktx2, "image/ktx2"}};
  for (const auto& [bytes, says] : all) {
    const TempFolder folder;
    folder.write("leaf.png", bytes);
    const std::string text =
        document({mapped(), {{"translucencyFactor", 0.5}}}, {{{"uri", "leaf.png"}}}).dump();
    const auto path = folder.write("a.gltf", text);
    const UpgradeReport report = upgrade_file(path.native(), in_place());
    ASSERT_THAT(report.actions, SizeIs(2));
    EXPECT_EQ(report.actions[0].outcome, UpgradeOutcome::needs_image) << bytes.substr(0, 20);
    EXPECT_THAT(report.actions[0].notes, Contains(HasSubstr(says)));
    EXPECT_TRUE(report.actions[1].done);
  }
}

TEST(UpgradeImages, BehindAnExtensionThatCannotBeReadTheFallbackCounts) {
  const TempFolder folder;
  folder.write("leaf.png", noisy_png(PngColor::rgb, 8, 24));
  folder.write("leaf.ktx2", "\xABKTX 20\xBB\r\n\x1A\n" + std::string(80, '\0'));
  Json before = document({mapped()}, {{{"uri", "leaf.png"}}, {{"uri", "leaf.ktx2"}}});
  before["textures"][0]["extensions"]["KHR_texture_basisu"]["source"] = 1;
  before["extensionsUsed"].push_back("KHR_texture_basisu");
  const auto path = folder.write("a.gltf", before.dump());
  const UpgradeReport report = upgrade_file(path.native(), in_place());
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_THAT(report.actions[0].notes, Contains(HasSubstr("fallback")));
  EXPECT_THAT(report.new_files, ElementsAre(testing::MatchesRegex("leaf-[0-9a-f]{8}\\.png")));
}

TEST(UpgradeImages, ADataUriIsFollowedByADataUri) {
  const TempFolder folder;
  const std::string uri =
      "data:image/png;base64," + container::encode_base64(noisy_png(PngColor::rgb, 8, 24));
  const auto path = folder.write("a.gltf", document({mapped()}, {{{"uri", uri}}}).dump());
  const UpgradeReport report = upgrade_file(path.native(), in_place());
  ASSERT_TRUE(report.written) << report.error;
  EXPECT_THAT(report.new_files, IsEmpty());
  const Json after = Json::parse(content(path));
  EXPECT_EQ(decoded(image_bytes(after, 1, folder.path())).channels, 4U);
}

TEST(UpgradeImages, ANewFileLiesBesideTheOldOneUnderAFreeName) {
  const TempFolder folder;
  folder.write("my maps/leaf.v2.png", noisy_png(PngColor::rgb, 8, 24));
  const std::string text = document({mapped()}, {{{"uri", "my%20maps/leaf.v2.png"}}}).dump();
  const auto first = folder.write("a.gltf", text);
  const UpgradeReport report = upgrade_file(first.native(), in_place());
  ASSERT_THAT(report.new_files, SizeIs(1)) << report.error;
  EXPECT_THAT(report.new_files[0], testing::MatchesRegex("my maps/leaf\\.v2-[0-9a-f]{8}\\.png"));
  const std::string uri = Json::parse(content(first))["images"][1]["uri"];
  EXPECT_TRUE(uri.starts_with("my%20maps/leaf.v2-")) << uri;
  // The same again: the file that is there is used. Another file of that name stays.
  const auto second = folder.write("b.gltf", text);
  EXPECT_EQ(upgrade_file(second.native(), in_place()).new_files, report.new_files);
  folder.write(report.new_files[0], "something else");
  const auto third = folder.write("c.gltf", text);
  const UpgradeReport other = upgrade_file(third.native(), in_place());
  ASSERT_THAT(other.new_files, SizeIs(1));
  EXPECT_NE(other.new_files, report.new_files);
  EXPECT_EQ(content(folder.path() / report.new_files[0]), "something else");
}

TEST(UpgradeImages, InAnotherFolderTheAssetIsComplete) {
  const TempFolder folder;
  folder.write("maps/leaf.png", noisy_png(PngColor::rgb, 8, 24));
  const auto path =
      folder.write("a.gltf", document({mapped()}, {{{"uri", "maps/leaf.png"}}}).dump());
  UpgradeOptions options;
  options.output = (folder.path() / "out" / "b.gltf").native();
  const UpgradeReport report = upgrade_file(path.native(), options);
  ASSERT_TRUE(report.written) << report.error;
  ASSERT_THAT(report.new_files, SizeIs(1));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out" / report.new_files[0]));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/maps/leaf.png"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / report.new_files[0]));
}

TEST(UpgradeImages, NothingNewIsLeftOfAFileThatCannotBeReplaced) {
  const TempFolder folder;
  folder.write("leaf.png", noisy_png(PngColor::rgb, 8, 24));
  const auto path = folder.write("a.gltf", document({mapped()}, {{{"uri", "leaf.png"}}}).dump());
  std::filesystem::create_hard_link(path, folder.path() / "link.gltf");
  EXPECT_EQ(upgrade_file(path.native(), in_place()).problem, EditProblem::not_written);
  const auto files = std::distance(std::filesystem::directory_iterator(folder.path()), {});
  EXPECT_EQ(files, 3);
}

TEST(UpgradeImages, AssetsThatShareAMapShareTheNewOneAlsoAfterACrash) {
  const std::string map = noisy_png(PngColor::rgb, 8, 24);
  const std::string text = document({mapped()}, {{{"uri", "leaf.png"}}}).dump();
  const TempFolder elsewhere;
  elsewhere.write("leaf.png", map);
  const auto first = elsewhere.write("a.gltf", text);
  const UpgradeReport alone = upgrade_file(first.native(), in_place());
  ASSERT_THAT(alone.new_files, SizeIs(1)) << alone.error;

  const TempFolder folder;
  folder.write("leaf.png", map);
  folder.write(left_by(ended_process(), alone.new_files[0], 0), "half");
  folder.write(left_by(ended_process(), "7.gltf", 3), "half");
  std::vector<EditInput> inputs;
  for (int i = 0; i < 40; ++i) {
    inputs.push_back({folder.write(std::to_string(i) + ".gltf", text).native(), {}});
  }
  upgrade_files(inputs, in_place(), 2, [&](UpgradeReport&& report) {
    EXPECT_TRUE(report.written) << report.error;
    EXPECT_EQ(report.new_files, alone.new_files);
  });
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 42);
}

}  // namespace
}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
// Images stored as KTX2 or AVIF.
#include <gmock/gmock.h>

#include "convert_image_support.hpp"
#include "image/ktx2.hpp"

namespace gltfx {
namespace {

using codec::Raster;
using test::asset_with;
using test::expect_settled;
using test::file_image;
using test::header_of;
using test::ImageConversionCase;
using test::jpeg_file;
using test::kBlendedSlot;
using test::kColorSlot;
using test::kDataSlot;
using test::kNormalSlot;
using test::OrderedJson;
using test::png_file;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;

const Raster kWood{64, 32, 3, 8};

ImageConversionCase ktx2_case(std::string_view slot, const std::string& file,
                              std::string_view name = "a.png") {
  ImageConversionCase conversion(asset_with(slot, {file_image(name)}), {{std::string(name), file}});
  conversion.options.images = {{ImageTarget::ktx2, std::nullopt}};
  return conversion;
}

image::Ktx2 ktx2_header(const std::string& file) {
  return image::read_ktx2(std::as_bytes(std::span(file.data(), file.size())));
}

TEST(Ktx2Images, AreReferredToByTheirExtension) {
  ImageConversionCase conversion = ktx2_case(kColorSlot, png_file(kWood));
  const OrderedJson json = conversion.run();
  EXPECT_EQ(json["textures"][0].dump(), R"({"extensions":{"KHR_texture_basisu":{"source":0}}})");
  EXPECT_EQ(json["extensionsUsed"].dump(), R"(["KHR_texture_basisu"])");
  EXPECT_EQ(json["extensionsRequired"].dump(), R"(["KHR_texture_basisu"])");
  EXPECT_EQ(json["images"][0]["uri"], "a.ktx2");
  EXPECT_EQ(conversion.step().what, "1 PNG -> KTX2");
  EXPECT_THAT(conversion.losses(), MatchesRegex("KTX2 of colors .1 image, [0-9.]+ dB.\n"));
  EXPECT_THAT(conversion.result.report.new_warnings, IsEmpty());
  expect_settled(conversion);
}

// All mipmaps; a plain image has four bytes a texel, a KTX2 image one.
TEST(Ktx2Images, TakeAQuarterOfTheMemory) {
  ImageConversionCase conversion = ktx2_case(kColorSlot, jpeg_file(kWood), "a.jpg");
  conversion.run();
  const image::Ktx2 file = ktx2_header(conversion.result.files.at("a.ktx2"));
  EXPECT_EQ(file.level_count, 7U);
  constexpr std::uint64_t kTexels = 64 * 32 + 32 * 16 + 16 * 8 + 8 * 4 + 4 * 2 + 2 + 1;
  EXPECT_EQ(conversion.step().gpu_bytes_before, kTexels * 4);
  EXPECT_EQ(conversion.step().gpu_bytes_after, kTexels);
  EXPECT_GT(conversion.step().bytes_after, conversion.step().bytes_before) << "larger than a JPEG";
}

TEST(Ktx2Images, HaveTheColorSpaceOfTheirUse) {
  struct Case {
    std::string_view slot;
    std::uint8_t transfer;
    std::string_view loss;
  };
  for (const Case& one : {Case{kColorSlot, image::kKtx2TransferSrgb, "KTX2 of colors"},
                          Case{kBlendedSlot, image::kKtx2TransferSrgb, "KTX2 of colors"},
                          Case{kNormalSlot, image::kKtx2TransferLinear, "of the normals within"},
                          Case{kDataSlot, image::kKtx2TransferLinear, "KTX2 of data"}}) {
    ImageConversionCase conversion = ktx2_case(one.slot, png_file({64, 32, 4, 8}));
    conversion.run();
    EXPECT_EQ(ktx2_header(conversion.result.files.at("a.ktx2")).transfer, one.transfer) << one.loss;
    EXPECT_THAT(conversion.losses(), HasSubstr(std::string(one.loss)));
    EXPECT_THAT(conversion.result.report.new_warnings, IsEmpty());
  }
}

TEST(Ktx2Images, AreMadeOfTheChosenClassOnly) {
  ImageConversionCase conversion(
      asset_with(std::string(kColorSlot) + R"(, "normalTexture": {"index": 1})",
                 {file_image("a.png"), file_image("b.png")}),
      {{"a.png", png_file(kWood)}, {"b.png", png_file(kWood)}});
  conversion.options.images = {{ImageTarget::ktx2, ImageClass::normal}};
  const OrderedJson json = conversion.run();
  EXPECT_EQ(json["images"][0]["uri"], "a.png");
  EXPECT_EQ(json["images"][1]["uri"], "b.ktx2");
  EXPECT_EQ(conversion.step().what, "1 PNG -> KTX2");
}

TEST(Ktx2Images, GetSidesThatAreMultiplesOfFour) {
  ImageConversionCase conversion = ktx2_case(kColorSlot, png_file({30, 17, 3, 8}));
  conversion.run();
  const image::Ktx2 file = ktx2_header(conversion.result.files.at("a.ktx2"));
  EXPECT_EQ(file.width, 32U);
  EXPECT_EQ(file.height, 16U);
  EXPECT_EQ(conversion.step().what, "1 PNG -> KTX2 resized");
  EXPECT_THAT(conversion.losses(), HasSubstr("sides rounded to multiples of 4 texels (1 image)"));
  expect_settled(conversion);
}

TEST(Ktx2Images, AreResizedAndEncodedAgain) {
  ImageConversionCase first = ktx2_case(kColorSlot, png_file(kWood));
  first.run();
  ImageConversionCase small = first.again();
  small.options.images.clear();
  small.options.texture_size = 16;
  small.run();
  const image::Ktx2 file = ktx2_header(small.result.files.begin()->second);
  EXPECT_EQ(file.width, 16U);
  EXPECT_EQ(file.height, 8U);
  EXPECT_THAT(small.losses(), HasSubstr("resolution above 16 texels per side (1 image)"));
  EXPECT_THAT(small.losses(), HasSubstr("KTX2 of colors"));
}

TEST(Ktx2Images, NeedAKnownUseAndEightBits) {
  const std::string both = std::string(kColorSlot) + R"(, "normalTexture": {"index": 0})";
  ImageConversionCase doubtful = ktx2_case(both, png_file(kWood));
  doubtful.run();
  EXPECT_FALSE(doubtful.step().changes);
  EXPECT_THAT(doubtful.left(), HasSubstr("not KTX2: it would lose data, and it is used as color"));
  ImageConversionCase deep = ktx2_case(kDataSlot, png_file({64, 32, 3, 16}));
  deep.run();
  EXPECT_THAT(deep.left(), HasSubstr("it has 16 bits per channel"));
  deep.options.quality = 90;
  deep.run();
  EXPECT_THAT(deep.losses(), HasSubstr("8 of 16 bits per channel"));
}

TEST(Ktx2Images, BecomePngAgain) {
  ImageConversionCase first = ktx2_case(kColorSlot, png_file(kWood));
  first.run();
  ImageConversionCase back = first.again();
  back.options.images = {{ImageTarget::png, std::nullopt}};
  const OrderedJson json = back.run();
  EXPECT_EQ(json["textures"][0].dump(), R"({"source":0})");
  EXPECT_FALSE(json.contains("extensionsUsed"));
  EXPECT_EQ(test::decoded(back.result.files.begin()->second),
            test::decoded(first.result.files.at("a.ktx2"), codec::ImageFormat::ktx2));
}

TEST(Ktx2Images, DoNotDependOnThreads) {
  std::vector<std::string> images;
  std::string slots = R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
    "metallicRoughnessTexture": {"index": 1}}, "normalTexture": {"index": 2},
    "emissiveTexture": {"index": 3})";
  std::map<std::string, std::string> files;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::string name = std::string(1, static_cast<char>('a' + i)) + ".png";
    images.push_back(file_image(name));
    files[name] = png_file({64 + 8 * i, 32, 3, 8});
  }
  ImageConversionCase alone(asset_with(slots, images), files);
  alone.options.images = {{ImageTarget::ktx2, std::nullopt}};
  ImageConversionCase together = alone;
  together.options.jobs = 4;
  alone.run();
  together.run();
  EXPECT_EQ(alone.result.files.size(), 4U);
  EXPECT_EQ(alone.result.files, together.result.files);
  EXPECT_EQ(alone.result.bytes, together.result.bytes);
}

// The tests need libavif, which tools/test installs.
TEST(AvifImages, AreForColorsOnly) {
  ImageConversionCase conversion(
      asset_with(std::string(kColorSlot) + R"(, "normalTexture": {"index": 1})",
                 {file_image("a.png"), file_image("b.png")}),
      {{"a.png", png_file({256, 256, 4, 8})}, {"b.png", png_file({256, 256, 3, 8})}});
  conversion.options.images = {{ImageTarget::avif, std::nullopt}};
  const OrderedJson json = conversion.run();
  EXPECT_EQ(json["images"][0]["uri"], "a.avif");
  EXPECT_EQ(json["images"][1]["uri"], "b.png");
  EXPECT_EQ(json["textures"][0].dump(), R"({"extensions":{"EXT_texture_avif":{"source":0}}})");
  EXPECT_THAT(conversion.left(), HasSubstr("/images/1: not AVIF: gltfx encodes only colors"));
  EXPECT_THAT(conversion.losses(), MatchesRegex("AVIF of quality 80 .1 image, [0-9.]+ dB.\n"));
  EXPECT_THAT(conversion.result.report.new_warnings, IsEmpty());
  expect_settled(conversion);
  ImageConversionCase again = conversion;
  again.run();
  EXPECT_EQ(again.result.files, conversion.result.files);
}

TEST(AvifImages, HaveAQualityAndASize) {
  ImageConversionCase fine(asset_with(kColorSlot, {file_image("a.png")}),
                           {{"a.png", png_file({256, 128, 3, 8})}});
  fine.options.images = {{ImageTarget::avif, std::nullopt}};
  fine.options.quality = 95;
  ImageConversionCase coarse = fine;
  coarse.options.quality = 30;
  fine.run();
  coarse.run();
  EXPECT_LT(coarse.result.files.at("a.avif").size(), fine.result.files.at("a.avif").size());
  EXPECT_THAT(coarse.losses(), HasSubstr("AVIF of quality 30"));
  fine.options.texture_size = 64;
  fine.run();
  const image::Header header = header_of(fine.result.files.at("a.avif"));
  EXPECT_EQ(header.width, 64U);
  EXPECT_EQ(header.height, 32U);
  EXPECT_THAT(fine.losses(), HasSubstr("resolution above 64 texels per side (1 image)"));
}

}  // namespace
}  // namespace gltfx

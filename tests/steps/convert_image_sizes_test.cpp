// SPDX-License-Identifier: Apache-2.0
// Resized and recompressed images, and names of files whose ending does not change.
#include <cmath>

#include <gmock/gmock.h>

#include "convert_image_support.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using codec::EncodedFormat;
using codec::Raster;
using container::test::content_of;
using container::test::TempFolder;
using test::asset_with;
using test::decoded;
using test::file_image;
using test::header_of;
using test::ImageConversionCase;
using test::kColorSlot;
using test::kDataSlot;
using test::kNormalSlot;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Raster kWide{64, 32, 3, 8};

ImageConversionCase resized(std::string_view slot, const std::string& file,
                            std::string_view name = "a.png", std::uint32_t size = 16,
                            std::string_view more = {}) {
  ImageConversionCase conversion(asset_with(slot, {file_image(name)}, more),
                                 {{std::string(name), file}});
  conversion.options.texture_size = size;
  return conversion;
}

// Alternates black and white.
std::string checkers() {
  const Raster raster{64, 64, 3, 8};
  test::Texels texels;
  for (unsigned i = 0; i < 64 * 64; ++i) {
    texels.insert(texels.end(), 3, (i + i / 64) % 2 == 0 ? std::byte{255} : std::byte{0});
  }
  return test::image_file(EncodedFormat::png, raster, texels);
}

// A fifth of the texels, at random, is opaque.
std::string cutout() {
  const Raster raster{64, 64, 4, 8};
  std::mt19937 random(1);
  test::Texels texels;
  for (unsigned i = 0; i < 64 * 64; ++i) {
    texels.insert(texels.end(), 3, std::byte{90});
    texels.push_back(random() % 5 == 0 ? std::byte{255} : std::byte{0});
  }
  return test::image_file(EncodedFormat::png, raster, texels);
}

void expect_nothing_left_to_do(const ImageConversionCase& conversion) {
  ImageConversionCase again = conversion.again();
  again.run();
  EXPECT_FALSE(again.step().changes) << again.step().what;
}

TEST(ImageSizes, ShrinkToTheLongerSideAndNeverGrow) {
  ImageConversionCase small = resized(kColorSlot, test::png_file(kWide));
  small.run();
  const image::Header header = header_of(small.result.files.at("a.png"));
  EXPECT_EQ(header.width, 16U);
  EXPECT_EQ(header.height, 8U);
  EXPECT_EQ(small.step().what, "1 PNG resized");
  EXPECT_EQ(small.losses(), "resolution above 16 texels per side (1 image)\n");
  EXPECT_EQ(small.result.bytes, small.asset.bytes);
  expect_nothing_left_to_do(small);
  ImageConversionCase large = resized(kColorSlot, test::png_file(kWide), "a.png", 64);
  large.run();
  EXPECT_THAT(large.result.files, IsEmpty());
  EXPECT_FALSE(large.step().changes);
}

TEST(ImageSizes, AverageTexelsAccordingToTheirUse) {
  ImageConversionCase color = resized(kColorSlot, checkers());
  color.run();
  EXPECT_EQ(decoded(color.result.files.at("a.png"))[0], std::byte{188});  // half the light
  ImageConversionCase data = resized(kDataSlot, checkers());
  data.run();
  const int middle = static_cast<int>(decoded(data.result.files.at("a.png"))[0]);
  EXPECT_NEAR(middle, 128, 1);
}

TEST(ImageSizes, KeepNormalsOfUnitLength) {
  ImageConversionCase conversion = resized(kNormalSlot, test::png_file(kWide));
  conversion.run();
  const auto texels = decoded(conversion.result.files.at("a.png"));
  for (std::size_t i = 0; i < texels.size(); i += 4) {
    double squares = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = static_cast<double>(texels[i + c]) / 127.5 - 1;
      squares += value * value;
    }
    EXPECT_NEAR(std::sqrt(squares), 1, 0.02);
  }
}

TEST(ImageSizes, KeepTheCoverageOfAMask) {
  for (const char* cutoff : {"0.5", "0.25"}) {
    const std::string slot = R"("alphaMode": "MASK", "alphaCutoff": )" + std::string(cutoff) +
                             R"(, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}})";
    ImageConversionCase conversion = resized(slot, cutout());
    conversion.run();
    const auto texels = decoded(conversion.result.files.at("a.png"));
    double there = 0;
    for (std::size_t i = 3; i < texels.size(); i += 4) {
      there += static_cast<double>(texels[i]) >= std::stod(cutoff) * 255 ? 1 : 0;
    }
    EXPECT_NEAR(there / 256, 0.2, 0.02) << cutoff;
  }
}

TEST(ImageSizes, KeepFormatAndDepth) {
  ImageConversionCase deep = resized(kDataSlot, test::png_file({64, 32, 3, 16}));
  deep.run();
  EXPECT_EQ(header_of(deep.result.files.at("a.png")).bits, 16U);
  ImageConversionCase jpeg = resized(kColorSlot, test::jpeg_file(kWide), "a.jpeg");
  jpeg.run();
  EXPECT_EQ(header_of(jpeg.result.files.at("a.jpeg")).format, image::Format::jpeg);
  EXPECT_THAT(jpeg.losses(),
              testing::MatchesRegex("JPEG of quality 90 .1 image, [0-9.]+ dB.\n"
                                    "resolution above 16 texels per side .1 image.\n"));
  jpeg.options.quality = 30;
  jpeg.run();
  EXPECT_THAT(jpeg.losses(), HasSubstr("JPEG of quality 30"));
}

TEST(ImageSizes, ChangeTogetherWithTheFormat) {
  ImageConversionCase conversion = resized(kColorSlot, test::png_file(kWide));
  conversion.options.images = {{ImageTarget::webp, std::nullopt}};
  conversion.run();
  EXPECT_EQ(header_of(conversion.result.files.at("a.webp")).width, 16U);
  EXPECT_EQ(conversion.step().what, "1 PNG -> WebP exact resized");
  expect_nothing_left_to_do(conversion);
}

TEST(ImageSizes, StayIfTheUseIsAmbiguous) {
  const std::string both = std::string(kColorSlot) + ", " + R"("normalTexture": {"index": 0})";
  const std::map<std::string, std::string> cases{
      {both, "it is used as color and as data"},
      {R"("normalTexture": {"index": 0}, "occlusionTexture": {"index": 0})",
       "it is used as normals and as data"},
      {R"("name": "none")", "no texture slot uses it"},
      {std::string(kColorSlot) + R"(, "extensions": {"ACME_paint": {"spotTexture": {"index": 0}}})",
       "/materials/0/extensions/ACME_paint/spotTexture/index uses it, but no schema describes "
       "how"}};
  for (const auto& [slot, why] : cases) {
    ImageConversionCase conversion = resized(slot, test::png_file(kWide));
    conversion.run();
    EXPECT_EQ(conversion.left(), "/images/0: not resized: " + why + "\n");
    EXPECT_FALSE(conversion.step().changes);
  }
}

TEST(ImageSizes, StayIfTexelsAreFeatureIds) {
  ImageConversionCase conversion = resized(
      R"("name": "none")", test::png_file(kWide), "a.png", 16,
      R"(, "extensionsUsed": ["EXT_mesh_features"], "meshes": [{"primitives": [{"attributes": {},
        "extensions": {"EXT_mesh_features": {"featureIds": [{"featureCount": 4, "texture":
        {"index": 0, "channels": [0]}}]}}}]}])");
  conversion.run();
  EXPECT_THAT(conversion.left(), HasSubstr("uses it, but no schema describes how"));
}

TEST(BetterPacking, KeepsTexelsAndHappensOnce) {
  const std::string png = test::png_file(kWide);
  std::string padded = png;
  const std::string text("\0\0\0\x08tEXtabc\0defg\xBB\xD1\x27\x0B", 20);
  padded.insert(33, text);
  ImageConversionCase conversion(asset_with(kColorSlot, {file_image("a.png"), file_image("b.jpg")}),
                                 {{"a.png", padded}, {"b.jpg", test::jpeg_file(kWide)}});
  conversion.options.shrink = true;
  conversion.run();
  const std::string& packed = conversion.result.files.at("a.png");
  EXPECT_LT(packed.size(), padded.size());
  EXPECT_EQ(decoded(packed), decoded(padded));
  EXPECT_EQ(conversion.step().what, "1 PNG recompressed");
  EXPECT_THAT(conversion.step().losses, IsEmpty());
  EXPECT_FALSE(conversion.result.files.contains("b.jpg"));
  expect_nothing_left_to_do(conversion);
}

class FilesThatKeepTheirEnding : public testing::Test {
 protected:
  ConvertReport run(ConvertOptions options) {
    options.texture_size = 16;
    return convert_file(source_.native(), options);
  }
  TempFolder folder_;
  const std::string png_ = test::png_file(kWide);
  const fs::path image_ = folder_.write("wood.png", png_);
  const fs::path source_ =
      folder_.write("a.gltf", asset_with(kColorSlot, {file_image("wood.png")}));
};

TEST_F(FilesThatKeepTheirEnding, KeepTheirNameInAnotherFolder) {
  const ConvertReport report = run(test::options_to(folder_.path() / "out" / "a.gltf"));
  EXPECT_TRUE(report.written) << report.error;
  EXPECT_EQ(header_of(content_of(folder_.path() / "out" / "wood.png")).width, 16U);
  EXPECT_EQ(content_of(image_), png_);
}

TEST_F(FilesThatKeepTheirEnding, GetANewNameInTheFolderOfTheOldAsset) {
  const std::string before = content_of(source_);
  const ConvertReport report = run(test::options_to(folder_.path() / "b.gltf"));
  EXPECT_TRUE(report.written) << report.error;
  EXPECT_EQ(content_of(image_), png_);
  EXPECT_EQ(content_of(source_), before);
  ASSERT_EQ(report.new_files.size(), 1U);
  EXPECT_THAT(report.new_files.front(), testing::MatchesRegex("wood-[0-9a-f]{8}\\.png"));
  EXPECT_EQ(header_of(content_of(folder_.path() / report.new_files.front())).width, 16U);
}

TEST_F(FilesThatKeepTheirEnding, AreNotReplacedInPlace) {
  ConvertOptions options;
  options.in_place = true;
  const ConvertReport report = run(options);
  EXPECT_TRUE(report.written) << report.error;
  EXPECT_EQ(content_of(image_), png_);
  ASSERT_EQ(report.new_files.size(), 1U);
  EXPECT_THAT(content_of(source_), HasSubstr(report.new_files.front()));
  EXPECT_FALSE(run(options).changes);
}

TEST_F(FilesThatKeepTheirEnding, DoNotRemoveOldFilesWithAnotherEnding) {
  ConvertOptions options = test::options_to(folder_.path() / "out" / "a.gltf");
  options.images = {{ImageTarget::webp, std::nullopt}};
  const ConvertReport report = run(options);
  EXPECT_TRUE(report.written) << report.error;
  EXPECT_THAT(report.new_files, ElementsAre("wood.webp"));
  EXPECT_FALSE(fs::exists(folder_.path() / "out" / "wood.png"));
}

}  // namespace
}  // namespace gltfx

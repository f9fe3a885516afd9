// SPDX-License-Identifier: Apache-2.0
// Images in another format: texels, references of textures, and storage of the new bytes.
#include <gmock/gmock.h>

#include "convert_image_support.hpp"

namespace gltfx {
namespace {

using codec::Raster;
using test::asset_with;
using test::decoded;
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
using test::StoredAsset;
using test::webp_file;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const Raster kRgb{64, 32, 3, 8};
const Raster kRgba{64, 32, 4, 8};
const Raster kGrey{64, 32, 1, 8};

ImageConversionCase to(ImageTarget target, std::string text,
                       std::map<std::string, std::string> files) {
  ImageConversionCase conversion(std::move(text), std::move(files));
  conversion.options.images = {{target, std::nullopt}};
  return conversion;
}

ImageConversionCase color_file(ImageTarget target, const std::string& file,
                               std::string_view name = "a.png") {
  return to(target, asset_with(kColorSlot, {file_image(name)}), {{std::string(name), file}});
}

TEST(WebpImages, KeepTexelsEvenIfTransparent) {
  for (const Raster& raster : {kRgb, kRgba, kGrey, Raster{64, 32, 2, 8}}) {
    const std::string png = png_file(raster);
    ImageConversionCase conversion = color_file(ImageTarget::webp, png);
    conversion.run();
    const std::string& webp = conversion.result.files.at("a.webp");
    EXPECT_EQ(header_of(webp).format, image::Format::webp);
    EXPECT_EQ(decoded(webp), decoded(png)) << raster.channels;
    EXPECT_LT(webp.size(), png.size());
    EXPECT_EQ(conversion.step().what, "1 PNG -> WebP exact");
    EXPECT_THAT(conversion.step().losses, IsEmpty());
    expect_settled(conversion);
  }
}

TEST(WebpImages, ChangeNothingElseInTheText) {
  const auto text = [](std::string_view texture, std::string_view uri, std::string_view type,
                       std::string_view lists) {
    return R"({ "asset": {"version": "2.0", "extras": {"n": 1.50}},
  "images": [{"name" : "Wood", "uri": ")" +
           std::string(uri) + R"(", "extras": [1])" + std::string(type) + R"(}],
  "textures": [)" +
           std::string(texture) + R"(],
  "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])" +
           std::string(lists) + " }";
  };
  ImageConversionCase conversion =
      to(ImageTarget::webp, text(R"({"name": "T", "source": 0})", "maps/my%20wood.v2.png", "", ""),
         {{"maps/my wood.v2.png", png_file(kRgb)}});
  conversion.run();
  EXPECT_EQ(
      conversion.result.bytes,
      text(
          R"({"name": "T", "extensions": {"EXT_texture_webp": {"source": 0}}})",
          "maps/my%20wood.v2.webp", R"(, "mimeType": "image/webp")",
          R"(, "extensionsUsed": ["EXT_texture_webp"], "extensionsRequired": ["EXT_texture_webp"])"));
  EXPECT_TRUE(conversion.result.files.contains("maps/my wood.v2.webp"));
}

TEST(WebpImages, DeclareAnOpaqueAlphaChannel) {
  const std::string png = png_file(kRgba, true);
  ImageConversionCase conversion = color_file(ImageTarget::webp, png);
  conversion.run();
  EXPECT_TRUE(image::has_alpha(header_of(conversion.result.files.at("a.webp")).channels));
}

TEST(WebpImages, KeepTheirStorage) {
  const std::string png = png_file(kRgb);
  const std::string view = R"({"bufferView": 0, "mimeType": "image/png"})";
  const std::string chunk = std::string((png.size() + 3) / 4 * 4, '\0').replace(0, png.size(), png);
  ImageConversionCase glb =
      to(ImageTarget::webp,
         test::glb_of(asset_with(kColorSlot, {view},
                                 R"(, "buffers": [{"byteLength": )" + std::to_string(png.size()) +
                                     R"(}], "bufferViews": [{"buffer": 0, "byteLength": )" +
                                     std::to_string(png.size()) + "}]"),
                      chunk),
         {});
  const OrderedJson json = glb.run();
  EXPECT_EQ(json["images"][0].dump(), R"({"bufferView":0,"mimeType":"image/webp"})");
  EXPECT_THAT(json["bufferViews"], SizeIs(1));
  EXPECT_THAT(json["buffers"], SizeIs(1));
  const StoredAsset stored(glb.result.bytes);
  EXPECT_EQ(decoded(stored.bin.substr(0, json["bufferViews"][0]["byteLength"])), decoded(png));
  EXPECT_LT(glb.result.bytes.size(), glb.asset.bytes.size());
  EXPECT_THAT(glb.result.files, IsEmpty());

  ImageConversionCase uri =
      to(ImageTarget::webp,
         asset_with(kColorSlot, {file_image(container::data_uri("image/png", png))}), {});
  EXPECT_THAT(std::string(uri.run()["images"][0]["uri"]), testing::StartsWith("data:image/webp;"));
}

TEST(WebpImages, GetANewViewIfTheOldOneHasOtherUsers) {
  const std::string png = png_file(kRgb);
  const std::string length = std::to_string(png.size());
  ImageConversionCase conversion =
      to(ImageTarget::webp,
         asset_with(kColorSlot, {R"({"bufferView": 0, "mimeType": "image/png"})"},
                    R"(, "buffers": [{"byteLength": )" + length +
                        R"(, "uri": "b.bin"}], "bufferViews": [{"buffer": 0, "byteLength": )" +
                        length + R"(}], "accessors": [{"bufferView": 0, "componentType": 5121,
                        "type": "SCALAR", "count": 8}])"),
         {{"b.bin", png}});
  const OrderedJson json = conversion.run();
  EXPECT_EQ(json["images"][0]["bufferView"], 1);
  EXPECT_EQ(json["bufferViews"][0].dump(), R"({"buffer":0,"byteLength":)" + length + "}");
  EXPECT_EQ(conversion.result.files.at("b.bin").substr(0, png.size()), png);
}

TEST(WebpImages, AreEncodedOncePerFile) {
  ImageConversionCase conversion =
      to(ImageTarget::webp, asset_with(kColorSlot, {file_image("a.png"), file_image("./a.png")}),
         {{"a.png", png_file(kRgb)}});
  const OrderedJson json = conversion.run();
  EXPECT_EQ(json["images"][0]["uri"], "a.webp");
  EXPECT_EQ(json["images"][1]["uri"], "./a.webp");
  EXPECT_THAT(conversion.result.report.new_files, ElementsAre("a.webp"));
  EXPECT_EQ(conversion.step().what, "2 PNG -> WebP exact");
}

TEST(WebpImages, DoNotUseExistingNames) {
  ImageConversionCase conversion =
      to(ImageTarget::webp, asset_with(kColorSlot, {file_image("a.png"), file_image("A.webp")}),
         {{"a.png", png_file(kRgb)}, {"A.webp", png_file(kGrey)}});
  const OrderedJson json = conversion.run();
  EXPECT_EQ(json["images"][0]["uri"], "a-2.webp");
  EXPECT_EQ(json["images"][1]["uri"], "A.webp");
}

TEST(WebpImages, MustNotBeLarger) {
  const std::string jpeg = jpeg_file(kRgb, 40);
  ImageConversionCase conversion = color_file(ImageTarget::webp, jpeg, "a.jpg");
  conversion.run();
  EXPECT_EQ(conversion.left(), "/images/0: as WebP it would be larger\n");
  EXPECT_FALSE(conversion.step().changes);
  EXPECT_EQ(conversion.result.bytes, conversion.asset.bytes);
}

TEST(WebpImages, RequireAQualityForSixteenBits) {
  const std::string png = png_file({64, 32, 3, 16});
  ImageConversionCase conversion = color_file(ImageTarget::webp, png);
  conversion.run();
  EXPECT_EQ(conversion.left(),
            "/images/0: not WebP: it has 16 bits per channel (--quality reduces them to 8)\n");
  conversion.options.quality = 90;
  conversion.run();
  EXPECT_THAT(conversion.losses(),
              testing::MatchesRegex("8 of 16 bits per channel .1 image.\n"
                                    "WebP of quality 90 .1 image, [0-9.]+ dB.\n"));
}

TEST(LossyImages, AreNearlyExactForNormalsAndData) {
  const std::string png = png_file(kRgb);
  for (const std::string_view slot : {kNormalSlot, kDataSlot, kColorSlot}) {
    ImageConversionCase conversion =
        to(ImageTarget::webp, asset_with(slot, {file_image("a.png")}), {{"a.png", png}});
    conversion.options.quality = 50;
    conversion.run();
    const auto before = decoded(png);
    const auto after = decoded(conversion.result.files.at("a.webp"));
    int most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      most = std::max(most, std::abs(static_cast<int>(before[i]) - static_cast<int>(after[i])));
    }
    EXPECT_EQ(most <= 2, slot != kColorSlot) << most;
    ASSERT_THAT(conversion.step().losses, SizeIs(1));
    const ConvertLoss& loss = conversion.step().losses.front();
    if (slot == kColorSlot) {
      EXPECT_THAT(loss.quantity, testing::StartsWith("WebP of quality 50 (1 image, "));
      EXPECT_EQ(loss.bound, 0);
    } else {
      EXPECT_EQ(loss.quantity, "WebP values (1 image)");
      EXPECT_EQ(loss.bound, 2);
      EXPECT_EQ(loss.measured, most);
    }
    expect_settled(conversion);
  }
}

// The sampling factors of the first component, from the frame header (ITU-T T.81 section B.2.2).
unsigned sampling(const std::string& jpeg) {
  for (std::size_t at = 2; at + 12 < jpeg.size();) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(jpeg[at + i]); };
    if (byte(1) == 0xC0 || byte(1) == 0xC1 || byte(1) == 0xC2) return byte(11);
    at += 2U + byte(2) * 256U + byte(3);
  }
  return 0;
}

TEST(LossyImages, AreSubsampledInJpegOnlyForColor) {
  const std::map<std::string_view, unsigned> slots{
      {kColorSlot, 0x22}, {kNormalSlot, 0x11}, {kDataSlot, 0x11}};
  for (const auto& [slot, factors] : slots) {
    ImageConversionCase conversion =
        to(ImageTarget::jpeg, asset_with(slot, {file_image("a.png")}), {{"a.png", png_file(kRgb)}});
    const OrderedJson json = conversion.run();
    EXPECT_EQ(json["images"][0]["uri"], "a.jpg");
    EXPECT_FALSE(json.contains("extensionsUsed"));
    EXPECT_EQ(sampling(conversion.result.files.at("a.jpg")), factors);
    EXPECT_THAT(conversion.losses(),
                testing::MatchesRegex("JPEG of quality 90 .1 image, [234][0-9].[0-9] dB"
                                      "(, 99 % of the normals within [0-9.]+ deg)?.\n"));
    EXPECT_EQ(conversion.losses().find("deg") != std::string::npos, slot == kNormalSlot);
  }
}

TEST(LossyImages, CannotHaveAlphaInJpeg) {
  for (const std::string_view slot : {kColorSlot, kBlendedSlot}) {
    for (const bool opaque : {false, true}) {
      ImageConversionCase conversion =
          to(ImageTarget::jpeg, asset_with(slot, {file_image("a.png")}),
             {{"a.png", png_file(kRgba, opaque)}});
      conversion.run();
      const bool taken = opaque && slot == kColorSlot;
      EXPECT_EQ(conversion.step().changes, taken);
      EXPECT_EQ(conversion.left().find("alpha") == std::string::npos, taken);
    }
  }
}

TEST(ClassesOfImages, SelectConversions) {
  const std::string text = asset_with(
      R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
         "metallicRoughnessTexture": {"index": 1}}, "normalTexture": {"index": 2})",
      {file_image("c.png"), file_image("d.png"), file_image("n.png")});
  ImageConversionCase conversion(
      text, {{"c.png", png_file(kRgb)}, {"d.png", png_file(kRgb)}, {"n.png", png_file(kRgb)}});
  conversion.options.images = {{ImageTarget::png, ImageClass::color},
                               {ImageTarget::jpeg, ImageClass::normal},
                               {ImageTarget::webp, std::nullopt}};
  const OrderedJson json = conversion.run();
  EXPECT_EQ(json["images"].dump(),
            R"([{"uri":"c.png"},{"uri":"d.webp","mimeType":"image/webp"},{"uri":"n.jpg"}])");
  EXPECT_EQ(conversion.step().what, "1 PNG -> JPEG, 1 PNG -> WebP exact");
}

TEST(CoreImages, ReplaceImagesOfExtensions) {
  const std::string webp = webp_file(kRgba);
  const std::string text = R"({"asset": {"version": "2.0"},
    "extensionsUsed": ["KHR_texture_transform", "EXT_texture_webp"],
    "extensionsRequired": ["EXT_texture_webp"],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions":
      {"KHR_texture_transform": {"scale": [2, 2]}}}}}],
    "textures": [{"extensions": {"EXT_texture_webp": {"source": 0}}, "name": "T"}],
    "images": [{"uri": "a.webp", "mimeType": "image/webp"}]})";
  ImageConversionCase conversion = to(ImageTarget::png, text, {{"a.webp", webp}});
  const OrderedJson json = conversion.run();
  EXPECT_EQ(json["textures"].dump(), R"([{"name":"T","source":0}])");
  EXPECT_EQ(json["images"].dump(), R"([{"uri":"a.png","mimeType":"image/png"}])");
  EXPECT_EQ(json["extensionsUsed"].dump(), R"(["KHR_texture_transform"])");
  EXPECT_FALSE(json.contains("extensionsRequired"));
  EXPECT_EQ(decoded(conversion.result.files.at("a.png")), decoded(webp));
  EXPECT_THAT(conversion.step().losses, IsEmpty());
  expect_settled(conversion);
}

TEST(FallbackImages, Stay) {
  const std::string text = R"({"asset": {"version": "2.0"},
    "extensionsUsed": ["EXT_texture_webp"],
    "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "textures": [{"source": 1, "extensions": {"EXT_texture_webp": {"source": 0}}}],
    "images": [{"uri": "a.webp"}, {"uri": "a.png"}]})";
  const std::map<std::string, std::string> files{{"a.webp", webp_file(kRgb)},
                                                 {"a.png", png_file(kRgb)}};
  ImageConversionCase webp = to(ImageTarget::webp, text, files);
  webp.run();
  EXPECT_EQ(webp.result.bytes, text);
  EXPECT_EQ(webp.left(),
            "/images/1: not WebP: /textures/0 uses it as the fallback for another image\n");
  ImageConversionCase png = to(ImageTarget::png, text, files);
  png.run();
  EXPECT_EQ(png.result.bytes, text);
  EXPECT_EQ(png.left(), "/images/0: not PNG: /textures/0 has another image in another format\n");
}

TEST(ImagesWithoutATexture, DoNotBecomeWebp) {
  const std::string text = R"({"asset": {"version": "2.0"}, "images": [{"uri": "a.png"}]})";
  ImageConversionCase conversion = to(ImageTarget::webp, text, {{"a.png", png_file(kRgb)}});
  conversion.run();
  EXPECT_EQ(conversion.left(), "/images/0: not WebP: no texture uses it\n");
}

TEST(ImagesOfUnknownExtensions, AreNotConvertedWithLoss) {
  const std::string text = asset_with(kColorSlot, {file_image("a.png")}, R"(,
    "extensionsUsed": ["ACME_logo"], "extensions": {"ACME_logo": {"image": 0}})");
  ImageConversionCase conversion = to(ImageTarget::webp, text, {{"a.png", png_file(kRgb)}});
  conversion.run();
  EXPECT_EQ(conversion.left(),
            "/images/0: not WebP: /extensions/ACME_logo/image uses it without a texture\n");
  conversion.options.images = {{ImageTarget::jpeg, std::nullopt}};
  conversion.run();
  EXPECT_THAT(conversion.left(), HasSubstr("it would lose data, and /extensions/ACME_logo/image"));
}

TEST(BrokenTextures, KeepTheirImages) {
  for (const char* texture :
       {R"({"source": 0, "extensions": [1]})", R"({"source": 0, "extensions": "no"})"}) {
    std::string text = asset_with(kColorSlot, {file_image("a.png")});
    text.replace(text.find(R"({"source": 0})"), 13, texture);
    ImageConversionCase conversion = to(ImageTarget::webp, text, {{"a.png", png_file(kRgb)}});
    conversion.run();
    EXPECT_EQ(conversion.left(), "/images/0: not WebP: /textures/0 has broken extensions\n");
  }
}

TEST(Images, DoNotDependOnTheNumberOfThreads) {
  std::vector<std::string> images;
  std::map<std::string, std::string> files;
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::string name = "i" + std::to_string(i) + ".png";
    images.push_back(file_image(name));
    files[name] = png_file({16 + i, 16, 3, 8});
  }
  ImageConversionCase one = to(ImageTarget::webp, asset_with(kColorSlot, images), files);
  one.run();
  ImageConversionCase four = one;
  four.options.jobs = 4;
  four.run();
  EXPECT_THAT(one.result.files, SizeIs(6));
  EXPECT_EQ(one.result.files, four.result.files);
  EXPECT_EQ(one.result.bytes, four.result.bytes);
}

}  // namespace
}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
// Images in the data phase: format, header, declared type; textures that use them.
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "image/ktx2_builder.hpp"
#include "image/png_builder.hpp"
#include "rules/data_asset.hpp"

namespace gltfx::test {
namespace {

const std::set<std::string, std::less<>>& image_codes() {
  static const std::set<std::string, std::less<>> codes{"IMAGE_DATA_INVALID",
                                                        "IMAGE_FEATURES_UNSUPPORTED",
                                                        "IMAGE_MIME_TYPE_INVALID",
                                                        "IMAGE_NON_ENABLED_MIME_TYPE",
                                                        "IMAGE_NPOT_DIMENSIONS",
                                                        "IMAGE_UNEXPECTED_EOS",
                                                        "IMAGE_UNRECOGNIZED_FORMAT",
                                                        "INVALID_URI",
                                                        "TEXTURE_INVALID_IMAGE_MIME_TYPE"};
  return codes;
}

std::string image_uri(const std::string& type, const std::string& bytes) {
  return "data:" + type + ";base64," + base64(bytes);
}

// An image in a data URI, and further members of the root.
std::string with_image(const std::string& type, const std::string& bytes,
                       const std::string& more = {}, const std::string& root = {}) {
  return asset_with(R"("images": [{"uri": ")" + image_uri(type, bytes) + "\"" + more + "}]" + root);
}

Lines about(const std::string& asset, Profile profile = Profile::standard) {
  return selected(asset, image_codes(), profile);
}

std::string small_webp() { return webp("VP8L", std::string("\x2f\xff\xc0\x1f\x00", 5)); }

TEST(Images, ThatAreRightAreSilent) {
  EXPECT_EQ(about(with_image("image/png", png())), Lines());
  EXPECT_EQ(about(with_image("image/jpeg", whole_jpeg())), Lines());
  EXPECT_EQ(about(with_image("image/png", png(), R"(, "mimeType": "image/png")")), Lines());
}

TEST(Images, InABufferViewAreReadFromThere) {
  DataAsset asset;
  asset.view(png(png_chunk("gAMA", "12345")));
  asset.view(png());
  const std::string images =
      R"("images": [{"bufferView": 0, "mimeType": "image/png"}, {"bufferView": 1, "mimeType": "image/jpeg"}])";
  EXPECT_EQ(about(asset.text(images)), (Lines{"IMAGE_DATA_INVALID /images/0",
                                              "IMAGE_MIME_TYPE_INVALID /images/1/bufferView"}));
}

TEST(Images, OfUnknownFormat) {
  EXPECT_EQ(about(with_image("image/png", "GIF89a, and some more bytes")),
            (Lines{"IMAGE_UNRECOGNIZED_FORMAT /images/0"}));
  EXPECT_EQ(about(with_image("image/png", "")), (Lines{"IMAGE_UNRECOGNIZED_FORMAT /images/0"}));
}

TEST(Images, CutAtEveryByteOfTheirHeaderAreNamedAndNeverReadBeyond) {
  const std::string whole = png();
  for (std::size_t size = 14; size < whole.find("IDAT") + 4; ++size) {
    EXPECT_EQ(about(with_image("image/png", whole.substr(0, size))),
              (Lines{"IMAGE_UNEXPECTED_EOS /images/0"}))
        << size;
  }
}

TEST(Images, HeadersThatCannotBeMeantAreInvalidOnlyForUs) {
  const std::string asset = with_image("image/png", png({}, {4, 4, 3, 2, 0}));
  EXPECT_EQ(about(asset), (Lines{"IMAGE_DATA_INVALID /images/0"}));
  EXPECT_EQ(about(asset, Profile::khronos), Lines());
}

TEST(Images, OfAnotherFormatThanTheySay) {
  EXPECT_EQ(about(with_image("image/png", png(), R"(, "mimeType": "image/jpeg")")),
            (Lines{"IMAGE_MIME_TYPE_INVALID /images/0/uri"}));
  const std::string uri = with_image("image/jpeg", png());
  EXPECT_EQ(about(uri), (Lines{"IMAGE_MIME_TYPE_INVALID /images/0/uri"}));
  EXPECT_EQ(about(uri, Profile::khronos), (Lines{"INVALID_URI /images/0/uri"}));
}

TEST(Images, WhoseSidesAreNoPowersOfTwoAreAHint) {
  const std::string asset = with_image("image/png", png({}, {5, 4, 8, 2, 0}));
  ValidateOptions standard;
  EXPECT_EQ(verdict(asset, standard), (Lines{"UNUSED_OBJECT /images/0"}));
  EXPECT_EQ(about(asset, Profile::strict), (Lines{"IMAGE_NPOT_DIMENSIONS /images/0"}));
  const FileReport report = validate_bytes(asset, "test", [] {
    ValidateOptions options;
    options.profile = Profile::khronos;
    options.select = {"IMAGE_NPOT_DIMENSIONS"};
    return options;
  }());
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::info);
}

Severity feature_severity(const std::string& asset, Profile profile) {
  ValidateOptions options;
  options.profile = profile;
  options.select = {"IMAGE_FEATURES_UNSUPPORTED"};
  const FileReport report = validate_bytes(asset, "test", options);
  return report.diagnostics.empty() ? Severity::hint : report.diagnostics[0].severity;
}

TEST(Images, ColourSpacesOfTheirOwnAreAnInfoAndForKhronosAWarning) {
  const std::string gamma = with_image("image/png", png(png_chunk("gAMA", be32(60000))));
  EXPECT_EQ(feature_severity(gamma, Profile::standard), Severity::info);
  EXPECT_EQ(feature_severity(gamma, Profile::khronos), Severity::warning);
  const std::string linear = with_image("image/png", png(png_chunk("gAMA", be32(100000))));
  EXPECT_EQ(feature_severity(linear, Profile::standard), Severity::info);
  EXPECT_EQ(about(linear, Profile::khronos), Lines());
}

TEST(Images, MetadataOfCamerasIsAnInfoInWebp) {
  const auto flagged = [](char flags) {
    return with_image("image/webp", extended_webp(flags), {},
                      R"(, "extensionsUsed": ["EXT_texture_webp"])");
  };
  EXPECT_EQ(about(flagged('\x08')), Lines{"IMAGE_FEATURES_UNSUPPORTED /images/0"});
  EXPECT_EQ(feature_severity(flagged('\x08'), Profile::standard), Severity::info);
  EXPECT_EQ(about(flagged('\x08'), Profile::khronos), Lines());
  EXPECT_EQ(about(flagged('\x04')), Lines()) << "XMP is not among them";
}

TEST(Images, ColourProfilesAreAnInfoInEveryFormat) {
  const std::string icc = jpeg_segment(0xE2, "ICC_PROFILE.....");
  const std::string photo = with_image("image/jpeg", whole_jpeg(icc));
  EXPECT_EQ(feature_severity(photo, Profile::standard), Severity::info);
  EXPECT_EQ(about(photo, Profile::khronos), Lines());
  const std::string png_icc = with_image("image/png", png(png_chunk("iCCP", "profile")));
  EXPECT_EQ(feature_severity(png_icc, Profile::standard), Severity::info);
  EXPECT_EQ(feature_severity(png_icc, Profile::khronos), Severity::warning);
}

TEST(Images, AnimatedWebpIsAWarning) {
  const std::string bytes =
      webp_file(webp_chunk("VP8X", le(2, 4) + le(3, 3) + le(3, 3)) +
                webp_chunk("ANIM", std::string(6, 'x')) + webp_chunk("ANMF", std::string(16, 'x')));
  const std::string animated =
      with_image("image/webp", bytes, {}, R"(, "extensionsUsed": ["EXT_texture_webp"])");
  EXPECT_EQ(about(animated), (Lines{"IMAGE_FEATURES_UNSUPPORTED /images/0"}));
  EXPECT_EQ(feature_severity(animated, Profile::standard), Severity::warning);
  EXPECT_EQ(message(animated, "IMAGE_FEATURES_UNSUPPORTED"),
            "The image is animated: some loaders show its first frame, others fail.");
  EXPECT_EQ(message(animated, "IMAGE_FEATURES_UNSUPPORTED", Profile::khronos),
            "The image has animation, which glTF ignores.");
}

Severity data_severity(const std::string& asset) {
  ValidateOptions options;
  options.select = {"IMAGE_DATA_INVALID"};
  const FileReport report = validate_bytes(asset, "test", options);
  return report.diagnostics.empty() ? Severity::hint : report.diagnostics[0].severity;
}

TEST(Images, ErrorsOfTheirHeaderAreAsLoudAsReadersTakeThem) {
  const auto png_with = [](const std::string& chunks, const PngHeader& header) {
    return with_image("image/png", png(chunks, header));
  };
  EXPECT_EQ(data_severity(png_with({}, {})), Severity::hint) << "nothing is said";
  EXPECT_EQ(data_severity(png_with({}, {4, 4, 4, 2})), Severity::error);
  EXPECT_EQ(data_severity(png_with(png_chunk("tRNS", "a"), {})), Severity::warning);
  EXPECT_EQ(data_severity(png_with(png_chunk("PLTE", "abc"), {4, 4, 8, 0})), Severity::info);
  EXPECT_EQ(about(png_with(png_chunk("tRNS", "a"), {}), Profile::khronos), Lines());
  EXPECT_EQ(about(png_with({}, {4, 4, 4, 2}), Profile::khronos), Lines());
  EXPECT_EQ(about(with_image("image/jpeg", jpeg(jpeg_frame(3, 0xC3))), Profile::khronos), Lines());
}

TEST(Images, AnimationsAreAWarningInPngOnlyForUs) {
  const std::string animated = with_image("image/png", png(png_chunk("acTL", "12345678")));
  EXPECT_EQ(feature_severity(animated, Profile::standard), Severity::warning);
  EXPECT_EQ(about(animated, Profile::khronos), Lines());
}

const std::string kWebp = R"(, "extensionsUsed": ["EXT_texture_webp"])";

TEST(Images, OfFormatsThatExtensionsBringNeedThem) {
  EXPECT_EQ(about(with_image("image/webp", small_webp())),
            (Lines{"IMAGE_NON_ENABLED_MIME_TYPE /images/0"}));
  EXPECT_EQ(about(with_image("image/webp", small_webp(), {}, kWebp)), Lines());
  EXPECT_EQ(about(with_image("image/webp", small_webp(), {}, kWebp), Profile::khronos), Lines());
}

TEST(Images, AvifIsReadWithADeclaredExtension) {
  std::ifstream in(GLTFX_SOURCE_DIR "/tests/codec/avif/rgba.avif", std::ios::binary);
  const std::string file{std::istreambuf_iterator<char>(in), {}};
  const std::string avif = R"(, "extensionsUsed": ["EXT_texture_avif"])";
  EXPECT_EQ(about(with_image("image/avif", file)), (Lines{"IMAGE_UNRECOGNIZED_FORMAT /images/0"}));
  EXPECT_EQ(about(with_image("image/avif", file, {}, avif)), Lines());
  EXPECT_EQ(about(with_image("image/avif", file, {}, avif), Profile::khronos),
            (Lines{"IMAGE_UNRECOGNIZED_FORMAT /images/0"}));
  EXPECT_EQ(about(with_image("image/avif", file.substr(0, file.size() - 10), {}, avif)),
            (Lines{"IMAGE_DATA_INVALID /images/0"}));
}

TEST(Images, Ktx2IsReadWithADeclaredExtension) {
  const std::string basis = R"(, "extensionsUsed": ["KHR_texture_basisu"])";
  EXPECT_EQ(about(with_image("image/ktx2", Ktx2Builder().file())),
            (Lines{"IMAGE_NON_ENABLED_MIME_TYPE /images/0"}));
  EXPECT_EQ(about(with_image("image/ktx2", Ktx2Builder().file(), {}, basis)), Lines());
  EXPECT_EQ(about(with_image("image/ktx2", Ktx2Builder().file(), {}, basis), Profile::khronos),
            (Lines{"IMAGE_UNRECOGNIZED_FORMAT /images/0"}));
  EXPECT_EQ(about(with_image("image/ktx2", Ktx2Builder().file().substr(0, 60), {}, basis)),
            (Lines{"IMAGE_UNEXPECTED_EOS /images/0"}));
}

TEST(Images, ThatUnknownExtensionsHaveASayInAreSkippedByKhronos) {
  const std::string asset =
      with_image("image/png", "GIF89a, and some more bytes", R"(, "extensions": {"VENDOR_x": {}})");
  EXPECT_EQ(about(asset, Profile::khronos), (Lines{"INVALID_URI /images/0/uri"}));
  EXPECT_EQ(about(asset), (Lines{"IMAGE_UNRECOGNIZED_FORMAT /images/0"}));
}

std::string with_texture(const std::string& texture) {
  return with_image("image/webp", small_webp(), {}, kWebp + R"(, "textures": [)" + texture + "]");
}

TEST(Textures, ShowPngAndJpeg) {
  EXPECT_EQ(about(with_texture(R"({"source": 0})")),
            (Lines{"TEXTURE_INVALID_IMAGE_MIME_TYPE /textures/0/source"}));
  EXPECT_EQ(about(with_texture(R"({"source": 0})"), Profile::khronos),
            (Lines{"TEXTURE_INVALID_IMAGE_MIME_TYPE /textures/0/source"}));
  EXPECT_EQ(about(with_texture(R"({"extensions": {"EXT_texture_webp": {"source": 0}}})")), Lines());
}

TEST(Textures, ExtensionsShowTheirOwnFormat) {
  const std::string asset = with_image(
      "image/png", png(), {},
      kWebp +
          R"(, "textures": [{"source": 0, "extensions": {"EXT_texture_webp": {"source": 0}}}])");
  const Lines wrong{
      "TEXTURE_INVALID_IMAGE_MIME_TYPE /textures/0/extensions/EXT_texture_webp/source"};
  EXPECT_EQ(about(asset), wrong);
  EXPECT_EQ(about(asset, Profile::khronos), wrong);
}

TEST(Textures, OfAFormatThatNothingBringsAreNotBlamedTwice) {
  const std::string asset =
      with_image("image/webp", small_webp(), {}, R"(, "textures": [{"source": 0}])");
  EXPECT_EQ(about(asset), (Lines{"IMAGE_NON_ENABLED_MIME_TYPE /images/0"}));
  EXPECT_EQ(about(asset, Profile::khronos).size(), 2U);
}

TEST(Images, TheReportListsThem) {
  const FileReport report = validate_bytes(with_image("image/png", png()), "test", {});
  ASSERT_TRUE(report.info);
  ASSERT_EQ(report.info->resources.size(), 1U);
  const ResourceInfo& listed = report.info->resources[0];
  EXPECT_EQ(listed.pointer, "/images/0");
  EXPECT_EQ(listed.mime_type, "image/png");
  EXPECT_EQ(listed.storage, "data-uri");
  EXPECT_FALSE(listed.byte_length);
  ASSERT_TRUE(listed.image);
  EXPECT_EQ(listed.image->width, 4U);
  EXPECT_EQ(listed.image->height, 2U);
  EXPECT_EQ(listed.image->format, "rgb");
  EXPECT_EQ(listed.image->primaries, "srgb");
}

}  // namespace
}  // namespace gltfx::test

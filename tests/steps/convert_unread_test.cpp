// SPDX-License-Identifier: Apache-2.0
// Files that cannot be read refuse the steps that need them: nothing is skipped silently.
#include <gmock/gmock.h>

#include "convert_image_support.hpp"
#include "geometry_support.hpp"

namespace gltfx {
namespace {

using test::asset_with;
using test::file_image;
using test::ImageConversionCase;
using test::kColorSlot;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Ask = void (*)(ConvertOptions&);

std::vector<std::string> refused_by(const ConvertReport& report) {
  std::vector<std::string> refused;
  for (const ConvertStep& step : report.steps) {
    for (const ConvertNote& note : step.refused) {
      refused.push_back(std::string(step.step) + " " + note.pointer + ": " + note.reason);
    }
  }
  return refused;
}

// A grid whose buffer file is missing, and an image in another file.
std::string grid_text() {
  test::AssetText asset;
  const test::OrderedJson primitive = asset.grid();
  asset.json["meshes"].push_back({{"primitives", {primitive}}});
  asset.json["nodes"].push_back({{"mesh", 0}});
  test::OrderedJson json = asset.json;
  json["asset"]["version"] = "2.0";
  json["buffers"] = test::OrderedJson::array();
  json["buffers"].push_back({{"byteLength", asset.bytes.size()}, {"uri", "b.bin"}});
  return json.dump();
}

TEST(UnreadBuffers, RefuseEveryStepOfGeometry) {
  const std::map<std::string, Ask> asks{
      {"prune", [](ConvertOptions& options) { options.prune = true; }},
      {"dedup", [](ConvertOptions& options) { options.dedup = true; }},
      {"weld", [](ConvertOptions& options) { options.weld = true; }},
      {"resample", [](ConvertOptions& options) { options.resample = true; }},
      {"reorder", [](ConvertOptions& options) { options.reorder = true; }},
      {"decode", [](ConvertOptions& options) { options.compress = Compression::none; }},
      {"decode", [](ConvertOptions& options) { options.compress = Compression::meshopt; }},
      {"decode", [](ConvertOptions& options) { options.compress = Compression::draco; }}};
  for (const auto& [step, ask] : asks) {
    ImageConversionCase missing(grid_text(), {});
    ask(missing.options);
    missing.result = convert_bytes(missing.asset, missing.options);
    EXPECT_EQ(missing.result.report.problem, EditProblem::refused) << step;
    EXPECT_THAT(refused_by(missing.result.report),
                ElementsAre(step + " /buffers/0: cannot be loaded: 'b.bin' is not checked because "
                                   "standard input has no folder"));
    ImageConversionCase cut(grid_text(), {{"b.bin", "1234"}});
    ask(cut.options);
    cut.result = convert_bytes(cut.asset, cut.options);
    EXPECT_THAT(refused_by(cut.result.report),
                ElementsAre(step + " /buffers/0: is shorter than its byteLength"));
  }
}

TEST(UnreadBuffers, DoNotRefuseStepsThatReadNone) {
  ImageConversionCase conversion(grid_text(), {});
  conversion.options.images = {{ImageTarget::webp, std::nullopt}};
  conversion.run();
  EXPECT_THAT(refused_by(conversion.result.report), IsEmpty());
}

ImageConversionCase two_images() {
  ImageConversionCase conversion(
      asset_with(R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
                    "emissiveTexture": {"index": 1})",
                 {file_image("none.png"), file_image("b.png")}),
      {{"b.png", test::png_file({64, 32, 3, 8})}});
  conversion.options.images = {{ImageTarget::webp, std::nullopt}};
  return conversion;
}

TEST(UnreadImages, RefuseTheAsset) {
  ImageConversionCase conversion = two_images();
  conversion.result = convert_bytes(conversion.asset, conversion.options);
  EXPECT_EQ(conversion.result.report.problem, EditProblem::refused);
  EXPECT_THAT(
      refused_by(conversion.result.report),
      ElementsAre(
          "images /images/0: 'none.png' is not checked because standard input has no folder"));
  EXPECT_THAT(conversion.result.files, IsEmpty());
}

TEST(UnreadImages, StayIfTheRestIsWanted) {
  ImageConversionCase conversion = two_images();
  conversion.options.partial = true;
  const test::OrderedJson json = conversion.run();
  EXPECT_EQ(json["images"].dump(),
            R"([{"uri":"none.png"},{"uri":"b.webp","mimeType":"image/webp"}])");
  EXPECT_EQ(conversion.result.report.refused(), 1U);
}

TEST(UnreadImages, DoNotMatterIfNothingIsRequestedOfThem) {
  ImageConversionCase conversion = two_images();
  conversion.options.images = {{ImageTarget::webp, ImageClass::normal}};
  conversion.run();
  EXPECT_THAT(refused_by(conversion.result.report), IsEmpty());
  EXPECT_EQ(conversion.left(), "");
}

TEST(UnreadImages, RefuseToBeCompared) {
  ImageConversionCase conversion = two_images();
  conversion.options.images.clear();
  conversion.options.dedup = true;
  conversion.result = convert_bytes(conversion.asset, conversion.options);
  EXPECT_EQ(conversion.result.report.problem, EditProblem::refused);
  EXPECT_THAT(
      refused_by(conversion.result.report),
      ElementsAre(
          "dedup /images/0: 'none.png' is not checked because standard input has no folder"));
}

// What `git clone` leaves where Git LFS is not installed.
TEST(UnreadImages, AreNamedAsPointersOfGitLfs) {
  const container::test::TempFolder folder;
  folder.write("a.png",
               "version https://git-lfs.github.com/spec/v1\noid sha256:"
               "4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393\nsize 12345\n");
  ConvertOptions options;
  options.images = {{ImageTarget::webp, std::nullopt}};
  const ConvertReport report = convert_file(
      folder.write("a.gltf", asset_with(kColorSlot, {file_image("a.png")})).native(), options);
  EXPECT_EQ(report.problem, EditProblem::refused);
  EXPECT_THAT(report.error, HasSubstr("is a Git LFS pointer"));
}

const codec::Raster kPlain{64, 32, 3, 8};

ImageConversionCase color_to_webp(const std::string& file) {
  ImageConversionCase conversion(asset_with(kColorSlot, {file_image("a.png")}), {{"a.png", file}});
  conversion.options.images = {{ImageTarget::webp, std::nullopt}};
  return conversion;
}

// Broken files by what is said about them.
std::map<std::string, std::string> broken_files() {
  const std::string png = test::png_file(kPlain);
  std::string damaged = png;
  damaged.replace(60, 8, "xxxxxxxx");
  return {{damaged, "it cannot be decoded"},
          {test::jpeg_file(kPlain).substr(0, 700), "it cannot be decoded"},
          {png.substr(0, 40), "it is broken"},
          {"", "it is an empty file"}};
}

TEST(BrokenImages, RefuseARequest) {
  for (const auto& [file, why] : broken_files()) {
    ImageConversionCase conversion = color_to_webp(file);
    conversion.result = convert_bytes(conversion.asset, conversion.options);
    EXPECT_EQ(conversion.result.report.problem, EditProblem::refused) << why;
    ASSERT_THAT(conversion.step().refused, testing::SizeIs(1)) << why;
    EXPECT_THAT(conversion.step().refused.front().reason, testing::StartsWith(why));
  }
}

TEST(BrokenImages, RefuseASizeThatTheyMayExceed) {
  ImageConversionCase conversion = color_to_webp(test::png_file(kPlain).substr(0, 40));
  conversion.options.images.clear();
  conversion.options.texture_size = 16;
  conversion.result = convert_bytes(conversion.asset, conversion.options);
  EXPECT_EQ(conversion.result.report.problem, EditProblem::refused);
}

TEST(BrokenImages, AreNotCompressedBetter) {
  for (const auto& [file, why] : broken_files()) {
    ImageConversionCase conversion = color_to_webp(file);
    conversion.options.images.clear();
    conversion.options.shrink = true;
    conversion.run();
    EXPECT_FALSE(conversion.step().changes) << why;
    EXPECT_THAT(conversion.step().refused, IsEmpty()) << why;
  }
}

TEST(ImagesOfUnknownFormats, AreLeftUnlessTheyMustBeLegal) {
  ImageConversionCase conversion = color_to_webp("hello");
  conversion.run();
  EXPECT_EQ(conversion.left(), "/images/0: it is in an unknown format\n");
  conversion.options.images = {{ImageTarget::legal, std::nullopt}};
  conversion.result = convert_bytes(conversion.asset, conversion.options);
  EXPECT_EQ(conversion.result.report.problem, EditProblem::refused);
}

}  // namespace
}  // namespace gltfx

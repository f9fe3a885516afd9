// SPDX-License-Identifier: Apache-2.0
// From a file to pictures, through the library's door.
#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/client.hpp"
#include "container/temp_folder.hpp"
#include "pipeline/bake_names.hpp"
#include "pipeline/environment_file.hpp"
#include "pipeline/picture_file.hpp"
#include "pipeline/picture_names.hpp"

namespace gltfx {
namespace {

using container::test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::string fixture(const std::string& name) {
  return std::string(GLTFX_SOURCE_DIR) + "/fixtures/good/" + name;
}

std::string content(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

BakeOptions quick() {
  BakeOptions options;
  options.sizes = {{24, 16}};
  options.samples = 4;
  options.bounces = 2;
  options.jobs = 1;
  return options;
}

codec::Image decoded(const std::string& file, codec::ImageFormat format) {
  codec::ImageRequest request;
  request.bytes = std::as_bytes(std::span(file));
  request.format = format;
  request.pixels = true;
  auto result = codec::Client::shared().decode_image(request);
  EXPECT_TRUE(std::holds_alternative<codec::Image>(result));
  return std::get<codec::Image>(result);
}

TEST(BakeFile, WritesThePictureThatItReports) {
  const TempFolder folder;
  BakeOptions options = quick();
  options.output = (folder.path() / "new" / "leaf.png").native();
  const BakeReport report = bake_file(fixture("leaf.gltf"), options);
  EXPECT_EQ(report.problem, BakeProblem::none) << report.error;
  EXPECT_THAT(report.written, ElementsAre(options.output));
  EXPECT_EQ(report.pixels.width, 24U);
  const codec::Image image = decoded(content(options.output), codec::ImageFormat::png);
  ASSERT_EQ(image.pixels.size(), report.pixels.bytes.size());
  EXPECT_TRUE(std::ranges::equal(image.pixels, std::as_bytes(std::span(report.pixels.bytes))));
}

TEST(BakeFile, TheSameBytesFromAnyNumberOfThreads) {
  BakeOptions options = quick();
  const BakeReport one = bake_file(fixture("bowl.glb"), options);
  options.jobs = 2;
  const BakeReport two = bake_file(fixture("bowl.glb"), options);
  EXPECT_EQ(one.pixels.bytes, two.pixels.bytes);
  EXPECT_FALSE(one.pixels.bytes.empty());
}

TEST(BakeFile, SizesTurntablesAndLayersAreFilesOfTheirOwn) {
  const TempFolder folder;
  BakeOptions options = quick();
  options.samples = 1;
  options.sizes = {{8, 8}, {12, 6}};
  options.turntable = 2;
  options.layers = {BakeLayer::normal, BakeLayer::depth};
  options.output = (folder.path() / "a.png").native();
  const BakeReport report = bake_file(fixture("leaf.gltf"), options);
  ASSERT_EQ(report.written.size(), 12U);
  EXPECT_THAT(report.written[0], HasSubstr("a-8x8-000.png"));
  EXPECT_THAT(report.written[1], HasSubstr("a-8x8-000-normal.png"));
  EXPECT_THAT(report.written[11], HasSubstr("a-12x6-001-depth.png"));
}

TEST(BakeFile, FloatsKeepWhatIsBrighterThanWhite) {
  const TempFolder folder;
  BakeOptions options = quick();
  options.output = (folder.path() / "a.exr").native();
  options.exposure = 8;
  EXPECT_EQ(bake_file(fixture("leaf.gltf"), options).error, "");
  const codec::Image image = decoded(content(options.output), codec::ImageFormat::openexr);
  ASSERT_EQ(image.bits, 32U);
  float most = 0;
  for (std::size_t i = 0; i < image.texels() * image.channels; ++i) {
    float value = 0;
    std::memcpy(&value, image.pixels.data() + i * sizeof value, sizeof value);
    most = std::max(most, value);
  }
  EXPECT_GT(most, 2);
}

TEST(BakeFile, TransparencyIsAlpha) {
  BakeOptions options = quick();
  options.background = {BakeBackground::Kind::transparent};
  const BakeReport report = bake_file(fixture("leaf.gltf"), options);
  ASSERT_EQ(report.pixels.channels, 4U);
  EXPECT_EQ(report.pixels.bytes[3], 0);
  const std::size_t middle = (std::size_t{8} * 24 + 12) * 4;
  EXPECT_EQ(report.pixels.bytes[middle + 3], 255);
  options.output = "a.jpg";
  EXPECT_EQ(bake_file(fixture("leaf.gltf"), options).problem, BakeProblem::refused);
}

TEST(BakeFile, WhatIsNotValidIsDrawnUnlessAsked) {
  const TempFolder folder;
  std::string text = content(fixture("triangle.gltf"));
  const std::size_t version = text.find("\"asset\"");
  ASSERT_NE(version, std::string::npos);
  text.insert(version, "\"scene\": 7, ");
  if (text.find("\"scene\":", version + 12) != std::string::npos) {
    text.replace(text.find("\"scene\":", version + 12), 8, "\"other\":");
  }
  for (const char* buffer : {"triangle.bin"}) {
    if (const std::string bytes = content(fixture(buffer)); !bytes.empty()) {
      folder.write(buffer, bytes);
    }
  }
  const std::string path = folder.write("a.gltf", text).native();
  BakeOptions options = quick();
  options.strict = true;
  const BakeReport refused = bake_file(path, options);
  EXPECT_EQ(refused.problem, BakeProblem::invalid);
  EXPECT_FALSE(refused.validation.diagnostics.empty());
  EXPECT_TRUE(refused.pixels.bytes.empty());
  options.strict = false;
  const BakeReport drawn = bake_file(path, options);
  EXPECT_EQ(drawn.problem, BakeProblem::none) << drawn.error;
  EXPECT_FALSE(drawn.validation.diagnostics.empty());
}

TEST(BakeFile, NothingToSeeIsSaid) {
  const TempFolder folder;
  const std::string path = folder.write("a.gltf", R"({"asset":{"version":"2.0"}})").native();
  EXPECT_EQ(bake_file(path, quick()).problem, BakeProblem::nothing_to_see);
  EXPECT_EQ(bake_file((folder.path() / "none.gltf").native(), quick()).problem,
            BakeProblem::unreadable);
  EXPECT_EQ(bake_file(folder.write("b.gltf", "{").native(), quick()).problem,
            BakeProblem::unreadable);
}

TEST(BakeFile, UnknownNamesAreRefused) {
  BakeOptions options = quick();
  options.cameras = {"elsewhere"};
  const BakeReport report = bake_file(fixture("leaf.gltf"), options);
  EXPECT_EQ(report.problem, BakeProblem::refused);
  EXPECT_THAT(report.error, HasSubstr("no camera"));
  options.cameras = {"30,20"};
  EXPECT_EQ(bake_file(fixture("leaf.gltf"), options).problem, BakeProblem::none);
  options.variant = "0";
  EXPECT_THAT(bake_file(fixture("leaf.gltf"), options).error, HasSubstr("no variant"));
  options.variant.clear();
  options.environment = fixture("leaf.gltf");
  EXPECT_THAT(bake_file(fixture("leaf.gltf"), options).error,
              HasSubstr("has no known image format"));
}

TEST(BakeFile, PresetsOfTheCameraAreAngles) {
  const std::vector<std::pair<const char*, const char*>> presets{
      {"front", "0,0"}, {"back", "180,0"},   {"left", "90,0"},       {"right", "-90,0"},
      {"top", "0,90"},  {"bottom", "0,-90"}, {"iso", "45,35.264389"}};
  for (const auto& [preset, angles] : presets) {
    BakeOptions options = quick();
    options.cameras = {preset};
    const BakeReport first = bake_file(fixture("leaf.gltf"), options);
    options.cameras = {angles};
    EXPECT_EQ(first.problem, BakeProblem::none) << first.error;
    EXPECT_EQ(first.pixels.bytes, bake_file(fixture("leaf.gltf"), options).pixels.bytes) << preset;
  }
}

TEST(BakeFile, ProgressReachesTheEnd) {
  double last = 0;
  BakeOptions options = quick();
  options.turntable = 2;
  options.progress = [&last](double part) {
    EXPECT_GE(part, last);
    last = part;
  };
  bake_file(fixture("leaf.gltf"), options);
  EXPECT_DOUBLE_EQ(last, 1);
}

TEST(BakeEmbed, TheAssetGetsAThumbnailAndStaysValid) {
  const TempFolder folder;
  const std::string path = folder.write("bowl.glb", content(fixture("bowl.glb"))).native();
  BakeOptions options = quick();
  options.embed = true;
  ASSERT_TRUE(bake_file(path, options).embedded);
  const std::string once = content(path);
  EXPECT_THAT(once, HasSubstr("\"thumbnail\""));
  EXPECT_EQ(validate_file(path).counts.errors, 0U);
  EXPECT_TRUE(bake_file(path, options).embedded);
  EXPECT_EQ(validate_file(path).counts.errors, 0U);
}

TEST(BakeEmbed, TextGetsADataUri) {
  const TempFolder folder;
  for (const char* name : {"leaf.gltf", "leaf.bin", "leaf_color.png", "leaf_transmission.png"}) {
    folder.write(name, content(fixture(name)));
  }
  const std::string path = (folder.path() / "leaf.gltf").native();
  BakeOptions options = quick();
  options.embed = true;
  const BakeReport report = bake_file(path, options);
  ASSERT_TRUE(report.embedded) << report.error;
  EXPECT_THAT(content(path), HasSubstr("data:image/png;base64,"));
  EXPECT_EQ(validate_file(path).counts.errors, 0U);
  const std::string once = content(path);
  EXPECT_TRUE(bake_file(path, options).embedded);
  EXPECT_EQ(content(path), once) << "the old thumbnail makes room";
}

TEST(BakeMany, PicturesComeOnOneSheet) {
  const TempFolder folder;
  std::vector<BakeProblem> problems;
  const std::string sheet = (folder.path() / "sheet.png").native();
  const std::string error =
      bake_files({{fixture("leaf.gltf"), ""}, {"nowhere.glb", ""}}, quick(), sheet,
                 [&](BakeReport&& report) { problems.push_back(report.problem); });
  EXPECT_EQ(error, "");
  EXPECT_THAT(problems, ElementsAre(BakeProblem::none, BakeProblem::unreadable));
  const codec::Image image = decoded(content(sheet), codec::ImageFormat::png);
  EXPECT_EQ(image.width, 48U);
  EXPECT_EQ(image.height, 16U);
}

TEST(BakeMany, ThreadsDoNotShow) {
  const TempFolder folder;
  const auto sheet_of = [&](unsigned jobs) {
    BakeOptions options = quick();
    options.jobs = jobs;
    std::vector<double> parts;
    options.progress = [&](double part) { parts.push_back(part); };
    std::vector<BakeInput> inputs;
    for (const char* name : {"bowl.glb", "leaf.gltf", "triangle.gltf", "bowl.glb"}) {
      inputs.push_back({fixture(name), ""});
    }
    std::vector<std::string> paths;
    const std::string sheet = (folder.path() / "sheet.png").native();
    EXPECT_EQ(bake_files(inputs, options, sheet,
                         [&](BakeReport&& report) { paths.push_back(report.path); }),
              "");
    for (std::size_t i = 0; i < inputs.size(); ++i) EXPECT_EQ(paths.at(i), inputs[i].path);
    EXPECT_THAT(parts, ElementsAre(0.25, 0.5, 0.75, 1));
    return content(sheet);
  };
  EXPECT_EQ(sheet_of(1), sheet_of(2));
}

TEST(BakeComparison, SameAssetsMakeTheSamePicture) {
  const TempFolder folder;
  BakeOptions options = quick();
  options.output = (folder.path() / "difference.png").native();
  const BakeComparison same = bake_comparison(fixture("bowl.glb"), fixture("bowl.glb"), options);
  EXPECT_TRUE(std::isinf(same.psnr));
  EXPECT_DOUBLE_EQ(same.ssim, 1);
  const codec::Image image = decoded(content(options.output), codec::ImageFormat::png);
  EXPECT_TRUE(image.statistics[0].constant());
  EXPECT_EQ(image.statistics[0].least, 128U);
  options.output.clear();
  const BakeComparison other = bake_comparison(fixture("bowl.glb"), fixture("lamp.gltf"), options);
  EXPECT_GT(other.psnr, 5);
  EXPECT_LT(other.psnr, 60);
  EXPECT_GT(other.ssim, 0);
  EXPECT_LT(other.ssim, 0.8);
}

TEST(EnvironmentFile, RadianceAndOpenExrAreRead) {
  const TempFolder folder;
  // 8 texels of red 1 and 4: mantissas of 128 at the exponents of 2 and 8.
  std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n";
  for (int i = 0; i < 8; ++i) hdr += std::string(i < 4 ? "\x80\0\0\x81" : "\x80\0\0\x83", 4);
  const auto image = read_environment(folder.write("sky.hdr", hdr).native());
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ((*image)->width, 4U);
  EXPECT_EQ((*image)->height, 2U);
  EXPECT_NEAR((*image)->radiance[0][0], 1, 0.01);
  EXPECT_NEAR((*image)->radiance[7][0], 4, 0.05);
  EXPECT_EQ((*image)->radiance[0][1], 0);

  preview::Picture picture{2, 1, 3, {}, {0.5F, 1, 70000, -1, NAN, 3}};
  const std::string path = (folder.path() / "sky.exr").native();
  EXPECT_FALSE(write_picture(picture, path));
  const auto floats = read_environment(path);
  ASSERT_TRUE(floats) << floats.error().message;
  EXPECT_THAT((*floats)->radiance[0], ElementsAre(0.5F, 1, 70000));
  EXPECT_THAT((*floats)->radiance[1], ElementsAre(0, 0, 3));
  EXPECT_FALSE(read_environment(folder.write("bad.hdr", "hello").native()));
}

TEST(EnvironmentFile, IntegersAreDecodedFromSrgb) {
  const TempFolder folder;
  const std::string path = (folder.path() / "sky.png").native();
  EXPECT_FALSE(write_picture(preview::Picture{2, 1, 3, {0, 188, 255, 188, 188, 188}, {}}, path));
  const auto image = read_environment(path);
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_NEAR((*image)->radiance[0][1], 0.503, 0.001);
  EXPECT_EQ((*image)->radiance[0][0], 0);
  EXPECT_EQ((*image)->radiance[0][2], 1);
  const std::string misnamed = (folder.path() / "sky.hdr").native();
  std::filesystem::copy(path, misnamed);
  const auto again = read_environment(misnamed);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ((*again)->radiance, (*image)->radiance);
}

TEST(BakeNames, ByNameThenByIndex) {
  const std::vector<std::string> names{"1", "front", ""};
  EXPECT_EQ(**find_named("camera", "1", names), 0U);
  EXPECT_EQ(**find_named("camera", "front", names), 1U);
  EXPECT_EQ(**find_named("camera", "2", names), 2U);
  EXPECT_EQ(*find_named("camera", "", names), std::nullopt);
  EXPECT_THAT(find_named("camera", "3", names).error().message, HasSubstr("'front'"));
  EXPECT_EQ(find_named("camera", "0", {}).error().message, "it has no camera");
}

TEST(BakeNames, Angles) {
  EXPECT_EQ(parse_angles("12.5,-3"), std::make_pair(12.5, -3.0));
  for (const char* word : {"", "1", "1,", ",1", "a,1", "1,2,3", "inf,0", "nan,1"}) {
    EXPECT_EQ(parse_angles(word), std::nullopt) << word;
  }
}

TEST(PictureFile, EndingsDecide) {
  EXPECT_EQ(*picture_format("a/b.PNG"), codec::EncodedFormat::png);
  EXPECT_EQ(*picture_format("a.jpeg"), codec::EncodedFormat::jpeg);
  EXPECT_THAT(picture_format("a.tga").error().message, HasSubstr(".webp"));
  EXPECT_EQ(with_suffix("a/b.c.png", "-1"), "a/b.c-1.png");
}

}  // namespace
}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
// `gltfx fix` converts images in formats that glTF does not allow, if that is asked for.
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "codec/support/foreign_files.hpp"
#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;

constexpr const char* kCode = "IMAGE_UNRECOGNIZED_FORMAT";

std::string asset_of(const std::string& image) {
  return R"({ "asset":{"version":"2.0"}, "extras":{"n":1.50},
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[)" +
         image + "]";
}

class FixImages : public testing::Test {
 protected:
  FixImages() {
    folder_.write("a.gltf", asset_of(R"({"name":"Wood","uri":"a.bmp"})") + "}");
    folder_.write("a.bmp", test::bmp_file());
  }
  Outcome fix(std::vector<std::string> more, const std::string& workers = {}) const {
    std::vector<std::string> words{"fix", "--only", kCode, "--unsafe"};
    words.insert(words.end(), more.begin(), more.end());
    Setting setting{folder_.path().native(), {}, {}};
    if (!workers.empty()) setting.environment.emplace_back("GLTFX_CODEC_WORKERS", workers);
    return gltfx(std::move(words), setting);
  }
  nlohmann::json json_of(const std::string& name) const {
    return nlohmann::json::parse(read_file((folder_.path() / name).native()));
  }
  bool has(const std::string& name) const { return fs::exists(folder_.path() / name); }
  std::string findings(const std::string& name) const {
    return gltfx({"validate", name}, {folder_.path().native(), {}, {}}).out;
  }

  container::test::TempFolder folder_;
};

TEST_F(FixImages, InPlaceTheyBecomePngBesideTheOldOnes) {
  EXPECT_THAT(findings("a.gltf"), HasSubstr(kCode));
  const Outcome outcome = fix({"a.gltf", "--in-place"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("IMAGE_UNRECOGNIZED_FORMAT (unsafe): 1 finding"),
                                 HasSubstr("new file: a-"), HasSubstr("1 finding fixed")));
  const std::string uri = json_of("a.gltf")["images"][0]["uri"];
  EXPECT_THAT(uri, MatchesRegex("a-[0-9a-f]{8}\\.png"));
  EXPECT_TRUE(has(uri));
  EXPECT_TRUE(has("a.bmp"));
  EXPECT_EQ(read_file((folder_.path() / "a.gltf").native()),
            asset_of(R"({"name":"Wood","uri":")" + uri + "\"}") + "}");
  EXPECT_THAT(findings("a.gltf"), Not(HasSubstr(kCode)));
  EXPECT_THAT(fix({"a.gltf", "--in-place"}).out, HasSubstr("nothing to fix"));
}

TEST_F(FixImages, ElsewhereTheOldOnesAreNotNeeded) {
  EXPECT_EQ(fix({"a.gltf", "-o", "out/"}).code, 0);
  EXPECT_TRUE(has("out/a.gltf"));
  EXPECT_FALSE(has("out/a.bmp"));
  EXPECT_TRUE(has("out/" + json_of("out/a.gltf")["images"][0]["uri"].get<std::string>()));
}

TEST_F(FixImages, InAChunkTheyStayThere) {
  std::string bmp = test::bmp_file();
  std::string text = asset_of(R"({"bufferView":0,"mimeType":"image/png"})") +
                     R"(,"buffers":[{"byteLength":)" + std::to_string(bmp.size()) +
                     R"(}],"bufferViews":[{"buffer":0,"byteLength":)" + std::to_string(bmp.size()) +
                     "}]}";
  text.resize((text.size() + 3) / 4 * 4, ' ');
  bmp.resize((bmp.size() + 3) / 4 * 4, '\0');
  const auto size = [](const std::string& part) { return static_cast<std::uint32_t>(part.size()); };
  test::FileBytes glb;
  glb.text("glTF").u32(2).u32(28 + size(text) + size(bmp));
  glb.u32(size(text)).text("JSON").text(text);
  glb.u32(size(bmp)).text(std::string_view("BIN\0", 4)).text(bmp);
  folder_.write("a.glb", glb.take());
  EXPECT_THAT(findings("a.glb"), HasSubstr(kCode));
  EXPECT_EQ(fix({"a.glb", "--in-place"}).code, 0);
  EXPECT_THAT(findings("a.glb"), AllOf(Not(HasSubstr(kCode)), Not(HasSubstr("error"))));
}

TEST_F(FixImages, OfSeveralAssetsAreOneFile) {
  folder_.write("b.gltf", asset_of(R"({"uri":"a.bmp"})") + "}");
  EXPECT_EQ(fix({"a.gltf", "b.gltf", "--in-place", "-j", "2"}).code, 0);
  EXPECT_EQ(json_of("a.gltf")["images"][0]["uri"], json_of("b.gltf")["images"][0]["uri"]);
  EXPECT_EQ(folder_.entries(), 4);
}

TEST_F(FixImages, WithoutTheDecoderNothingIsWrittenAndThePackageIsNamed) {
  folder_.write("a.gltf", asset_of(R"({"uri":"a.bmp"},{"uri":"a.bmp","name":"again"})") + "}");
  const std::string before = read_file((folder_.path() / "a.gltf").native());
  const Outcome outcome = fix({"a.gltf", "--in-place"}, (folder_.path() / "none").native());
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("a.gltf: This installation has no decoder for such images: "
                                     "install the package gltfx-openimageio"));
  EXPECT_EQ(read_file((folder_.path() / "a.gltf").native()), before);
}

TEST_F(FixImages, ThatCannotBeConvertedAreLeftWithTheReason) {
  folder_.write("a.gltf", asset_of(R"({"uri":"sky.png"},{"uri":"a.bmp"})") + "}");
  folder_.write("sky.png", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\nabcd");
  const Outcome outcome = fix({"a.gltf", "--in-place"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("1 finding left"), HasSubstr("tone mapping"),
                                 HasSubstr("1 finding fixed, 1 finding left")));
  EXPECT_EQ(json_of("a.gltf")["images"][0]["uri"], "sky.png");
}

TEST_F(FixImages, OfFormatsThatNeedAnExtensionHaveACodeOfTheirOwn) {
  constexpr const char* kWebp =
      R"({"uri":"data:image/webp;base64,UklGRhwAAABXRUJQVlA4TA8AAAAvAAAAAAcQ/Y/+ByKi/wEA"})";
  folder_.write("a.gltf", asset_of(std::string(kWebp) + R"(,{"uri":"a.bmp"})") + "}");
  const Setting here{folder_.path().native(), {}, {}};
  EXPECT_EQ(
      gltfx({"fix", "a.gltf", "--in-place", "--only", "IMAGE_NON_ENABLED_MIME_TYPE"}, here).code, 2)
      << "it is unsafe";
  EXPECT_EQ(
      gltfx({"fix", "a.gltf", "--in-place", "--unsafe", "--only", "IMAGE_NON_ENABLED_MIME_TYPE"},
            here)
          .code,
      0);
  const auto images = json_of("a.gltf")["images"];
  EXPECT_THAT(images[0]["uri"].get<std::string>(), testing::StartsWith("data:image/png;"));
  EXPECT_EQ(images[1]["uri"], "a.bmp") << "another code";
}

}  // namespace
}  // namespace gltfx::program

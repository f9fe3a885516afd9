// SPDX-License-Identifier: Apache-2.0
/// The program and its decoders.
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "codec/support/png_encoder.hpp"
#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

// A folder with workers that only leave a trace of having been started.
class Workers : public testing::Test {
 protected:
  void SetUp() override {
    const std::string script = "#!/bin/sh\ntouch '" + trace().native() + "'\n";
    for (const char* name : {"gltfx-codec-draco", "gltfx-codec-image"}) {
      folder_.write(name, script);
      fs::permissions(folder_.path() / name, fs::perms::owner_all);
    }
  }
  fs::path trace() const { return folder_.path() / "started"; }
  Outcome validate(const std::string& file) const {
    Setting setting;
    setting.environment.emplace_back("GLTFX_CODEC_WORKERS", folder_.path().native());
    return gltfx({"validate", fixture(file)}, setting);
  }

  TempFolder folder_;
};

TEST_F(Workers, AreNotStartedWithoutPayloads) {
  EXPECT_EQ(validate("good/stone.gltf").code, 0);
  EXPECT_FALSE(fs::exists(trace()));
}

TEST_F(Workers, AreStartedForThePayload) {
  const Outcome outcome = validate("good/bowl.glb");
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_THAT(outcome.out, HasSubstr("DRACO_NOT_CHECKED"));
  EXPECT_TRUE(fs::exists(trace()));
}

TEST(Codecs, StandBesideTheProgram) {
  EXPECT_THAT(gltfx({"validate", fixture("good/bowl.glb")}).out, Not(HasSubstr("DRACO")));
}

// Their shared libraries would make every start many times as long.
TEST(Codecs, TheProgramLinksNoDecoder) {
  if (bash("command -v readelf").code != 0) GTEST_SKIP() << "readelf is not installed";
  const std::string needed = bash("readelf -d \"$GLTFX\"").out;
  EXPECT_THAT(needed, HasSubstr("NEEDED"));
  for (const char* library : {"draco", "webp", "libpng", "libjpeg", "OpenEXR"}) {
    EXPECT_THAT(needed, Not(HasSubstr(library)));
  }
}

/// Decoders that misbehave as the payload says.
class BadDecoders : public testing::Test {
 protected:
  static constexpr const char* kProcess = "cHJvY2Vzcw==";  // "process": an error with its number
  static constexpr const char* kTriangle = "dHJpYW5nbGU=";

  // `kind`: as the test worker has it.
  Outcome validate(std::vector<std::string> words, const std::string& kind = "workers") {
    for (const char* name : {"gltfx-codec-draco", "gltfx-codec-image"}) {
      if (!fs::exists(folder_.path() / kind / name)) {
        folder_.link(fs::path(kind) / name,
                     fs::path(program()).parent_path() / "test_workers/gltfx-codec-draco");
      }
    }
    words.insert(words.begin(), {"validate", "--jobs", "1", "--fail-on", "never"});
    const std::string workers = (folder_.path() / kind).native();
    return gltfx(words, {folder_.path().native(), {}, {{"GLTFX_CODEC_WORKERS", workers}}});
  }
  void write_draco(const std::string& name, const std::string& payload) {
    const std::string length = R"("byteLength":)" + std::to_string(payload == kProcess ? 7 : 8);
    folder_.write(name,
                  R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_draco_mesh_compression"],
"extensionsRequired":["KHR_draco_mesh_compression"],"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"extensions":{
"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}],
"accessors":[{"componentType":5126,"type":"VEC3","count":3,"min":[0,0,0],"max":[1,1,1]}],
"bufferViews":[{"buffer":0,)" +
                      length + R"(}],"buffers":[{)" + length +
                      R"(,"uri":"data:application/octet-stream;base64,)" + payload + R"("}]})");
  }
  // The process that decoded for an asset.
  static std::string process_of(const std::string& json, const std::string& path) {
    const auto report = nlohmann::json::parse(json);
    for (const auto& file : report["files"]) {
      if (file["path"] != path) continue;
      for (const auto& finding : file["findings"]) {
        if (finding["code"] == "DRACO_DECODE_FAILED") return finding["message"];
      }
    }
    return {};
  }

  TempFolder folder_;
};

TEST_F(BadDecoders, OneServesAssetsOfOneRoot) {
  for (const char* name : {"a/1.gltf", "a/2.gltf", "b/3.gltf"}) write_draco(name, kProcess);
  const std::vector<std::string> words{"a", "b", "--format", "json"};
  const std::string apart = validate(words).out;
  const std::string first = process_of(apart, "a/1.gltf");
  EXPECT_NE(first, "");
  EXPECT_EQ(process_of(apart, "a/2.gltf"), first);
  EXPECT_NE(process_of(apart, "b/3.gltf"), first);
  EXPECT_NE(process_of(apart, "b/3.gltf"), "");
  const std::string together = validate({"a", "b", "--format", "json", "--root", "."}).out;
  EXPECT_NE(process_of(together, "a/1.gltf"), "");
  EXPECT_EQ(process_of(together, "b/3.gltf"), process_of(together, "a/1.gltf"));
}

TEST_F(BadDecoders, OneWithoutASandboxIsUsedOnRequestOnly) {
  write_draco("a.gltf", kTriangle);
  const Outcome refused = validate({"a.gltf"}, "unfiltered");
  EXPECT_THAT(refused.out, HasSubstr("DRACO_NOT_CHECKED"));
  EXPECT_THAT(refused.out, HasSubstr("--unsandboxed-decoders"));
  EXPECT_THAT(validate({"a.gltf", "--unsandboxed-decoders"}, "unfiltered").out,
              Not(HasSubstr("DRACO_NOT_CHECKED")));
  EXPECT_THAT(validate({"a.gltf"}).out, Not(HasSubstr("DRACO_NOT_CHECKED")));
}

// An author of assets can put such a file beside them.
TEST_F(BadDecoders, NoConfigurationTakesTheSandboxAway) {
  write_draco("a.gltf", kTriangle);
  folder_.write("gltfx.toml", "unsandboxed-decoders = true\n");
  const Outcome outcome = validate({"a.gltf"}, "unfiltered");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("unsandboxed-decoders"));
}

// An image that ends the process which decodes it is a warning, and the summary counts it.
TEST_F(BadDecoders, AnImageThatEndsTheDecoderIsAWarning) {
  using gltfx::test::PngColor;
  const std::string png = gltfx::test::encode_png({1, 1, PngColor::rgb, 8, "\1\2\3"});
  folder_.write("a.gltf", R"({"asset":{"version":"2.0"},"images":[{"uri":"a.png"}],
"textures":[{"source":0}],"materials":[{"emissiveTexture":{"index":0}}]})");
  for (const char* end : {"crash", "exit", "spin"}) {
    folder_.write("a.png", png + "|" + end);
    const std::string said = validate({"a.gltf", "--pixels", "all"}).out;
    EXPECT_THAT(said, HasSubstr("warning[IMAGE_NOT_DECODED]")) << end;
    EXPECT_THAT(said, HasSubstr("0 of 1 image decoded; 1 could not be decoded")) << end;
  }
}

// Without a decoder the content of the image is unknown: no file is made that states otherwise.
TEST(UpgradeWithoutDecoder, WritesNothingAndSaysWhy) {
  const TempFolder folder;
  folder.write("leaf.png",
               gltfx::test::encode_png({1, 1, gltfx::test::PngColor::rgb, 8, "\1\2\3"}));
  folder.write("a.gltf",
               R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_translucency"],)"
               R"("images":[{"uri":"leaf.png"}],"textures":[{"source":0}],"materials":[)"
               R"({"extensions":{"KHR_materials_translucency":{"translucencyFactor":1,)"
               R"("translucencyTexture":{"index":0}}}}]})");
  Setting setting{folder.path().native(), {}, {{"GLTFX_CODEC_WORKERS", folder.path().native()}}};
  const Outcome outcome = gltfx({"upgrade", "a.gltf", "-o", "b.gltf"}, setting);
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("could not be started"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "b.gltf"));
}

}  // namespace
}  // namespace gltfx::program

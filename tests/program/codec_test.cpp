// SPDX-License-Identifier: Apache-2.0
/// What the program has to do with its decoders.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  for (const char* library : {"OpenImageIO", "draco", "webp", "libpng", "libjpeg"}) {
    EXPECT_THAT(needed, Not(HasSubstr(library)));
  }
}

// Without a decoder nobody knows what the image holds: no file is made that says otherwise.
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

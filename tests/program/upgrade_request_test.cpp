// SPDX-License-Identifier: Apache-2.0
// `gltfx upgrade` on request: --only, --to, --ior.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

namespace fs = std::filesystem;
using container::test::TempFolder;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class UpgradeRequestTest : public testing::Test {
 protected:
  Outcome here(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "upgrade");
    return gltfx(std::move(arguments), {folder_.path().native(), {}, {}});
  }
  std::string content(const std::string& name) const {
    return read_file((folder_.path() / name).native());
  }
  void take(const std::string& name) {
    folder_.write(fs::path(name).filename().native(), read_file(fixture(name)));
  }

  TempFolder folder_;
};

TEST_F(UpgradeRequestTest, ADraftIsOfferedAndNoTask) {
  take("legacy/on-request/candle.gltf");
  const std::string before = content("candle.gltf");
  const Outcome outcome = here({"candle.gltf"});
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("left alone, on request"),
                                 HasSubstr("--only KHR_materials_sss: The successor is a draft"),
                                 HasSubstr("1 file, nothing to upgrade (3 left alone)")));
  EXPECT_EQ(here({"candle.gltf", "--check"}).code, 0);
  EXPECT_EQ(here({"candle.gltf", "--in-place", "--strict"}).code, 0);
  EXPECT_EQ(content("candle.gltf"), before);
}

TEST_F(UpgradeRequestTest, ObjectsOfOneKindShareALine) {
  take("good/kelp.gltf");
  folder_.write("again.gltf", content("kelp.gltf"));
  const Outcome outcome = here({"kelp.gltf", "again.gltf"});
  EXPECT_THAT(outcome.out,
              testing::StartsWith(
                  "kelp.gltf\n  EXT_meshopt_compression in 8 objects: left alone, on request\n"
                  "again.gltf\n  EXT_meshopt_compression in 8 objects: left alone, on request\n"
                  "2 files, nothing to upgrade (16 left alone)\n"
                  "  --only EXT_meshopt_compression: "));
  EXPECT_EQ(outcome.out.find("--only"), outcome.out.rfind("--only"));
  const Outcome asked = here({"kelp.gltf", "--only", "EXT_meshopt_compression"});
  EXPECT_THAT(asked.out,
              testing::StartsWith("kelp.gltf\n"
                                  "  /buffers/1/extensions/EXT_meshopt_compression and 7 others\n"
                                  "    to KHR_meshopt_compression, safe\n1 file, 8 legacy"));
}

TEST_F(UpgradeRequestTest, ItIsDoneWhenAskedFor) {
  take("legacy/on-request/candle.gltf");
  EXPECT_EQ(here({"candle.gltf", "--only", "KHR_materials_sss", "--check"}).code, 1);
  const Outcome outcome = here({"candle.gltf", "--only", "KHR_materials_sss", "--only",
                                "KHR_materials_subsurface", "--in-place"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("to KHR_materials_volume_scatter, with loss"), HasSubstr("darker")));
  EXPECT_EQ(content("candle.gltf"), read_file(fixture("legacy/upgraded/on-request/candle.gltf")));
}

TEST_F(UpgradeRequestTest, StrictRefusesTheLossThatGoesWithIt) {
  take("legacy/on-request/candle.gltf");
  const Outcome outcome =
      here({"candle.gltf", "--to", "KHR_materials_volume_scatter", "--in-place", "--strict"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("--strict"));
}

TEST_F(UpgradeRequestTest, ASuccessorMayBeChosen) {
  take("legacy/on-request/candle.gltf");
  EXPECT_EQ(here({"candle.gltf", "--to", "KHR_materials_scatter", "--in-place"}).code, 0);
  EXPECT_THAT(content("candle.gltf"),
              AllOf(HasSubstr("\"KHR_materials_scatter\""), Not(HasSubstr("KHR_materials_sss"))));
}

TEST_F(UpgradeRequestTest, CompressedGeometryIsReadUnderItsNewName) {
  take("good/kelp.gltf");
  take("good/kelp.bin");
  EXPECT_EQ(here({"kelp.gltf", "--only", "EXT_meshopt_compression", "--in-place"}).code, 0);
  EXPECT_THAT(content("kelp.gltf"), Not(HasSubstr("EXT_meshopt_compression")));
  EXPECT_EQ(gltfx({"validate", "kelp.gltf"}, {folder_.path().native(), {}, {}}).code, 0);
}

TEST_F(UpgradeRequestTest, TheIndexOfRefractionMayBeOneThatAllViewersKnow) {
  take("legacy/chalice.gltf");
  EXPECT_EQ(here({"chalice.gltf", "--ior", "1000", "--in-place"}).code, 0);
  EXPECT_THAT(content("chalice.gltf"), HasSubstr("\"ior\": 1000"));
}

TEST_F(UpgradeRequestTest, NamesAndNumbersThatNobodyKnowsAreRefused) {
  take("legacy/poster.gltf");
  for (const auto& [option, word] : std::vector<std::pair<std::string, std::string>>{
           {"--only", "KHR_materials_ior"}, {"--to", "KHR_xmp"}, {"--ior", "1.5"}}) {
    const Outcome outcome = here({"poster.gltf", option, word});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(option));
  }
}

}  // namespace
}  // namespace gltfx::program

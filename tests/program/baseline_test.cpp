// SPDX-License-Identifier: Apache-2.0
/// With a baseline, only new findings fail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::HasSubstr;
using testing::Not;

class BaselineTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("assets/old.gltf", kFaulty);
    folder_.write("assets/sound.gltf", kSound);
  }
  Outcome here(std::vector<std::string> options) const {
    options.insert(options.begin(), {"validate", "assets"});
    return gltfx(std::move(options), {folder_.path().native(), {}, {}});
  }
  std::string known() const { return read_file((folder_.path() / "known.json").native()); }

  TempFolder folder_;
};

TEST_F(BaselineTest, RecordingIsAnEndInItself) {
  const Outcome recorded = here({"--write-baseline", "known.json"});
  EXPECT_EQ(recorded.code, 0);
  EXPECT_THAT(recorded.out, HasSubstr("VALUE_NOT_IN_RANGE"));
  EXPECT_TRUE(nlohmann::json::accept(known()));
}

TEST_F(BaselineTest, RecordingSaysWhereAndHowMuchInsteadOfListingAll) {
  const Outcome recorded = here({"--write-baseline", "known.json"});
  EXPECT_THAT(recorded.err, HasSubstr("note: 1 finding in 1 file recorded in 'known.json'"));
  EXPECT_THAT(recorded.out, Not(HasSubstr(" --> ")));
  EXPECT_THAT(here({"--write-baseline", "known.json", "--group-by", "finding"}).out,
              HasSubstr(" --> "));
  EXPECT_EQ(here({"--write-baseline", "known.json", "--quiet"}).err, "");
}

// What an asset shows counts like any other finding.
TEST_F(BaselineTest, KnowsFindingsOfAGroup) {
  folder_.write("assets/unseen.gltf", R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"type": "VEC3", "componentType": 5126, "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})");
  const std::vector<std::string> strict{"--select", "shows", "--fail-on", "warning"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), strict.begin(), strict.end());
    return here(std::move(more));
  };
  EXPECT_EQ(with({}).code, 1);
  EXPECT_EQ(with({"--write-baseline", "known.json"}).code, 0);
  EXPECT_THAT(known(), HasSubstr("NOTHING_VISIBLE"));
  EXPECT_EQ(with({"--baseline", "known.json"}).code, 0);
}

TEST_F(BaselineTest, OneThatTheConfigurationNamesNeedNotBeThereToBeRecorded) {
  folder_.write("gltfx.toml", "baseline = \"known.json\"\n");
  const Outcome missing = here({});
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.err, HasSubstr("--write-baseline"));
  const Outcome recorded = here({"--write-baseline", "known.json"});
  EXPECT_EQ(recorded.code, 0) << recorded.err;
  EXPECT_EQ(here({}).code, 0);
  folder_.write("assets/new.gltf", kFaulty);
  EXPECT_EQ(here({}).code, 1);
}

TEST_F(BaselineTest, KnownFindingsAreNotReportedAgain) {
  here({"--write-baseline", "known.json"});
  const Outcome outcome = here({"--baseline", "known.json"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, Not(HasSubstr("VALUE_NOT_IN_RANGE")));
}

TEST_F(BaselineTest, NewFindingsFail) {
  here({"--write-baseline", "known.json"});
  folder_.write("assets/new.gltf", kFaulty);
  const Outcome outcome = here({"--baseline", "known.json"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("assets/new.gltf"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("assets/old.gltf:")));
}

TEST_F(BaselineTest, ABaselineCanBeBroughtUpToDateFromItself) {
  here({"--write-baseline", "known.json"});
  folder_.write("assets/new.gltf", kFaulty);
  EXPECT_EQ(here({"--baseline", "known.json", "--write-baseline", "known.json"}).code, 0);
  EXPECT_THAT(known(), testing::AllOf(HasSubstr("old.gltf"), HasSubstr("new.gltf")));
  EXPECT_EQ(here({"--baseline", "known.json"}).code, 0);
}

TEST_F(BaselineTest, KnownFindingsDoNotUseUpTheLimit) {
  here({"--write-baseline", "known.json"});
  folder_.write("assets/old.gltf", R"({"asset": {"version": "2.0"}, "cameras": [{"name": "eye",
 "type": "perspective", "perspective": {"yfov": -1, "znear": 0.1, "zfar": -1}}],
 "nodes": [{"camera": 0}], "scenes": [{"nodes": [0]}]})");
  const Outcome outcome = here({"--baseline", "known.json", "--max-issues", "1"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("zfar"));
}

TEST_F(BaselineTest, TheLimitDoesNotCutWhatIsRecorded) {
  here({"--write-baseline", "all.json"});
  here({"--write-baseline", "known.json", "--max-issues", "1"});
  EXPECT_EQ(known(), read_file((folder_.path() / "all.json").native()));
}

TEST_F(BaselineTest, UnreadableFilesFailAllTheSame) {
  const Outcome outcome = here({"missing.gltf", "--write-baseline", "known.json"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(known(), Not(HasSubstr("missing.gltf")));
}

TEST_F(BaselineTest, ABaselineThatIsNoneIsAUsageError) {
  folder_.write("known.json", "[]");
  const Outcome outcome = here({"--baseline", "known.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("'known.json'"));
}

}  // namespace
}  // namespace gltfx::program

// SPDX-License-Identifier: Apache-2.0
/// Which findings are reported, how loudly and how many: options between rules and report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// One error, one warning and one info.
const std::string kMixed = R"({"asset": {"version": "2.0"},
 "materials": [{"name": "spare", "alphaCutoff": -1, "shiny": true}]})";

class Filter : public testing::Test {
 protected:
  // Findings as "severity CODE".
  std::vector<std::string> findings(const std::vector<std::string>& options,
                                    const std::string& asset = kMixed) {
    folder_.write("a.gltf", asset);
    std::vector<std::string> arguments{"validate", "a.gltf", "--format", "json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    outcome_ = gltfx(arguments, {folder_.path().native(), {}, {}});
    std::vector<std::string> lines;
    const auto report = nlohmann::json::parse(outcome_.out, nullptr, false);
    if (report.is_discarded()) return {"no JSON: " + outcome_.out + outcome_.err};
    for (const auto& finding : report["files"][0]["findings"]) {
      lines.push_back(finding["severity"].get<std::string>() + " " +
                      finding["code"].get<std::string>());
    }
    return lines;
  }

  TempFolder folder_;
  Outcome outcome_;
};

TEST_F(Filter, EverythingByDefault) {
  EXPECT_THAT(findings({}),
              testing::UnorderedElementsAre("error VALUE_NOT_IN_RANGE",
                                            "warning UNEXPECTED_PROPERTY", "info UNUSED_OBJECT"));
}

TEST_F(Filter, SelectKeepsTheNamedCodesOnly) {
  EXPECT_THAT(findings({"--select", "UNUSED_OBJECT"}), ElementsAre("info UNUSED_OBJECT"));
  EXPECT_EQ(outcome_.code, 0);
  EXPECT_EQ(findings({"--select", "unused_object,VALUE_NOT_IN_RANGE"}).size(), 2U);
  EXPECT_EQ(findings({"--select", "UNUSED_OBJECT", "--select", "VALUE_NOT_IN_RANGE"}).size(), 2U);
}

// A triangle whose corners are at one place, in a scene that is not the default: a warning and an
// info of the group `shows`, and an info of none.
const std::string kUnseen = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36, "target": 34962}],
 "nodes": [{"mesh": 0}], "materials": [{}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}]})";

TEST_F(Filter, OptionsTakeTheNameOfAGroup) {
  using testing::UnorderedElementsAre;
  const std::vector<std::string> all = findings({}, kUnseen);
  EXPECT_THAT(all, UnorderedElementsAre("warning NOTHING_VISIBLE", "info DEFAULT_SCENE_MISSING",
                                        "info UNUSED_OBJECT"));
  EXPECT_THAT(findings({"--select", "shows"}, kUnseen),
              UnorderedElementsAre("warning NOTHING_VISIBLE", "info DEFAULT_SCENE_MISSING"));
  EXPECT_THAT(findings({"--ignore", "shows"}, kUnseen), ElementsAre("info UNUSED_OBJECT"));
  EXPECT_THAT(findings({"--select", "shows", "--ignore", "DEFAULT_SCENE_MISSING"}, kUnseen),
              ElementsAre("warning NOTHING_VISIBLE"));
  EXPECT_THAT(findings({"--severity", "shows=error"}, kUnseen),
              UnorderedElementsAre("error NOTHING_VISIBLE", "error DEFAULT_SCENE_MISSING",
                                   "info UNUSED_OBJECT"));
}

TEST_F(Filter, ConfigurationTakesTheNameOfAGroup) {
  folder_.write("gltfx.toml", "[severity]\nshows = \"hint\"\n");
  EXPECT_THAT(findings({}, kUnseen), Contains("info UNUSED_OBJECT"));
  EXPECT_THAT(findings({}, kUnseen), Not(Contains("warning NOTHING_VISIBLE")));
  folder_.write("gltfx.toml", "ignore = [\"shows\"]\n");
  EXPECT_THAT(findings({}, kUnseen), ElementsAre("info UNUSED_OBJECT"));
  folder_.write("gltfx.toml", "select = [\"shows\"]\n");
  EXPECT_EQ(findings({}, kUnseen).size(), 2U);
}

TEST_F(Filter, IgnoreDropsTheNamedCodes) {
  EXPECT_THAT(findings({"--ignore", "VALUE_NOT_IN_RANGE,UNUSED_OBJECT"}),
              ElementsAre("warning UNEXPECTED_PROPERTY"));
  EXPECT_EQ(outcome_.code, 0);
}

TEST_F(Filter, SeverityChangesWhatACodeCountsAs) {
  EXPECT_THAT(findings({"--severity", "VALUE_NOT_IN_RANGE=info,UNUSED_OBJECT=error"}),
              testing::IsSupersetOf({"info VALUE_NOT_IN_RANGE", "error UNUSED_OBJECT"}));
  EXPECT_EQ(outcome_.code, 1);
  findings({"--severity", "VALUE_NOT_IN_RANGE=warning"});
  EXPECT_EQ(outcome_.code, 0);
}

TEST_F(Filter, MaxIssuesCutsTheListNotTheVerdict) {
  EXPECT_EQ(findings({"--max-issues", "1"}).size(), 1U);
  EXPECT_THAT(outcome_.out, HasSubstr("\"truncated\":true"));
  EXPECT_THAT(outcome_.out, HasSubstr("\"errors\":1,\"warnings\":1,\"infos\":1"));
  EXPECT_EQ(outcome_.code, 1);
  EXPECT_EQ(findings({"--max-issues", "0"}).size(), 3U);
}

TEST_F(Filter, ProfilesReportMoreOrLess) {
  const std::string hinted = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4,
   "uri": "data:application/octet-stream;base64,AAAAAA=="}], "bufferViews": [{"buffer": 0,
   "byteLength": 4}], "extensionsUsed": ["KHR_materials_translucency"]})";
  const auto standard = findings({}, hinted);
  const auto strict = findings({"--profile", "strict"}, hinted);
  const auto khronos = findings({"--profile", "khronos"}, hinted);
  EXPECT_THAT(standard, Contains("info EXTENSION_LEGACY"));
  EXPECT_THAT(khronos, Not(Contains("info EXTENSION_LEGACY")));
  EXPECT_THAT(outcome_.out, HasSubstr("\"profile\":\"khronos\""));
  for (const std::string& line : standard) EXPECT_THAT(strict, Contains(line));
}

TEST_F(Filter, ReportsSayHowFarImagesWereLookedInto) {
  findings({});
  EXPECT_THAT(outcome_.out, HasSubstr("\"pixels\":\"headers\""));
  findings({"--profile", "strict"});
  EXPECT_THAT(outcome_.out, HasSubstr("\"pixels\":\"needed\""));
  findings({"--pixels", "all"});
  EXPECT_THAT(outcome_.out, HasSubstr("\"pixels\":\"all\""));
}

TEST_F(Filter, TheKhronosProfileSaysThatItTakesNoPixels) {
  findings({"--profile", "khronos", "--pixels", "all"});
  EXPECT_THAT(outcome_.err, HasSubstr("--pixels has no effect"));
  EXPECT_THAT(outcome_.out, HasSubstr("\"pixels\":\"headers\""));
  findings({"--profile", "khronos", "--pixels", "headers"});
  EXPECT_EQ(outcome_.err, "");
  findings({"--profile", "khronos", "--pixels", "all", "--quiet"});
  EXPECT_EQ(outcome_.err, "");
}

TEST_F(Filter, BudgetsAreErrorsWhenTheyAreSet) {
  const std::string asset = R"({"asset": {"version": "2.0"}})";
  EXPECT_THAT(findings({"--max-file-size", "10"}, asset), ElementsAre("error BUDGET_FILE_SIZE"));
  EXPECT_EQ(outcome_.code, 1);
  EXPECT_THAT(findings({"--max-file-size", "100"}, asset), testing::IsEmpty());
}

TEST_F(Filter, LfsPointersAreErrorsOnRequest) {
  folder_.write("big.bin",
                "version https://git-lfs.github.com/spec/v1\n"
                "oid sha256:4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393\n"
                "size 12345\n");
  const std::string asset = R"({"asset": {"version": "2.0"},
   "buffers": [{"uri": "big.bin", "byteLength": 12345}]})";
  EXPECT_THAT(findings({}, asset), Contains("info GIT_LFS_POINTER"));
  EXPECT_EQ(outcome_.code, 0);
  EXPECT_THAT(findings({"--lfs", "error"}, asset), Contains("error GIT_LFS_POINTER"));
  EXPECT_EQ(outcome_.code, 1);
}

}  // namespace
}  // namespace gltfx::program

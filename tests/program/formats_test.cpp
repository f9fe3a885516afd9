// SPDX-License-Identifier: Apache-2.0
/// The machine formats of a whole run, names of hostile files included, before independent readers.
#include <set>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using nlohmann::json;
using testing::HasSubstr;

class Formats : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("::error file=x::]]>&<a b.gltf", kFaulty);
    folder_.write("##vso[task.complete]\xE2\x80\xAE\x1b[2J\n\xff.gltf", kFaulty);
    folder_.write("sound.gltf", kSound);
    folder_.write("not.glb", "glTF");
    folder_.write(
        "names.gltf",
        R"({"asset": {"version": "2.0"}, "nodes": [{"name": "]]>\u0000##vso[x]\ufffe\n::error::", "mesh": 1}]})");
  }
  Outcome in(const std::string& format) const {
    return gltfx({"validate", ".", GLTFX_SOURCE_DIR "/fixtures", GLTFX_SOURCE_DIR "/tests/golden",
                  "gone.gltf", "-", "--profile", "strict", "--format", format},
                 {folder_.path().native(), "{", {}});
  }
  TempFolder folder_;
};

TEST_F(Formats, JunitIsValidByItsSchema) {
  if (bash("command -v xmllint").code != 0) GTEST_SKIP() << "xmllint is not installed";
  folder_.write("report.xml", in("junit").out);
  const Outcome outcome = bash("xmllint --nonet --noout --schema '" GLTFX_SOURCE_DIR
                               "/tests/report/junit.xsd' report.xml",
                               {folder_.path().native(), {}, {}});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(Formats, SarifRefersToWhatItLists) {
  const json run = json::parse(in("sarif").out)["runs"][0];
  EXPECT_EQ(run["invocations"][0]["exitCode"], 3);
  for (const json& result : run["results"]) {
    EXPECT_EQ(run["tool"]["driver"]["rules"][result["ruleIndex"].get<std::size_t>()]["id"],
              result["ruleId"]);
    const json& location = result["locations"][0]["physicalLocation"]["artifactLocation"];
    EXPECT_EQ(run["artifacts"][location["index"].get<std::size_t>()]["location"], location);
  }
  EXPECT_THAT(run["artifacts"].dump(),
              HasSubstr("%23%23vso%5Btask.complete%5D%E2%80%AE%1B%5B2J%0A%FF.gltf"));
  EXPECT_EQ(run["originalUriBaseIds"]["SRCROOT"]["uri"], "file://" + folder_.path().native() + "/");
}

TEST_F(Formats, SarifTellsAllFindingsOfAFileApart) {
  const json run = json::parse(in("sarif").out)["runs"][0];
  std::set<std::pair<json, json>> met;
  for (const json& result : run["results"]) {
    const json& place = result["locations"][0]["physicalLocation"];
    EXPECT_GE(place["region"]["startLine"], 1);
    for (const auto& [name, value] : result["partialFingerprints"].items()) {
      const json whole = {result["ruleId"], name, value};
      EXPECT_TRUE(met.emplace(place["artifactLocation"]["index"], whole).second) << whole;
    }
  }
  EXPECT_GE(run["results"].size(), 100U);
}

TEST_F(Formats, GitlabTellsAllFindingsApartByFingerprint) {
  const json findings = json::parse(in("gitlab").out);
  std::set<json> met;
  for (const json& finding : findings) {
    EXPECT_TRUE(met.insert(finding["fingerprint"]).second) << finding;
    EXPECT_GE(finding["location"]["lines"]["begin"], 1);
  }
  EXPECT_GE(findings.size(), 100U);
}

TEST_F(Formats, GitlabPathsStartAtTheRepository) {
  folder_.write("repository/.git/HEAD", "");
  folder_.write("repository/models/leaf.gltf", kFaulty);
  const Outcome outcome = gltfx({"validate", "./leaf.gltf", "--format", "gitlab"},
                                {(folder_.path() / "repository/models").native(), {}, {}});
  EXPECT_EQ(json::parse(outcome.out)[0]["location"]["path"], "models/leaf.gltf");
}

TEST_F(Formats, AgentHasALineForEachFinding) {
  const std::string out = in("agent").out;
  std::size_t findings = 0;
  const json report = json::parse(in("json").out);
  for (const json& file : report["files"]) findings += file["findings"].size();
  EXPECT_EQ(static_cast<std::size_t>(std::count(out.begin(), out.end(), '\n')), findings + 1);
}

}  // namespace
}  // namespace gltfx::program

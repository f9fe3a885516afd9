// SPDX-License-Identifier: Apache-2.0
/// Runs that share their inputs among them, and their reports put together.
#include <algorithm>
#include <fstream>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::HasSubstr;

const std::string kFixtures = fixture("bad");

class Merge : public testing::Test {
 protected:
  Outcome validate(const std::vector<std::string>& more) const {
    std::vector<std::string> words{
        "validate", kFixtures, fixture("legacy"), "--isolated", "--fail-on", "never", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return gltfx(words, setting_);
  }
  Outcome merge(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"merge", "--fail-on", "never", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return gltfx(words, setting_);
  }
  void run_shards(int count) const {
    for (int i = 1; i <= count; ++i) {
      const std::string index = std::to_string(i);
      const Outcome outcome = validate({"--shard", index + "/" + std::to_string(count), "--format",
                                        "jsonl=" + index + ".jsonl"});
      ASSERT_EQ(outcome.code, 0) << outcome.err;
    }
  }

  TempFolder folder_;
  Setting setting_{folder_.path().native(), {}, {}};
};

TEST_F(Merge, ShardsTogetherSayWhatOneRunSays) {
  run_shards(3);
  for (const std::string format :
       {"text", "json", "jsonl", "sarif", "junit", "github", "gitlab", "agent", "csv"}) {
    const Outcome one = validate({"--format", format});
    const Outcome parts = merge({"2.jsonl", "3.jsonl", "1.jsonl", "--format", format});
    EXPECT_EQ(parts.code, 0) << parts.err;
    EXPECT_EQ(parts.out, one.out) << format;
    EXPECT_NE(one.out, "");
  }
}

TEST_F(Merge, KeepsTheRequirementsOfTheRuns) {
  run_shards(1);
  std::ifstream file(folder_.path() / "1.jsonl");
  std::string lines;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("{\"position\"")) {
      line.pop_back();
      line += R"(,"requirements":[{"measure":"triangles","on":"mesh","value":7,"op":"max",)"
              R"("limit":5,"from":"gltfx.toml:1","pointer":"/meshes/0","verdict":"fail",)"
              R"("severity":"error"}]})";
    }
    lines += line + "\n";
  }
  folder_.write("1.jsonl", lines);
  const std::string out = merge({"1.jsonl", "--format", "csv"}).out;
  EXPECT_THAT(out, testing::HasSubstr(",mesh,/meshes/0,triangles,7,max,5,fail,gltfx.toml:1,\r\n"));
  EXPECT_THAT(merge({"1.jsonl", "--format", "jsonl"}).out, testing::HasSubstr("\"gltfx.toml:1\""));
}

TEST_F(Merge, TimesAreThoseThatTheRunsRecorded) {
  const Outcome one = validate({"--timings", "--format", "junit", "--format", "jsonl=1.jsonl"});
  EXPECT_THAT(one.out, testing::ContainsRegex("<testsuites [^>]* time=\"[0-9]+\\.[0-9]{6}\">"));
  EXPECT_EQ(merge({"1.jsonl", "--format", "junit"}).out, one.out);
  ASSERT_EQ(validate({"--shard", "1/2", "--timings", "--format", "jsonl=1.jsonl"}).code, 0);
  ASSERT_EQ(validate({"--shard", "2/2", "--format", "jsonl=2.jsonl"}).code, 0);
  EXPECT_THAT(merge({"1.jsonl", "2.jsonl"}).err, HasSubstr("--timings"));
}

TEST_F(Merge, NotesOfSarifAreForThoseWhoAsk) {
  run_shards(2);
  const Outcome few = merge({"1.jsonl", "2.jsonl", "--format", "sarif"});
  const Outcome all = merge({"1.jsonl", "2.jsonl", "--format", "sarif", "--sarif-notes"});
  EXPECT_EQ(few.out.find("\"level\":\"note\",\"message\":{\"text\":\"Nothing"), std::string::npos);
  EXPECT_GT(all.out.size(), few.out.size());
  EXPECT_EQ(all.out, validate({"--format", "sarif", "--sarif-notes"}).out);
}

TEST_F(Merge, AShardThatWasRunTwiceCountsOnce) {
  run_shards(2);
  EXPECT_EQ(merge({"1.jsonl", "2.jsonl", "1.jsonl", "--format", "json"}).out,
            validate({"--format", "json"}).out);
}

TEST_F(Merge, AMissingShardIsNamed) {
  run_shards(3);
  const Outcome outcome = merge({"1.jsonl", "3.jsonl"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("shard 2/3 is missing"));
}

TEST_F(Merge, AReportThatWasCutOffIsNamed) {
  run_shards(1);
  const std::string whole = read_file((folder_.path() / "1.jsonl").native());
  for (const std::size_t end : {whole.size() / 2, whole.rfind("{\"summary\"")}) {
    folder_.write("cut.jsonl", whole.substr(0, end));
    const Outcome outcome = merge({"cut.jsonl"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("cut.jsonl, line "));
    EXPECT_THAT(outcome.err, HasSubstr("cut off"));
  }
}

TEST_F(Merge, OtherFilesAreNoReports) {
  folder_.write("a.jsonl", "{\"asset\": {\"version\": \"2.0\"}}\n");
  EXPECT_THAT(merge({"a.jsonl"}).err, HasSubstr("a.jsonl, line 1: it is no line of a report"));
  folder_.write("a.jsonl", R"({"gltfx": "9", "format": 99})"
                           "\n");
  EXPECT_THAT(merge({"a.jsonl"}).err, HasSubstr("'format'"));
  EXPECT_EQ(merge({"nowhere.jsonl"}).code, 3);
  EXPECT_EQ(gltfx({"merge"}).code, 2);
}

TEST_F(Merge, ReportsWithOtherOptionsDoNotBelongTogether) {
  run_shards(2);
  ASSERT_EQ(validate({"--profile", "khronos", "--shard", "2/2", "--format", "jsonl=2.jsonl"}).code,
            0);
  EXPECT_THAT(merge({"1.jsonl", "2.jsonl"}).err, HasSubstr("another profile"));
}

TEST_F(Merge, TheVerdictIsThatOfAllParts) {
  folder_.write("a/1.gltf", kSound);
  folder_.write("a/2.gltf", kFaulty);
  ASSERT_EQ(gltfx({"validate", "a", "--format", "jsonl=r.jsonl"}, setting_).code, 1);
  EXPECT_EQ(gltfx({"merge", "r.jsonl"}, setting_).code, 1);
  EXPECT_EQ(gltfx({"merge", "r.jsonl", "--fail-on", "never"}, setting_).code, 0);
}

TEST_F(Merge, WhatFailsIsWhatFailedTheRuns) {
  folder_.write("a/1.gltf", kWarning);
  ASSERT_EQ(
      gltfx({"validate", "a", "--fail-on", "warning", "--format", "jsonl=r.jsonl"}, setting_).code,
      1);
  EXPECT_EQ(gltfx({"merge", "r.jsonl"}, setting_).code, 1);
  EXPECT_EQ(gltfx({"merge", "r.jsonl", "--fail-on", "error"}, setting_).code, 0);
  for (const std::string format : {"junit", "sarif"}) {
    const Outcome one =
        gltfx({"validate", "a", "--fail-on", "warning", "--format", format}, setting_);
    EXPECT_EQ(gltfx({"merge", "r.jsonl", "--format", format}, setting_).out, one.out);
  }
  folder_.write("r.jsonl", R"({"gltfx": "1", "format": 1, "failOn": "loud"})"
                           "\n");
  EXPECT_THAT(gltfx({"merge", "r.jsonl"}, setting_).err, HasSubstr("'failOn'"));
}

class Shards : public Merge {
 protected:
  std::set<std::string> files(const std::string& folder, const std::string& shard) const {
    const Outcome outcome = gltfx(
        {"validate", folder, "--shard", shard, "--format", "agent", "--select", "UNUSED_OBJECT"},
        setting_);
    std::set<std::string> names;
    for (std::size_t at = 0; at < outcome.out.size();) {
      const std::size_t end = outcome.out.find('\n', at);
      const std::string line = outcome.out.substr(at, end - at);
      const std::size_t name = line.find("asset-");
      if (name != std::string::npos) names.insert(line.substr(name, line.find(':', name) - name));
      at = end + 1;
    }
    return names;
  }
};

TEST_F(Shards, EachFileBelongsToOneWhereverItsFolderLiesAndWhateverIsBesideIt) {
  for (int i = 0; i < 40; ++i) {
    folder_.write("here/asset-" + std::to_string(i) + ".gltf", kInfo);
    folder_.write("there/deep/asset-" + std::to_string(i) + ".gltf", kInfo);
    folder_.write("there/deep/other-" + std::to_string(i) + ".gltf", kInfo);
  }
  std::size_t sum = 0;
  for (const std::string shard : {"1/3", "2/3", "3/3"}) {
    const std::set<std::string> here = files("here", shard);
    EXPECT_GE(here.size(), 5U);
    EXPECT_EQ(files("there/deep/", shard), here);
    sum += here.size();
  }
  EXPECT_EQ(sum, 40U);
}

TEST_F(Shards, WhatIsNoShardIsRefused) {
  for (const std::string word : {"0/3", "4/3", "3", "a/b", "1/", "/2", "1/2/3", "1/99999999"}) {
    const Outcome outcome = gltfx({"validate", ".", "--shard", word}, setting_);
    EXPECT_EQ(outcome.code, 2) << word;
    EXPECT_THAT(outcome.err, HasSubstr("--shard: '" + word + "' is not I/N"));
  }
}

}  // namespace
}  // namespace gltfx::program

// SPDX-License-Identifier: Apache-2.0
/// Files that gltfx reads for itself: schemas, configurations, baselines, lists, reports to merge.
/// A proposed change can add them, so they are read as carefully as assets.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "container/temp_folder.hpp"
#include "process.hpp"
#include "sanitized.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::HasSubstr;

const std::string kHead =
    R"({"$schema": "https://json-schema.org/draft/2020-12/schema", "$id": "gltfx:ext/ACME_x", "title": "x", "description": "x", "type": "object")";
const std::string kStands =
    R"(, "x-gltfx": {"extension": "ACME_x", "on": ["material"], "status": "vendor"})";

class HostileInput : public testing::Test {
 protected:
  HostileInput() {
    folder_.write("a.gltf", kSound);
    folder_.link("zero", "/dev/zero");
    ::mkfifo((folder_.path() / "pipe").c_str(), 0600);
    folder_.write("huge", "");
    std::filesystem::resize_file(folder_.path() / "huge", std::uintmax_t{10} << 30U);
    std::filesystem::create_directories(folder_.path() / "folder.schema.json");
  }
  Outcome run(const std::vector<std::string>& words) const { return gltfx(words, setting_); }

  // None of them is waited for or read to its end.
  void expect_refused(std::vector<std::string> words, int code = 2) const {
    words.emplace_back();
    for (const char* const file : {"zero", "pipe", "huge", "folder.schema.json", "missing"}) {
      words.back() = file;
      const Outcome outcome = run(words);
      EXPECT_EQ(outcome.code, code) << words.front() << " " << file << ": " << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr(file));
      EXPECT_TRUE(kSanitized || outcome.peak_kib < (256 << 10U)) << file << outcome.peak_kib;
    }
  }

  TempFolder folder_;
  const Setting setting_{folder_.path().native(), {}, {}};
};

TEST_F(HostileInput, SchemasAreRegularFilesOfSomeSize) {
  expect_refused({"validate", "a.gltf", "--isolated", "--schema"});
  expect_refused({"schema", "--schema"});
  folder_.write("s/X.schema.json", "");
  folder_.link("s/Y.schema.json", "/dev/zero");
  EXPECT_EQ(run({"validate", "a.gltf", "--isolated", "--schema-dir", "s"}).code, 2);
}

TEST_F(HostileInput, BaselinesAreRegularFilesOfSomeSize) {
  expect_refused({"validate", "a.gltf", "--isolated", "--baseline"});
}

TEST_F(HostileInput, ListsAreRegularFilesOfSomeSize) {
  expect_refused({"validate", "--isolated", "--files-from"});
}

TEST_F(HostileInput, ConfigurationsAreRegularFilesOfSomeSize) {
  expect_refused({"validate", "a.gltf", "--config"});
  expect_refused({"config", "import"});
}

TEST_F(HostileInput, ConfigurationsNameRegularFilesOfSomeSize) {
  for (const char* const file : {"zero", "pipe", "huge"}) {
    for (const std::string& line : {"schemas = [\"" + std::string(file) + "\"]\n",
                                    "baseline = \"" + std::string(file) + "\"\n"}) {
      folder_.write("gltfx.toml", line);
      EXPECT_EQ(run({"validate", "a.gltf"}).code, 2) << line;
    }
  }
}

TEST_F(HostileInput, ReportsToMergeAreRegularFiles) { expect_refused({"merge"}, 3); }

TEST_F(HostileInput, APartOfCountlessPartsIsOneMistake) {
  ASSERT_EQ(run({"validate", "a.gltf", "--isolated", "--format", "jsonl=r.jsonl"}).code, 0);
  ASSERT_EQ(bash(R"(sed -i '1s/"count":1/"count":4000000000/' r.jsonl)", setting_).code, 0);
  const Outcome merged = run({"merge", "r.jsonl"});
  EXPECT_EQ(merged.code, 3);
  EXPECT_TRUE(kSanitized || merged.peak_kib < (256 << 10U)) << merged.peak_kib;
  EXPECT_THAT(merged.err, HasSubstr("2/4000000000 is missing"));
}

TEST_F(HostileInput, StandardInputHasAnEndForLists) {
  const Outcome endless =
      bash(R"("$GLTFX" validate --isolated --files-from - </dev/zero)", setting_);
  EXPECT_EQ(endless.code, 2);
  EXPECT_THAT(endless.err, HasSubstr("more than 268435456 bytes"));
  EXPECT_TRUE(kSanitized || endless.peak_kib < (320 << 10U)) << endless.peak_kib;
}

TEST_F(HostileInput, ASchemaThatSaysNotWhereItStandsIsAMistake) {
  folder_.write("s.json", kHead + "}");
  const Outcome outcome = run({"validate", "a.gltf", "--isolated", "--schema", "s.json"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("s.json:1:1: 'x-gltfx' is missing"));
}

// A branch that everything fits is shown like any other.
TEST_F(HostileInput, SchemasOfAnyFormAreShown) {
  folder_.write("s.json", kHead + kStands +
                              R"(, "$defs": {"s": {"items": {"$ref": "#/$defs/s"}}}, "properties": {
 "a": {"anyOf": [true, false]}, "b": {"allOf": [true]}, "c": {"oneOf": [true, {"type": "string"}]}, "d": true, "e": false,
 "f": {"items": true}, "g": {"$ref": "#/$defs/s"}, "h": {"not": true}}})");
  for (const char* const format : {"text", "json"}) {
    const Outcome outcome = run({"schema", "ACME_x", "--schema", "s.json", "--format", format});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("material.ACME_x"));
  }
}

// Names and keys of megabytes are cut; only the form of the Khronos validator has pointers whole.
TEST_F(HostileInput, ReportsDoNotRepeatTextsOfMegabytes) {
  const std::string text(kSanitized ? 200'000 : 2'000'000, 'x');
  folder_.write("long.gltf", R"({"asset": {"version": "2.0"}, "materials": [{"name": ")" + text +
                                 R"(", "emissiveFactor": [2, 2, 2], ")" + text +
                                 R"(": 1}], "extensionsUsed": [")" + text + R"("]})");
  for (const char* const format :
       {"text", "json", "jsonl", "sarif", "junit", "github", "gitlab", "agent", "csv"}) {
    const Outcome outcome = run({"validate", "long.gltf", "--isolated", "--format", format});
    EXPECT_EQ(outcome.code, 1) << format;
    EXPECT_LT(outcome.out.size(), std::size_t{1} << 16U) << format;
  }
}

}  // namespace
}  // namespace gltfx::program

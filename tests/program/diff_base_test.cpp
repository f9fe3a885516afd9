// SPDX-License-Identifier: Apache-2.0
/// --diff-base: only findings on lines that changed since a revision.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::HasSubstr;
using testing::Not;

// Three materials on lines 3 to 5.
std::string materials(const std::string& a, const std::string& b, const std::string& c) {
  return "{\"asset\": {\"version\": \"2.0\"},\n\"materials\": [\n{\"alphaCutoff\": " + a +
         "},\n{\"alphaCutoff\": " + b + "},\n{\"alphaCutoff\": " + c + "}\n]}\n";
}

class DiffBase : public testing::Test {
 protected:
  void SetUp() override {
    if (bash("command -v git").code != 0) GTEST_SKIP() << "git is not installed";
    folder_.write("a.gltf", materials("-1", "1", "-1"));
    folder_.write("sub/b c.gltf", materials("-1", "-1", "-1"));
    ASSERT_EQ(shell("git init -q . && git add -A && git -c user.name=a -c user.email=a@example.com "
                    "commit -q -m start")
                  .code,
              0);
  }
  Outcome shell(const std::string& line) const {
    return bash(line, {folder_.path().native(), {}, {{"HOME", folder_.path().native()}}});
  }
  Outcome since(const std::string& revision, const std::string& path = ".",
                const std::string& where = "") const {
    return gltfx({"validate", path, "-f", "agent", "-q", "--select", "VALUE_NOT_IN_RANGE,IO_ERROR",
                  "--diff-base", revision},
                 {(folder_.path() / where).native(), {}, {}});
  }

  TempFolder folder_;
};

TEST_F(DiffBase, NothingChangedNothingSaid) {
  const Outcome outcome = since("HEAD");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

TEST_F(DiffBase, OnlyChangedLinesAreSpokenOf) {
  folder_.write("a.gltf", materials("-1", "-2", "-1"));
  const Outcome outcome = since("HEAD");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out, HasSubstr("a.gltf:4:17 at /materials/1/alphaCutoff"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("repeated")));
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1);
}

TEST_F(DiffBase, WhatIsHiddenIsCounted) {
  folder_.write("a.gltf", materials("-1", "-2", "-1"));
  const auto check = [&](const std::string& format) {
    return gltfx({"validate", ".", "-f", format, "--select", "VALUE_NOT_IN_RANGE", "--diff-base",
                  "HEAD"},
                 {folder_.path().native(), {}, {}})
        .out;
  };
  const std::string note = "5 findings not shown, on lines that did not change (--diff-base)";
  for (const char* format : {"text", "agent", "github", "sarif"}) {
    EXPECT_THAT(check(format), HasSubstr(note)) << format;
  }
  EXPECT_THAT(check("json"), HasSubstr("\"unchanged\":5"));
  ASSERT_EQ(
      shell("git add -A && git -c user.name=a -c user.email=a@example.com commit -q -m more").code,
      0);
  EXPECT_THAT(check("text"), HasSubstr("2 files checked: no new problems\n6 findings not shown"));
}

// It chooses lines, not inputs: a glob with a slip is a mistake here too.
TEST_F(DiffBase, InputsWithoutAssetsAreAMistake) {
  folder_.write("void/notes.txt", "");
  for (const char* const name : {"void", "asets/*.glb"}) {
    EXPECT_EQ(since("HEAD", name).code, 2) << name;
  }
}

TEST_F(DiffBase, FilesOfAnyNameAndFolderAreFound) {
  folder_.write("sub/b c.gltf", materials("-1", "-1", "-3"));
  EXPECT_THAT(since("HEAD", "b c.gltf", "sub").out, HasSubstr("b c.gltf:5:17"));
  EXPECT_THAT(since("HEAD", (folder_.path() / "sub").native()).out, HasSubstr("b c.gltf:5:17"));
}

TEST_F(DiffBase, NewFilesCountAsAWhole) {
  folder_.write("new.gltf", materials("-1", "1", "-1"));
  EXPECT_THAT(since("HEAD").out, HasSubstr("./new.gltf:3:17 at /materials/0/alphaCutoff: "));
  EXPECT_THAT(since("HEAD").out, HasSubstr("repeated once more"));
}

TEST_F(DiffBase, AFileOutsideTheRepositoryCountsAsAWhole) {
  const TempFolder elsewhere;
  const std::string path = elsewhere.write("x.gltf", materials("-1", "1", "1")).native();
  EXPECT_EQ(since("HEAD", path).code, 1);
}

// A repository beside an asset is not used: its settings could name programs to run.
TEST_F(DiffBase, ARepositoryBelowIsNotAsked) {
  folder_.write("below/x.gltf", materials("-1", "1", "1"));
  ASSERT_EQ(shell("cd below && git init -q . && git add -A && git -c user.name=a -c "
                  "user.email=a@example.com commit -q -m start && git config core.fsmonitor "
                  "'touch ../asked; false'")
                .code,
            0);
  EXPECT_EQ(since("HEAD", "below").code, 1);
  EXPECT_EQ(since("HEAD").code, 1);
  EXPECT_NE(shell("test -e asked -o -e below/asked").code, 0);
}

TEST_F(DiffBase, OtherDataMakesEverythingCount) {
  folder_.write(
      "c.gltf",
      R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "c%20.bin"}]})");
  folder_.write("c .bin", "abcd");
  ASSERT_EQ(
      shell("git add -A && git -c user.name=a -c user.email=a@example.com commit -q -m more").code,
      0);
  const auto check = [&] {
    return gltfx({"validate", "c.gltf", "-f", "agent", "-q", "--diff-base", "HEAD"},
                 {folder_.path().native(), {}, {}})
        .out;
  };
  EXPECT_EQ(check(), "");
  folder_.write("c .bin", "ab");
  EXPECT_THAT(check(), HasSubstr("BUFFER_BYTE_LENGTH_MISMATCH"));
}

TEST_F(DiffBase, ABinaryFileThatChangedCountsAsAWhole) {
  folder_.write("a.glb", "glTF");
  ASSERT_EQ(
      shell("git add -A && git -c user.name=a -c user.email=a@example.com commit -q -m more").code,
      0);
  const auto check = [&] {
    return gltfx({"validate", "a.glb", "--diff-base", "HEAD"}, {folder_.path().native(), {}, {}})
        .code;
  };
  EXPECT_EQ(check(), 0);
  folder_.write("a.glb", "glTf");
  EXPECT_EQ(check(), 1);
}

// What git compares then are pointers, whose lines are not those of the file.
TEST_F(DiffBase, AFileKeptByLfsCountsAsAWhole) {
  ASSERT_EQ(shell("git config filter.lfs.clean \"sha256sum | sed 's/^/oid sha256:/'\" && "
                  "git config filter.lfs.smudge cat && echo '*.gltf filter=lfs' >.gitattributes && "
                  "git add --renormalize . && git -c user.name=a -c user.email=a@example.com "
                  "commit -q -m lfs")
                .code,
            0);
  EXPECT_EQ(since("HEAD").out, "");
  folder_.write("a.gltf", materials("-1", "-2", "-1"));
  EXPECT_THAT(since("HEAD").out, HasSubstr("repeated 2 more times"));
}

TEST_F(DiffBase, ARevisionIsNoOptionAndMustExist) {
  for (const char* revision : {"nope", "--output=stolen", "HEAD:a.gltf", "-h"}) {
    const Outcome outcome = gltfx({"validate", "a.gltf", std::string("--diff-base=") + revision},
                                  {folder_.path().native(), {}, {}});
    EXPECT_EQ(outcome.code, 2) << revision;
    EXPECT_THAT(outcome.err, HasSubstr("git knows no commit '"));
  }
  EXPECT_NE(shell("test -e stolen").code, 0);
}

TEST(DiffBaseElsewhere, NeedsARepository) {
  if (bash("command -v git").code != 0) GTEST_SKIP() << "git is not installed";
  const TempFolder folder;
  folder.write("a.gltf", kSound);
  const Outcome outcome =
      gltfx({"validate", "a.gltf", "--diff-base", "HEAD"}, {folder.path().native(), {}, {}});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("--diff-base: "));
}

}  // namespace
}  // namespace gltfx::program

// SPDX-License-Identifier: Apache-2.0
/// --diff: characters that could control a terminal or mislead a reader are escaped, except in
/// files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kHidden = "\u202E";   // reverses what follows
constexpr const char* kControl = "\u009B";  // begins a sequence of a terminal

class DiffOutput : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("a.gltf",
                  std::string("{\"asset\": {\"version\": \"2.0\"},\n\t\"nodes\": [{\"name\": \"") +
                      kHidden + "a" + kControl +
                      "\", \"matrix\": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}]}\n");
  }
  Outcome shell(const std::string& line) const {
    return bash(line, {folder_.path().native(), {}, {}});
  }
  container::test::TempFolder folder_;
};

TEST_F(DiffOutput, IsEscapedInAPipeAndSaysSo) {
  for (const char* const verb : {"fix", "edit --delete /nodes/0/matrix"}) {
    const std::string command = "\"$GLTFX\" " + std::string(verb) + " --isolated --diff a.gltf";
    const Outcome piped = shell(command + " | cat");
    EXPECT_THAT(piped.out, Not(HasSubstr(kHidden))) << verb;
    EXPECT_THAT(piped.out, Not(HasSubstr(kControl))) << verb;
    EXPECT_THAT(piped.out, HasSubstr("-\t\"nodes\": [{\"name\": \"\\u202ea\\u009b\", "));
    EXPECT_THAT(piped.err, HasSubstr("--raw"));
    const Outcome raw = shell(command + " --raw | cat");
    EXPECT_THAT(raw.out, HasSubstr(std::string(kHidden) + "a" + kControl));
    EXPECT_THAT(raw.err, Not(HasSubstr("--raw")));
    EXPECT_EQ(shell(command + " > out; cat out").out, raw.out);
  }
}

TEST_F(DiffOutput, OfASoundNameCanBeApplied) {
  folder_.write("b.gltf",
                "{\"asset\": {\"version\": \"2.0\"},\r\n\t\"nodes\": [],\r\n\t\"scenes\": "
                "[{\"name\": \"\u00e9\"}]}\r\n");
  const Outcome outcome = shell(
      "\"$GLTFX\" fix --isolated -q --diff b.gltf | cat > piped; "
      "\"$GLTFX\" fix --isolated -q --diff b.gltf > raw; cmp piped raw && cat raw");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("-\t\"nodes\": [],\r\n"));
}

TEST_F(DiffOutput, IsEscapedInJson) {
  for (const char* const verb : {"fix", "edit --delete /nodes/0/matrix"}) {
    const Outcome outcome =
        shell("\"$GLTFX\" " + std::string(verb) + " --isolated --diff --format json a.gltf");
    EXPECT_THAT(outcome.out, Not(HasSubstr(kHidden))) << verb;
    EXPECT_THAT(outcome.out, Not(HasSubstr(kControl))) << verb;
    EXPECT_THAT(outcome.out, HasSubstr("\\u202ea\\u009b"));
  }
}

TEST_F(DiffOutput, RawGoesWithADiff) {
  EXPECT_EQ(shell("\"$GLTFX\" fix --isolated --raw a.gltf").code, 2);
}

}  // namespace
}  // namespace gltfx::program

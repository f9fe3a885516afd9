// SPDX-License-Identifier: Apache-2.0
/// Which findings are listed, and how.
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "container/temp_folder.hpp"
#include "process.hpp"

namespace gltfx::program {
namespace {

using container::test::TempFolder;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

class Listing : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("assets/a.gltf", kInfo);
    folder_.write("assets/b.gltf", kFaulty);
    folder_.write("assets/c.gltf", kFaulty);
  }
  Outcome validate(std::vector<std::string> words) const {
    words.insert(words.begin(), {"validate", "assets", "--isolated"});
    return gltfx(words, {folder_.path().native(), {}, {}});
  }

  TempFolder folder_;
};

TEST_F(Listing, FindingsBelowTheSeverityAreCountedNotListed) {
  const Outcome all = validate({});
  const Outcome outcome = validate({"--min-severity", "error"});
  EXPECT_THAT(all.out, HasSubstr("info[UNUSED_OBJECT]"));
  EXPECT_THAT(
      outcome.out,
      AllOf(HasSubstr("error["), Not(HasSubstr("info[")), HasSubstr("3 files checked: 2 errors"),
            HasSubstr("not listed: 1 info (--min-severity info lists them)\n")));
  EXPECT_EQ(outcome.code, all.code);
}

TEST_F(Listing, TheSeverityIsThatOfEveryFormat) {
  for (const std::string format :
       {"json", "jsonl", "khronos", "github", "gitlab", "sarif", "agent"}) {
    const std::vector<std::string> words{"--format", format, "--sarif-notes"};
    EXPECT_THAT(validate(words).out, HasSubstr("UNUSED_OBJECT")) << format;
    std::vector<std::string> some = words;
    some.insert(some.end(), {"--min-severity", "warning"});
    const std::string out = validate(some).out;
    // Rules that SARIF describes are those of findings that it lists.
    EXPECT_THAT(out, Not(HasSubstr("UNUSED_OBJECT"))) << format;
  }
}

TEST_F(Listing, TheVerdictCountsWhatIsNotListed) {
  EXPECT_EQ(gltfx({"validate", "-", "--isolated", "--fail-on", "info", "--min-severity", "error"},
                  {{}, kInfo, {}})
                .code,
            1);
}

TEST_F(Listing, StatisticsAreNumbersByRuleAndFile) {
  const Outcome outcome = validate({"--statistics"});
  EXPECT_THAT(outcome.out, ContainsRegex(" +2 +2  error\\["));
  EXPECT_THAT(outcome.out, ContainsRegex(" +1 +1  info\\[UNUSED_OBJECT\\]: "));
  EXPECT_THAT(outcome.out, ContainsRegex(" +1  assets/b.gltf\n"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("-->")));
  EXPECT_THAT(outcome.out, HasSubstr("3 files checked: 2 errors, 1 info\n"));
}

TEST_F(Listing, PlacesOfARuleStandTogether) {
  const Outcome outcome = validate({"--group-by", "rule"});
  EXPECT_THAT(outcome.out, ContainsRegex("error\\[.*\\(2 findings in 2 files\\)\n --> assets/b.*\n "
                                         "--> assets/c.*\n\ninfo\\[UNUSED_OBJECT\\]"));
  EXPECT_EQ(validate({"--group-by", "rule", "--statistics"}).code, 2);
}

TEST_F(Listing, AGroupListsItsFirstPlaces) {
  for (int i = 0; i < 12; ++i) {
    folder_.write("assets/d" + std::to_string(i) + ".gltf", kFaulty);
  }
  const Outcome outcome = validate({"--group-by", "rule"});
  EXPECT_THAT(outcome.out, HasSubstr("(14 findings in 14 files)"));
  EXPECT_THAT(outcome.out, HasSubstr("     and 4 more\n"));
}

TEST_F(Listing, MergedReportsAreListedAlike) {
  ASSERT_EQ(validate({"--format", "jsonl=all.jsonl"}).code, 1);
  const Setting here{folder_.path().native(), {}, {}};
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"--statistics"}, {"--group-by", "rule"}, {"--min-severity", "error"}}) {
    std::vector<std::string> merge{"merge", "all.jsonl"};
    merge.insert(merge.end(), words.begin(), words.end());
    EXPECT_EQ(gltfx(merge, here).out, validate(words).out);
  }
}

// `script` gives the program a terminal.
TEST_F(Listing, ATerminalGetsErrorsAndWarnings) {
  const Setting here{folder_.path().native(), {}, {}};
  const Outcome outcome = bash(
      "command -v script >/dev/null || exit 77; "
      "script -qec \"$GLTFX validate assets --isolated --color never\" /dev/null </dev/null",
      here);
  if (outcome.code == 77) GTEST_SKIP() << "script is not installed";
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("error["), Not(HasSubstr("info[")), HasSubstr("not listed: 1 info")));
}

}  // namespace
}  // namespace gltfx::program

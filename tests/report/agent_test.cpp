// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <gmock/gmock.h>

#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

using ::testing::EndsWith;

std::string agent(const std::vector<FileReport>& reports, bool quiet = false) {
  static constexpr std::array<RuleDescription, 1> kRules{{{.code = "VALUE_NOT_IN_RANGE",
                                                           .severity = Severity::error,
                                                           .summary = "S",
                                                           .why = "W.",
                                                           .help = "Use another number.",
                                                           .section = "",
                                                           .link = "",
                                                           .bad = "",
                                                           .good = "",
                                                           .fix_does = "",
                                                           .fixed = "",
                                                           .group = ""}}};
  FormatOptions options;
  options.profile = "default";
  options.pixel_level = "headers";
  options.rules = kRules;
  options.quiet = quiet;
  return run(ReportFormat::agent, reports, options);
}

TEST(Agent, SaysEverythingOfAFindingInOneLine) {
  EXPECT_EQ(agent({file("models/leaf.gltf", {wrong_type()})}, true),
            "error[TYPE_MISMATCH] models/leaf.gltf:7:27 at "
            "/materials/0/pbrMetallicRoughness/metallicFactor ('Leaf'): 'metallicFactor' is a "
            "string; a number is expected. | help: write the number without quotes: 0.5 | note: "
            "repeated 41 more times, last at /materials/44/pbrMetallicRoughness/metallicFactor\n");
}

TEST(Agent, TakesTheRemedyOfTheRuleWhereTheFindingHasNoHelp) {
  EXPECT_THAT(agent({file("a", {out_of_range()})}, true),
              EndsWith("1.75; 0 to 1 is allowed. | help: Use another number.\n"));
}

TEST(Agent, NamesBytesOfABinaryFile) {
  EXPECT_EQ(agent({file("a.glb", {bad_chunk()}, "model/gltf-binary")}, true),
            "error[GLB_CHUNK_TOO_BIG] a.glb: byte 12: The chunk ends after the file.\n");
}

TEST(Agent, EndsWithASummary) {
  EXPECT_EQ(agent({file("a.gltf")}),
            "summary: 1 file, no problems; profile default, pixels headers\n");
  EXPECT_THAT(agent(sample_run()),
              EndsWith("\nnote: big.gltf: 3 more findings are not listed (--max-issues)\n"
                       "summary: 5 files, 44 errors, 1 warning, 4 infos; 1 file could not be read; "
                       "1 file not verified (Git-LFS pointers); 5 findings known to the baseline; "
                       "profile default, pixels headers\n"));
}

TEST(Agent, HasALineAFindingWhateverTheAssetSays) {
  const std::string text = agent(
      {file("a\nerror[X] b", {finding("X", Severity::error, "a\r\n::error::\u2028b")})}, true);
  EXPECT_EQ(text, "error[X] a\\u000aerror[X] b: a\\u000d\\u000a::error::\\u2028b\n");
}

}  // namespace
}  // namespace gltfx::report::testing

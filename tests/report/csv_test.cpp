// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "report/support.hpp"

namespace gltfx::report::testing {
namespace {

constexpr std::string_view kHead =
    "path,scope,element,measure,value,op,limit,verdict,from,parameters\r\n";

std::string csv(const std::string& path, const std::vector<Requirement>& requirements) {
  FileReport report = file(path);
  report.requirements = requirements;
  return run(ReportFormat::csv, {report});
}

// The row of a text value, and of a name.
std::string row_with(const std::string& text) {
  Requirement requirement;
  requirement.on = "mesh";
  requirement.measure = "name";
  requirement.op = "match";
  requirement.limit = std::string("^SM_");
  requirement.from = "gltfx.toml:2";
  requirement.value = text;
  requirement.verdict = Verdict::not_measured;
  const std::string out = csv(text, {requirement});
  return out.substr(kHead.size());
}

TEST(Csv, HasARowForEachLimit) {
  EXPECT_EQ(
      csv("models/leaf.gltf", requirements()),
      std::string(kHead) +
          "models/leaf.gltf,mesh,/meshes/0 (Body),triangles,1250,max,1000,fail,gltfx.toml:8,\r\n"
          "models/leaf.gltf,asset,,size-y,0.25,min,0.01,pass,"
          "\"preset shop/mobile (1.0.0, 2020-10-20)\",\r\n"
          "models/leaf.gltf,asset,,root-transform,false,equal,true,fail,"
          "\"preset shop/mobile (1.0.0, 2020-10-20)\",\r\n"
          "models/leaf.gltf,mesh,/meshes/0,name,Body,match,^SM_,fail,gltfx.toml:20,\r\n"
          "models/leaf.gltf,asset,,extensions,KHR_a | KHR_b,allow,KHR_*,pass,gltfx.toml:7,\r\n"
          "models/leaf.gltf,image,/images/0,value-max,,max,243,not-measured,"
          "\"preset shop/mobile (1.0.0, 2020-10-20)\",\r\n"
          "models/leaf.gltf,mesh,,hard-edges,,max,90,not-applicable,gltfx.toml:9,"
          "angle 30 deg\r\n");
}

TEST(Csv, WithoutLimitsHasOnlyTheHead) {
  EXPECT_EQ(csv("a.gltf", {}), kHead);
  EXPECT_EQ(run(ReportFormat::csv, {}), kHead);
}

TEST(Csv, QuotesWhatSeparates) {
  EXPECT_EQ(row_with("a, \"b\""),
            "\"a, \"\"b\"\"\",mesh,,name,\"a, \"\"b\"\"\",match,^SM_,not-measured,"
            "gltfx.toml:2,\r\n");
  EXPECT_EQ(row_with("a\r\nb;c"),
            "a\\u000d\\u000ab;c,mesh,,name,a\\u000d\\u000ab;c,match,^SM_,not-measured,"
            "gltfx.toml:2,\r\n");
}

TEST(Csv, TextIsNoFormula) {
  for (const std::string formula : {"=HYPERLINK(0)", "+1", "-1", "@SUM(A1)", " =1", "\uFF1D1",
                                    "\uFF0B1", "\uFF0D1", "\uFF201"}) {
    EXPECT_EQ(row_with(formula), "'" + formula + ",mesh,,name,'" + formula +
                                     ",match,^SM_,not-measured,gltfx.toml:2,\r\n");
  }
  EXPECT_THAT(row_with("a=1"), ::testing::StartsWith("a=1,"));
}

// Where the comma is the sign of decimals, spreadsheets separate cells by semicolons.
TEST(Csv, TextBehindASemicolonIsNoFormula) {
  EXPECT_THAT(row_with("a;=1; +2;b"), ::testing::StartsWith("a;'=1;' +2;b,"));
  EXPECT_THAT(row_with("a;\"=1\""), ::testing::StartsWith("\"a;'\"\"=1\"\"\","));
}

TEST(Csv, ANegativeNumberStaysANumber) {
  std::vector<Requirement> one{requirements().front()};
  one[0].value = -0.5;
  one[0].limit = -1.0;
  EXPECT_THAT(csv("a", one), ::testing::HasSubstr(",-0.5,max,-1,"));
}

}  // namespace
}  // namespace gltfx::report::testing

// SPDX-License-Identifier: Apache-2.0
/// Where own rules report, and how much work they do.
#include <gltfx/measure.hpp>
#include <gltfx/pipeline.hpp>

#include <cstdint>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/work_count.hpp"
#include "rules/own_rule.hpp"
#include "rules/selected.hpp"

namespace gltfx::test {
namespace {

using testing::SizeIs;

TEST(OwnRuleWork, MarkTheValueThatDoesNotFit) {
  const auto line = [](const std::string& schema) {
    const FileReport report =
        validate_bytes(asset_with("\n\"nodes\": [\n{\"extras\": {\n\"a\": 1},\n\"name\": \"b\"}]"),
                       "a.gltf", with_rule("node", schema));
    return report.diagnostics.empty() ? 0U : report.diagnostics[0].location.line;
  };
  EXPECT_EQ(line(R"({"properties": {"name": {"pattern": "^N_"}}})"), 5U);
  EXPECT_EQ(line(R"({"properties": {"extras": {"properties": {"a": false}}}})"), 4U);
  EXPECT_EQ(line(R"({"properties": {"extras": {"required": ["b"]}}})"), 3U);
  EXPECT_EQ(line(R"({"required": ["mesh"]})"), 3U);
  EXPECT_EQ(line(R"({"properties": {"gltfx": false}})"), 3U) << "not in the text";
}

TEST(OwnRuleWork, CountWhenALineOfTheObjectChanged) {
  const std::string asset = asset_with("\n\"nodes\": [{\n\"extras\": 1,\n\"name\": \"a\"},\n{}]");
  const auto count = [&](const std::string& on, const std::string& schema, std::uint64_t line) {
    ValidateOptions options = with_rule(on, schema);
    options.changed_lines = {{line, line}};
    return verdict(asset, options).size();
  };
  const std::string name = R"({"properties": {"name": {"pattern": "^N_"}}})";
  EXPECT_EQ(count("node", name, 4), 1U);
  EXPECT_EQ(count("node", name, 3), 1U) << "the other members may decide";
  EXPECT_EQ(count("node", name, 5), 0U);
  EXPECT_EQ(count("glTF", R"({"required": ["meshes"]})", 5), 1U);
  // What 'gltfx' says comes from anywhere.
  const std::string first =
      R"({"properties": {"gltfx": {"properties": {"index": {"minimum": 1}}}}})";
  EXPECT_EQ(count("node", first, 5), 1U);
}

// A rule that cannot be decided must not pass.
TEST(OwnRuleWork, ThatTakeTooManyStepsAreFindings) {
  std::string schema = R"({"$ref": "#/$defs/s0", "$defs": {)";
  for (int i = 0; i < 60; ++i) {
    const std::string next = "{\"$ref\": \"#/$defs/s" + std::to_string(i + 1) + "\"}";
    schema += "\"s" + std::to_string(i) + "\": {\"allOf\": [" + next + "," + next + "]},";
  }
  const ValidateOptions options = with_rule("asset", schema + R"("s60": {}}})");
  const FileReport report = validate_bytes(asset_with(R"("extras": 1)"), "a.gltf", options);
  ASSERT_THAT(report.diagnostics, SizeIs(1));
  EXPECT_EQ(report.diagnostics[0].message,
            "The rule takes too many steps: this object is not checked.");
}

// The names of parent and root, in each of many nodes.
TEST(OwnRuleWork, SayHowManyObjectsTheyDoNotCheck) {
  constexpr int kNodes = 2000;
  std::string children, nodes;
  for (int i = 1; i <= kNodes; ++i) {
    children += (i == 1 ? "" : ",") + std::to_string(i);
    nodes += ",{}";
  }
  const std::string asset = asset_with("\"nodes\": [{\"name\": \"" + std::string(200'000, 'a') +
                                       "\", \"children\": [" + children + "]}" + nodes + "]");
  const FileReport report =
      validate_bytes(asset, "a.gltf", with_rule("node", R"({"required": ["gltfx"]})"));
  ASSERT_THAT(report.diagnostics, SizeIs(1));
  EXPECT_THAT(
      report.diagnostics[0].message,
      testing::MatchesRegex("The rule takes too many steps: this object and [0-9]+ more are "
                            "not checked."));
  EXPECT_EQ(report.counts.errors, 1U);
}

TEST(OwnRuleWork, ThatAreDisabledTakeNoMeasures) {
  ValidateOptions options = with_rule(
      "material", R"({"properties": {"gltfx": {"properties": {"albedo-max": {"maximum": 9}}}}})");
  const std::string asset = example_bytes(find_measure("albedo-max")->example);
  const auto decoded = [&] {
    const std::uint64_t before = work_count.decoded;
    validate_bytes(asset, "a.gltf", options);
    return work_count.decoded - before;
  };
  EXPECT_EQ(decoded(), 1U);
  options.select = {"NODE_EMPTY"};
  EXPECT_EQ(decoded(), 0U);
}

}  // namespace
}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
// The conversion of findings into a report: severities, filters, folding, order, places and names.
#include "rules/collector.hpp"

#include <gltfx/pipeline.hpp>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/codes.hpp"
#include "rules/verdict.hpp"

namespace gltfx {
namespace {

using Lines = std::vector<std::string>;

// A scene of `count` nodes, each with a misspelt member.
std::string misspelt_nodes(int count) {
  std::string nodes;
  std::string indices;
  for (int i = 0; i < count; ++i) {
    nodes += std::string(i == 0 ? "" : ", ") + R"({"transation": [0, 0, 0], "extras": {}})";
    indices += (i == 0 ? "" : ", ") + std::to_string(i);
  }
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [)" + indices +
         "]}], \"nodes\": [" + nodes + "]}";
}

TEST(Collector, FoldsRepeatsIntoTheFirst) {
  const FileReport report = validate_bytes(misspelt_nodes(1000), "test");
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].pointer, "/nodes/0/transation");
  EXPECT_EQ(report.diagnostics[0].count, 1000U);
  EXPECT_EQ(report.diagnostics[0].last_pointer, "/nodes/999/transation");
  EXPECT_EQ(report.counts.warnings, 1000U);
}

// A value that an unknown extension may add is a warning, a misspelt value of the list is an error.
TEST(Collector, NeverFoldsFindingsOfOneSeverityIntoThoseOfAnother) {
  for (const char* const modes : {R"({"alphaMode": "FOG"}, {"alphaMode": "MASKED"})",
                                  R"({"alphaMode": "MASKED"}, {"alphaMode": "FOG"})"}) {
    ValidateOptions options;
    options.select = {"VALUE_NOT_IN_LIST"};
    const FileReport report = validate_bytes(
        R"({"asset": {"version": "2.0"}, "extensionsUsed": ["ACME_fog"], "materials": [)" +
            std::string(modes) + "]}",
        "test", options);
    EXPECT_EQ(report.diagnostics.size(), 2U) << modes;
    EXPECT_EQ(report.counts.errors, 1U) << modes;
    EXPECT_EQ(report.counts.warnings, 1U) << modes;
  }
}

TEST(Collector, KeepsTheFirstRepeatsWithPlaceAndName) {
  const std::string text =
      "{\"asset\": {\"version\": \"2.0\"}, \"materials\": [\n"
      "{\"name\": \"Oak\", \"alphaCutoff\": -1},\n"
      "{\"name\": \"Elm\", \"alphaCutoff\": -2}]}";
  ValidateOptions options;
  options.select = {"VALUE_NOT_IN_RANGE"};
  const FileReport report = validate_bytes(text, "test", options);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  ASSERT_EQ(report.repeats.size(), 1U);
  const Repeat& repeat = report.repeats[0];
  EXPECT_EQ(repeat.finding, 0U);
  EXPECT_EQ(repeat.pointer, "/materials/1/alphaCutoff");
  EXPECT_EQ(repeat.object_name, "Elm");
  EXPECT_EQ(repeat.location.line, 3U);
  EXPECT_EQ(text.substr(repeat.location.offset, repeat.location.length), "-2");
  EXPECT_NE(repeat.message, report.diagnostics[0].message) << "each says its own value";
}

TEST(Collector, KeepsTheLimitThatEachFindingIsAbout) {
  const ValidateOptions options;
  validate::Collector collector(options);
  const Path root;
  const Path meshes(root, "meshes");
  for (const std::size_t index : {0U, 1U}) {
    Finding finding(Code::BUDGET_TRIANGLES, "Too many.");
    CheckedLimit limit{"triangles", "mesh", 100.0 + double(index), "max", 50.0, "", "gltfx.toml:1"};
    finding.requirement = std::make_shared<const CheckedLimit>(std::move(limit));
    collector.sink(validate::Phase::resources).report(Path(meshes, index), std::move(finding));
  }
  FileReport report;
  collector.finish(report, {}, 0);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  ASSERT_EQ(report.repeats.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].requirement->value, CheckedValue(100.0));
  EXPECT_EQ(report.repeats[0].requirement->value, CheckedValue(101.0));
}

TEST(Collector, KeepsSomeThousandRepeatsAtMost) {
  const FileReport report = validate_bytes(misspelt_nodes(6000), "test");
  EXPECT_EQ(report.diagnostics[0].count, 6000U);
  EXPECT_EQ(report.repeats.size(), 5000U);
  ValidateOptions options;
  options.max_issues = 10;
  EXPECT_TRUE(validate_bytes(misspelt_nodes(100), "test", options).repeats.empty());
}

TEST(Collector, CountsWhatLiesOnOtherLines) {
  ValidateOptions options;
  options.changed_lines = {{1, 1}};
  const FileReport report = validate_bytes(
      "{\"asset\": {\"version\": \"2.0\", \"a\": 1},\n\"b\": 2,\n\"c\": 3}", "test", options);
  EXPECT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.unchanged, 2U);
}

TEST(Collector, KhronosProfileListsEveryRepeat) {
  ValidateOptions options;
  options.profile = Profile::khronos;
  EXPECT_EQ(validate_bytes(misspelt_nodes(100), "test", options).diagnostics.size(), 100U);
}

TEST(Collector, DifferentMembersAreNotRepeats) {
  const Lines wanted{"UNEXPECTED_PROPERTY /asset/a", "UNEXPECTED_PROPERTY /asset/b"};
  EXPECT_EQ(test::verdict(R"({"asset": {"version": "2.0", "a": 1, "b": 1}})"), wanted);
}

TEST(Collector, MaxIssuesEndsTheListButNotTheCount) {
  ValidateOptions options;
  options.max_issues = 1;
  const FileReport report =
      validate_bytes(R"({"asset": {"version": "2.0", "a": 1, "b": 1}})", "test", options);
  EXPECT_EQ(report.diagnostics.size(), 1U);
  EXPECT_TRUE(report.truncated);
  EXPECT_EQ(report.counts.warnings, 2U);
}

TEST(Collector, MaxIssuesOfTheKhronosProfileCountsAllRepeats) {
  ValidateOptions options;
  options.profile = Profile::khronos;
  const FileReport all = validate_bytes(misspelt_nodes(100), "test", options);
  EXPECT_FALSE(all.truncated);
  for (const std::uint64_t most : {1U, 99U, 100U, 101U}) {
    options.max_issues = most;
    const FileReport report = validate_bytes(misspelt_nodes(100), "test", options);
    ASSERT_EQ(report.diagnostics.size(), std::min<std::uint64_t>(most, 100));
    EXPECT_EQ(report.diagnostics.back().pointer,
              all.diagnostics[report.diagnostics.size() - 1].pointer);
    EXPECT_EQ(report.truncated, most < 100);
    EXPECT_EQ(report.counts.warnings, all.counts.warnings);
    EXPECT_EQ(report.counts.infos, all.counts.infos);
  }
}

TEST(Collector, SelectAndIgnoreChooseCodes) {
  const std::string asset = R"({"asset": {"version": "2.0", "a": 1, "minVersion": 2}})";
  ValidateOptions options;
  options.select = {"TYPE_MISMATCH"};
  EXPECT_EQ(test::verdict(asset, options), Lines{"TYPE_MISMATCH /asset/minVersion"});
  options.select.clear();
  options.ignore = {"TYPE_MISMATCH"};
  EXPECT_EQ(test::verdict(asset, options), Lines{"UNEXPECTED_PROPERTY /asset/a"});
}

TEST(Collector, SeverityOfACodeCanBeChanged) {
  ValidateOptions options;
  options.severity = {{"UNEXPECTED_PROPERTY", Severity::error}};
  const FileReport report =
      validate_bytes(R"({"asset": {"version": "2.0", "a": 1}})", "test", options);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::error);
  EXPECT_EQ(report.counts.errors, 1U);
}

TEST(Collector, KnowsThePlaceAndTheNameOfTheObject) {
  const FileReport report = validate_bytes(
      "{\"asset\": {\"version\": \"2.0\"},\n \"scenes\": [{\"name\": \"Hall\",\n  \"colour\": 1}]}",
      "test");
  ASSERT_EQ(report.diagnostics.size(), 1U);
  const Diagnostic& found = report.diagnostics[0];
  EXPECT_EQ(found.pointer, "/scenes/0/colour");
  EXPECT_EQ(found.object_name, "Hall");
  EXPECT_EQ(found.location.line, 3U);
  EXPECT_EQ(found.location.column, 3U);
  EXPECT_EQ(found.excerpt.text.substr(found.excerpt.caret, found.excerpt.width), "\"colour\"");
}

TEST(Collector, FindingsStandInTheOrderOfThePhases) {
  const Lines wanted{"JSON_DUPLICATE_KEY ", "UNEXPECTED_PROPERTY /a",
                     "UNRESOLVED_REFERENCE /scene"};
  EXPECT_EQ(test::verdict(R"({"asset": {"version": "2.0", "version": "2.0"}, "scene": 0, "a": 1})"),
            wanted);
}

TEST(Collector, HintsAreForTheStrictProfile) {
  const std::string asset = R"({"asset": {"version": "2.0"}, "a": 1})";
  ValidateOptions options;
  options.severity = {{"UNEXPECTED_PROPERTY", Severity::hint}};
  EXPECT_TRUE(test::verdict(asset, options).empty());
  options.profile = Profile::strict;
  EXPECT_EQ(test::verdict(asset, options), Lines{"UNEXPECTED_PROPERTY /a"});
}

}  // namespace
}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
// The deviations of profiles, and their description on the page of a rule.
#include "rules/khronos/deviations.hpp"

#include <gltfx/pipeline.hpp>

#include <array>
#include <bit>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gltfx::validate {
namespace {

using testing::Each;

std::array<bool, sizeof(Deviations)> members(Profile profile) {
  return std::bit_cast<std::array<bool, sizeof(Deviations)>>(deviations_of(profile));
}

TEST(Deviations, AreThoseOfTheKhronosValidator) {
  EXPECT_THAT(members(Profile::khronos), Each(true)) << "one is missing in deviations.cpp";
  EXPECT_THAT(members(Profile::standard), Each(false));
  EXPECT_THAT(members(Profile::strict), Each(false));
}

Severity severity_of(Profile profile, const std::string& asset) {
  ValidateOptions options;
  options.profile = profile;
  options.select = {"VALUE_NOT_IN_LIST"};
  const FileReport report = validate_bytes(asset, "test", options);
  EXPECT_EQ(report.diagnostics.size(), 1U);
  return report.diagnostics.empty() ? Severity::hint : report.diagnostics[0].severity;
}

TEST(Deviations, SeveritiesComeFromThePageOfTheRule) {
  const RuleDescription* rule = find_rule("VALUE_NOT_IN_LIST");
  ASSERT_NE(rule, nullptr);
  EXPECT_EQ(rule->severity, Severity::error);
  EXPECT_EQ(rule->khronos_severity, Severity::warning);
  const std::string asset = R"({"asset": {"version": "2.0"}, "samplers": [{"magFilter": 1}]})";
  EXPECT_EQ(severity_of(Profile::standard, asset), Severity::error);
  EXPECT_EQ(severity_of(Profile::khronos, asset), Severity::warning);
}

TEST(Deviations, AUsersSeverityIsStronger) {
  ValidateOptions options;
  options.profile = Profile::khronos;
  options.select = {"VALUE_NOT_IN_LIST"};
  options.severity["VALUE_NOT_IN_LIST"] = Severity::info;
  const FileReport report = validate_bytes(
      R"({"asset": {"version": "2.0"}, "samplers": [{"magFilter": 1}]})", "test", options);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::info);
}

}  // namespace
}  // namespace gltfx::validate

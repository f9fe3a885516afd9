// SPDX-License-Identifier: Apache-2.0
// Each rule's fix, by the examples of its page.
#include <gltfx/pipeline.hpp>

#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "rules/fix_entry.hpp"

namespace gltfx {
namespace {

bool raises(const FileReport& report, std::string_view code) {
  for (const Diagnostic& finding : report.diagnostics) {
    if (finding.code == code) return true;
  }
  return false;
}

class RuleFix : public testing::TestWithParam<RuleDescription> {};

TEST_P(RuleFix, IsThereWhereThePageSaysSo) {
  const RuleDescription& rule = GetParam();
  const auto code = static_cast<Code>(&*find_rule(rule.code) - rules().data());
  const bool promised = rule.fix == Fix::safe || rule.fix == Fix::unsafe;
  EXPECT_EQ(validate::find_fix(code) != nullptr, promised);
  EXPECT_EQ(!rule.fix_does.empty(), promised);
  EXPECT_EQ(!rule.fixed.empty(), promised);
}

TEST_P(RuleFix, MakesTheFixedExampleOfTheBadOneAndNothingOfThat) {
  const RuleDescription& rule = GetParam();
  if (rule.fixed.empty()) return;
  const std::string fixed = example_bytes(rule.fixed);
  EXPECT_EQ(fix_example(rule, rule.bad), fixed);
  EXPECT_EQ(fix_example(rule, rule.fixed), fixed);
  EXPECT_EQ(fix_example(rule, rule.good), example_bytes(rule.good));
  EXPECT_FALSE(raises(validate_example(rule, Example::fixed), rule.code));
}

INSTANTIATE_TEST_SUITE_P(All, RuleFix, testing::ValuesIn(rules().begin(), rules().end()),
                         [](const auto& rule) { return std::string(rule.param.code); });

}  // namespace
}  // namespace gltfx

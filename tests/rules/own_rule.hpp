// SPDX-License-Identifier: Apache-2.0
/// Own rules for tests.
#pragma once

#include <gltfx/own_rules.hpp>
#include <gltfx/validate.hpp>

#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gltfx::test {

/// A page with that schema.
inline std::string page(const std::string& code, const std::string& on, const std::string& schema,
                        const std::string& keys = "severity: error\n") {
  return "---\n" + keys + "on: " + on + "\nmessage: It does not fit.\n---\n\n# " + code +
         "\n\nSummary.\n\n## Why it matters\n\nWhy.\n\n## How to fix it\n\nHow.\n\n"
         "## Schema\n\n```json\n" +
         schema + "\n```\n\n## Bad\n\n```json\n{}\n```\n\n## Good\n\n```json\n{}\n```\n";
}

/// Pages without mistakes.
inline std::shared_ptr<const OwnRules> rules_of(const std::vector<OwnRulePage>& pages) {
  OwnRulesRead read = read_own_rules(pages);
  EXPECT_THAT(read.mistakes, testing::IsEmpty());
  return read.rules;
}

/// Options for one rule, ACME_RULE, alone.
inline ValidateOptions with_rule(const std::string& on, const std::string& schema) {
  ValidateOptions options;
  options.own_rules = rules_of({{"ACME_RULE.md", page("ACME_RULE", on, schema)}});
  options.select = {"ACME_RULE"};
  return options;
}

}  // namespace gltfx::test

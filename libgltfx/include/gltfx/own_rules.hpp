// SPDX-License-Identifier: Apache-2.0
/// @file
/// Own rules: pages with a JSON Schema. A page is data: it can neither run nor read anything,
/// and adds findings to those of gltfx.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// The text of a page.
struct OwnRulePage {
  std::string file;  ///< its path; the file name without ".md" is the code of the rule
  std::string text;  ///< its content, at most 256 KiB
};

/// Compiled pages. Immutable, so any number of threads may validate with them.
class OwnRules;

/// What read_own_rules() returns.
struct OwnRulesRead {
  std::shared_ptr<const OwnRules> rules;  ///< null when there are mistakes, or no pages
  std::vector<std::string> mistakes;      ///< "house/ACME_NAME.md:12: what is wrong"
};

/// Compiles pages for ValidateOptions::own_rules. Codes must differ from each other and from those
/// of gltfx. At most 1000 pages.
OwnRulesRead read_own_rules(std::span<const OwnRulePage> pages);

/// The rules of gltfx and those of the pages, sorted by code. Lives as long as `own`, which may be
/// null.
std::span<const RuleDescription> rules(const OwnRules* own);

/// The rule with that code, or null. `own` may be null.
const RuleDescription* find_rule(std::string_view code, const OwnRules* own);

/// A page to start with. Empty when `on` is not one of own_rule_scopes() or `code` is not a code.
std::string own_rule_template(std::string_view code, std::string_view on);

/// The kinds of object that a rule may be about: "glTF", "asset", "node".
std::span<const std::string_view> own_rule_scopes();

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
/// Rules of the user, and the phase that runs them.
#pragma once

#include <gltfx/measure.hpp>
#include <gltfx/own_rules.hpp>

#include <cstddef>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.hpp"
#include "rules/broken_places.hpp"
#include "rules/collector.hpp"
#include "rules/context.hpp"
#include "rules/own/own_page.hpp"

namespace gltfx {

/// The code of the rule of page i is the one after those of gltfx, plus i.
class OwnRules {
 public:
  using Pages = std::vector<std::shared_ptr<const validate::OwnPage>>;
  explicit OwnRules(Pages pages);

  /// Sorted by code.
  const Pages& pages() const { return pages_; }
  /// In the same order.
  std::span<const RuleDescription> descriptions() const { return own_; }
  /// With the rules of gltfx, sorted by code.
  std::span<const RuleDescription> table() const { return table_; }
  /// Of the pages' names and texts.
  const Hash128& sources() const { return sources_; }
  /// Those of some files; null: none.
  std::shared_ptr<const OwnRules> of(const std::set<std::string>& files) const;

 private:
  Pages pages_;
  std::vector<RuleDescription> own_, table_;
  Hash128 sources_;
};

/// The rule with that code in a table that is sorted by code, or null.
const RuleDescription* find_rule(std::string_view code, std::span<const RuleDescription> all);

/// Reads pages in addition to those of `known`, which may be null.
OwnRulesRead read_own_rules(std::span<const OwnRulePage> pages, const OwnRules* known);

namespace validate {

/// The code of a page.
Code own_code(std::size_t page);

/// Phase 8: checks the objects of each page and reports to `collector`. Objects with errors are
/// left out. `name`: the path of the asset. `measured`: as take_own_measures() gives them; may be
/// null.
void check_own_rules(const Context& context, const BrokenPlaces& broken, const std::string& name,
                     const Measurements* measured, Collector& collector);

}  // namespace validate
}  // namespace gltfx

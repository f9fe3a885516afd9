// SPDX-License-Identifier: Apache-2.0
/// Rules of the user, and the phase that runs them.
#pragma once

#include <gltfx/measure.hpp>
#include <gltfx/own_rules.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "base/sink.hpp"
#include "rules/broken_places.hpp"
#include "rules/context.hpp"
#include "rules/own/own_page.hpp"

namespace gltfx {

/// The code of the rule of page i is the one after those of gltfx, plus i.
class OwnRules {
 public:
  explicit OwnRules(std::vector<std::unique_ptr<const validate::OwnPage>> pages);

  /// Sorted by code.
  const std::vector<std::unique_ptr<const validate::OwnPage>>& pages() const { return pages_; }
  /// In the same order.
  std::span<const RuleDescription> descriptions() const { return own_; }
  /// With the rules of gltfx, sorted by code.
  std::span<const RuleDescription> table() const { return table_; }
  /// Of the pages' texts.
  const Hash128& sources() const { return sources_; }
  void set_sources(const Hash128& sources) { sources_ = sources; }

 private:
  std::vector<std::unique_ptr<const validate::OwnPage>> pages_;
  std::vector<RuleDescription> own_, table_;
  Hash128 sources_;
};

namespace validate {

/// The code of a page.
Code own_code(std::size_t page);

/// Phase 8: checks the objects of each page and reports to `sink`. Objects with errors are left
/// out. `name`: the path of the asset. `measured`: as take_own_measures() gives them; may be null.
void check_own_rules(const Context& context, const BrokenPlaces& broken, const std::string& name,
                     const Measurements* measured, Sink& sink);

}  // namespace validate
}  // namespace gltfx

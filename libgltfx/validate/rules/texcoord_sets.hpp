// SPDX-License-Identifier: Apache-2.0
/// The texture coordinates of a primitive.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/mesh.hpp"
#include "validate/context.hpp"

namespace gltfx::validate {

/// The texture coordinates of a primitive, and which of them some material reads.
class TexCoords {
 public:
  TexCoords(const Context& context, const model::Primitive& primitive) {
    std::uint64_t highest = 0;
    for (const model::Attribute& attribute : primitive.attributes) {
      if (attribute.semantic.kind != model::SemanticKind::texcoord) continue;
      sets_.push_back({&attribute, false});
      highest = std::max(highest, attribute.semantic.set);
    }
    std::sort(sets_.begin(), sets_.end(), [](const Set& a, const Set& b) {
      return a.attribute->semantic.set < b.attribute->semantic.set;
    });
    const bool gap = !sets_.empty() && highest != sets_.size() - 1;
    if (gap && context.deviations.sets_with_gaps_are_empty) sets_.clear();
  }

  struct Set {
    const model::Attribute* attribute;
    bool used;
  };

  /// Marks a set as read; false when the primitive does not have it.
  bool use(std::uint64_t set) {
    const auto at = std::lower_bound(sets_.begin(), sets_.end(), set,
                                     [](const Set& each, std::uint64_t wanted) {
                                       return each.attribute->semantic.set < wanted;
                                     });
    if (at == sets_.end() || at->attribute->semantic.set != set) return false;
    at->used = true;
    return true;
  }

  const std::vector<Set>& sets() const { return sets_; }

 private:
  std::vector<Set> sets_;  // by number
};

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
/// State that rules on primitives share, such as their texture coordinates.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "model/mesh.hpp"
#include "rules/context.hpp"
#include "rules/core/attribute_formats.hpp"
#include "rules/core/material_needs.hpp"
#include "rules/core/use.hpp"
#include "rules/extension_walk.hpp"

namespace gltfx::validate {

/// The texture coordinates of a primitive, and those that some material reads.
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

  /// Marks a set as read; false if the primitive does not have it.
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

struct MeshState {
  explicit MeshState(const Context& checked)
      : context(checked),
        active(checked),
        formats(checked),
        materials(checked, active),
        unseen(unseen_user(checked)),
        seen_accessors(checked.views.accessors.size()),
        views_in_use(checked.views.buffer_views.size()) {}

  const Context& context;
  ActiveExtensions active;
  AttributeFormats formats;
  MaterialNeeds materials;
  std::string_view unseen;           ///< see unseen_user()
  std::vector<bool> seen_accessors;  ///< accessors that some attribute has used
  std::vector<bool> views_in_use;    ///< views without a stride that some attribute has used
};

/// An attribute whose index refers to an accessor.
struct AttributeUse {
  const model::Attribute& attribute;
  const model::Accessor& accessor;
  bool target;  ///< of a morph target
};

/// Reports uses, bounds and format of an attribute at `path`, in this order; then its alignment.
void check_attribute(MeshState& state, const AttributeUse& use, const Path& path);

/// Reports an attribute that shares a view without byteStride with another one.
void check_shared_view(MeshState& state, const AttributeUse& use, const Path& path);

/// Checks the attributes of a primitive that its materials require.
class MaterialCheck {
 public:
  /// Keeps references to all three.
  MaterialCheck(const MeshState& state, const model::Primitive& primitive, const Path& path)
      : state_(state), primitive_(primitive), path_(path), texcoords_(state.context, primitive) {}

  /// Checks the materials of its variants. Call it before check_material().
  void check_variants();
  /// Checks its own material, and reports attributes that no material reads.
  void check_material();

 private:
  const MeshState& state_;
  const model::Primitive& primitive_;
  const Path& path_;
  TexCoords texcoords_;
  bool tangent_space_ = false;  ///< some material needs a tangent space
};

}  // namespace gltfx::validate

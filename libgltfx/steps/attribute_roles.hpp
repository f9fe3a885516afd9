// SPDX-License-Identifier: Apache-2.0
/// What the accessors of vertex attributes are used for.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "model/mesh.hpp"
#include "steps/step_data.hpp"

namespace gltfx::steps {

/// The use of one accessor by all primitives.
struct AttributeRole {
  model::SemanticKind kind = model::SemanticKind::invalid;
  bool of_target = false;  ///< its values are added to others
  bool is_mixed = false;   ///< attributes of several kinds use it, or indices
  bool is_coded = false;   ///< a primitive has its elements in a bitstream
  std::uint64_t uses = 0;
};

/// The attributes of a primitive, and those of each of its morph targets.
struct AttributeLists {
  std::vector<model::Attribute> own;
  std::vector<std::vector<model::Attribute>> targets;
};
AttributeLists attribute_lists(const model::Asset& asset, const model::Primitive& primitive);

/// The roles of all accessors. `data` must outlive it.
class AttributeRoles {
 public:
  explicit AttributeRoles(const StepData& data);

  /// By accessor; SemanticKind::invalid: no primitive uses it as an attribute.
  const AttributeRole& of(std::uint32_t accessor) const { return roles_[accessor]; }
  /// Whether the numbers of an accessor are of single precision.
  bool is_float(std::uint32_t accessor) const;
  /// Why the elements of an accessor cannot get another format, half a sentence; empty: they can.
  std::string find_obstacle(std::uint32_t accessor) const;
  /// The extension without a schema that may refer to an object by this index, half a sentence;
  /// empty: none.
  std::string find_unknown(std::uint32_t index) const;

 private:
  void note(const std::vector<model::Attribute>& attributes, bool of_target, bool is_coded);

  const StepData& data_;
  std::vector<AttributeRole> roles_;
  const std::set<std::uint64_t> meant_;  ///< integers in extensions without a schema
};

}  // namespace gltfx::steps

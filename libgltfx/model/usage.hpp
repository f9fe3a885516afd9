// SPDX-License-Identifier: Apache-2.0
/// Uses of accessors and buffer views. Each holds one kind of data: the first use decides, and a
/// later one of another kind is an error (specification section 3.6.1).
#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "model/accessor.hpp"
#include "model/mesh.hpp"

namespace gltfx::model {

enum class AccessorUse : std::uint8_t {
  none,
  animation_input,
  animation_output,
  inverse_bind_matrices,
  indices,
  vertex_attribute,
};
enum class ViewUse : std::uint8_t { none, inverse_bind_matrices, image, indices, other, vertices };

/// The use as a phrase for messages: "vertex indices".
std::string_view use_text(AccessorUse use);
std::string_view use_text(ViewUse use);
/// The use of the view of an accessor with this use.
ViewUse view_use(AccessorUse use);

/// The uses of an accessor or buffer view by indices, and the first one.
template <typename Kind>
struct Uses {
  Kind kind = Kind::none;
  json::NodeId place =
      json::kNoNode;       ///< the index of the first use; kNoNode: a view's own `target`
  std::uint8_t kinds = 0;  ///< one bit per kind of use by index
  bool used() const { return kinds != 0; }
  bool has(Kind wanted) const { return (kinds >> static_cast<unsigned>(wanted) & 1U) != 0; }
  /// The kind of all uses; nothing if there is none, or they differ.
  std::optional<Kind> only() const {
    if (!std::has_single_bit(kinds)) return std::nullopt;
    return static_cast<Kind>(std::countr_zero(kinds));
  }
  void note(Kind other, json::NodeId at) {
    if (kind == Kind::none) kind = other, place = at;
    kinds = static_cast<std::uint8_t>(kinds | 1U << static_cast<unsigned>(other));
  }
};

/// Uses by index in core members. The first one is that of an image or a sparse accessor, then of a
/// mesh, a skin, an animation. Immutable.
class Usage {
 public:
  Usage() = default;
  Usage(const Asset& asset, const std::vector<Accessor>& accessors,
        const std::vector<BufferView>& views, const std::vector<Mesh>& meshes);

  const Uses<AccessorUse>& accessor(std::uint32_t index) const { return accessors_[index]; }
  const Uses<ViewUse>& view(std::uint32_t index) const { return views_[index]; }

 private:
  friend class UsageReader;
  std::vector<Uses<AccessorUse>> accessors_;
  std::vector<Uses<ViewUse>> views_;
};

}  // namespace gltfx::model

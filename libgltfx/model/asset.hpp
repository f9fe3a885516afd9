// SPDX-License-Identifier: Apache-2.0
/// The root arrays of a glTF document, read once, to resolve every index of the file; the version
/// of glTF.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "json/document.hpp"

namespace gltfx::model {

/// Whether a document is glTF 1.0 by its `asset.version`, a string or a number, or without a
/// version by its shaders and its dictionaries in place of arrays.
bool is_gltf_1(const json::Document& document);

/// The arrays of the root object, in the specification's order.
enum class RootArray : std::uint8_t {
  accessors,
  animations,
  buffers,
  buffer_views,
  cameras,
  images,
  materials,
  meshes,
  nodes,
  samplers,
  scenes,
  skins,
  textures,
};
inline constexpr std::size_t kRootArrayCount = 13;
/// The member's name: "bufferViews".
std::string_view root_array_name(RootArray array);

/// A read-only view of a document that has a root object. The document must outlive it.
/// Any number of threads may read it.
class Asset {
 public:
  /// `any_amount`: also more root objects than most_root_objects(); otherwise the arrays are then
  /// empty.
  explicit Asset(const json::Document& document, bool any_amount = false);

  const json::Document& document() const { return *document_; }

  /// Objects of a root array by index; json::kNoNode for an element that is not an object. Empty
  /// when the array is missing or not an array.
  const std::vector<json::NodeId>& elements(RootArray array) const {
    return elements_[static_cast<std::size_t>(array)];
  }
  std::size_t count(RootArray array) const { return elements(array).size(); }

  /// The member of `object` as an index of an object in `array`; nothing when it is missing, not an
  /// index, out of range, or the element is not an object.
  std::optional<std::uint32_t> index(json::NodeId object, std::string_view member,
                                     RootArray array) const;
  /// `value` as such an index.
  std::optional<std::uint32_t> index(double value, RootArray array) const;

  /// The object's `name`, or empty.
  std::string name(json::NodeId object) const;

 private:
  const json::Document* document_;
  std::array<std::vector<json::NodeId>, kRootArrayCount> elements_;
};

}  // namespace gltfx::model

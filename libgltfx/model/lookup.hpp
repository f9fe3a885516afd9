// SPDX-License-Identifier: Apache-2.0
/// Members and elements by name and position, many times in one document.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "json/document.hpp"

namespace gltfx::model {

/// Keeps tables of the arrays and of the large objects it was asked about, so that many questions
/// take time linear in them and in the document, whatever its form. The document must outlive it.
/// Not thread-safe.
class Lookup {
 public:
  explicit Lookup(const json::Document& document) : document_(document) {}

  /// As Document::find().
  json::NodeId member(json::NodeId object, std::string_view name);
  /// The element nodes of an `array` (not of a `number_array`).
  const std::vector<json::NodeId>& elements(json::NodeId array);
  /// Number of elements of any array.
  std::uint64_t size(json::NodeId array);

 private:
  using MembersByKey = std::unordered_map<json::KeyId, json::NodeId>;

  const json::Document& document_;
  std::unordered_map<json::NodeId, std::vector<json::NodeId>> elements_;
  std::unordered_map<json::NodeId, MembersByKey> members_;
  std::unordered_map<json::NodeId, std::uint64_t> sizes_;
};

}  // namespace gltfx::model

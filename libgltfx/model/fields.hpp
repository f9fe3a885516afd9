// SPDX-License-Identifier: Apache-2.0
/// Members of a JSON object in their glTF types, and repeated look-ups of elements in one document.
/// A value of another type counts as absent: the schema walk has reported it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "json/document.hpp"

namespace gltfx::model {

/// A non-negative integer, at most 2^53.
std::optional<std::uint64_t> unsigned_member(const json::Document& document, json::NodeId object,
                                             std::string_view name);

/// Any finite number.
std::optional<double> number_member(const json::Document& document, json::NodeId object,
                                    std::string_view name);

/// `true` only when the member is the literal true.
bool true_member(const json::Document& document, json::NodeId object, std::string_view name);

/// A string, or empty.
std::string string_member(const json::Document& document, json::NodeId object,
                          std::string_view name);

/// The member of that name if it is an object, otherwise json::kNoNode.
json::NodeId object_member(const json::Document& document, json::NodeId object,
                           std::string_view name);

/// The object of an extension on `object`, or json::kNoNode.
json::NodeId extension_object(const json::Document& document, json::NodeId object,
                              std::string_view extension);

/// Caches tables of arrays, so that the time of all calls together is linear in their number and in
/// the document. The document must outlive it. Not thread-safe.
class ArrayLookup {
 public:
  explicit ArrayLookup(const json::Document& document) : document_(document) {}

  /// The element nodes of an `array` (not of a `number_array`).
  const std::vector<json::NodeId>& elements(json::NodeId array);
  /// Number of elements of any array.
  std::uint64_t size(json::NodeId array);

 private:
  const json::Document& document_;
  std::unordered_map<json::NodeId, std::vector<json::NodeId>> elements_;
  std::unordered_map<json::NodeId, std::uint64_t> sizes_;
};

}  // namespace gltfx::model

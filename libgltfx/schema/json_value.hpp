// SPDX-License-Identifier: Apache-2.0
/// A value of any document, for the checks of JSON Schema.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "json/document.hpp"

namespace gltfx::schema {

/// A node, a key as a string, or a number inside an array of numbers, which has no node.
struct JsonValue {
  const json::Document* document = nullptr;
  json::NodeId node = json::kNoNode;
  const json::Number* element = nullptr;  ///< set: this number of the array `node`

  /// A key counts as a string.
  json::Kind kind() const;
  /// TypeBits that the value has: an integer has two.
  std::uint8_t types() const;
  bool is_array() const { return element == nullptr && document->is_array(node); }
  /// Precondition: kind() is number.
  double number() const;
  /// The bytes in the text.
  std::string_view raw() const;

  /// Calls `use` with index and element until it returns false; says whether it never did.
  /// Precondition: is_array().
  template <class Use>
  bool all_elements(const Use& use) const {
    std::uint64_t index = 0;
    if (document->kind(node) == json::Kind::number_array) {
      for (json::NumberCursor at(*document, node); at.valid(); at.advance()) {
        if (!use(index++, JsonValue{document, node, &at.number()})) return false;
      }
      return true;
    }
    for (const json::NodeId one : document->elements(node)) {
      if (!use(index++, JsonValue{document, one})) return false;
    }
    return true;
  }
};

/// Whether two values are equal: numbers by value, objects in any order.
bool equal_values(const JsonValue& one, const JsonValue& other);

/// The first two equal elements of an array, by a hash of each. `work` is reduced by further
/// comparisons; `exhausted` is set if it does not suffice.
std::optional<std::pair<std::uint64_t, std::uint64_t>> equal_elements(const JsonValue& array,
                                                                      std::uint64_t& work,
                                                                      bool& exhausted);

/// A value of a text for a message: printable, cut.
std::string shown(std::string_view raw);

}  // namespace gltfx::schema

// SPDX-License-Identifier: Apache-2.0
/// A value of a document for the checks: a node, or a number inside an array of numbers, which does
/// not have a node.
#pragma once

#include <cstdint>
#include <string_view>

#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx::schema {

/// The bit of a type by its name: "integer". 0: there is none.
std::uint8_t type_bit(std::string_view name);
/// The bit of a kind of value; a key is a string, and a number does not have kInteger.
std::uint8_t type_bit(json::Kind kind);

struct Value {
  json::NodeId node = json::kNoNode;
  const json::Number* element = nullptr;  ///< set: this number of the array `node`
};

/// Accessors of values of `document` that every check uses.
class Values {
 public:
  explicit Values(const json::Document& read) : document(read) {}

  json::Kind kind(Value v) const {
    return v.element != nullptr ? json::Kind::number : document.kind(v.node);
  }
  Span span(Value v) const {
    return v.element != nullptr ? v.element->span : document.span(v.node);
  }
  json::Number number(Value v) const {
    return v.element != nullptr ? *v.element : document.number(v.node);
  }
  std::string_view raw(Value v) const { return span(v).in(document.text()); }

  /// Whether the value's JSON type is among `types` (bits; 0 is any).
  bool has_type(Value v, std::uint8_t types) const;
  bool equals(Value v, const Literal& literal) const;

  const json::Document& document;
};

}  // namespace gltfx::schema

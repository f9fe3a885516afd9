// SPDX-License-Identifier: Apache-2.0
#include "schema/value.hpp"

#include <array>
#include <utility>

namespace gltfx::schema {

std::uint8_t type_bit(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, TypeBit>, 7> kTypes{{{"object", kObject},
                                                                        {"array", kArray},
                                                                        {"string", kString},
                                                                        {"number", kNumber},
                                                                        {"integer", kInteger},
                                                                        {"boolean", kBoolean},
                                                                        {"null", kNull}}};
  for (const auto& [known, bit] : kTypes) {
    if (known == name) return bit;
  }
  return 0;
}

std::uint8_t type_bit(json::Kind kind) {
  switch (kind) {
    case json::Kind::null:
      return kNull;
    case json::Kind::false_value:
    case json::Kind::true_value:
      return kBoolean;
    case json::Kind::string:
    case json::Kind::key:
      return kString;
    case json::Kind::array:
    case json::Kind::number_array:
      return kArray;
    case json::Kind::object:
      return kObject;
    case json::Kind::number:
      break;
  }
  return kNumber;
}

bool Values::has_type(Value v, std::uint8_t types) const {
  const std::uint8_t bit = type_bit(kind(v));
  if (types == 0 || (types & bit) != 0) return true;
  return bit == kNumber && (types & kInteger) != 0 && number(v).is_integer();
}

bool Values::equals(Value v, const Literal& literal) const {
  switch (literal.kind) {
    case Literal::Kind::null:
      return kind(v) == json::Kind::null;
    case Literal::Kind::boolean:
      return kind(v) == (literal.number != 0 ? json::Kind::true_value : json::Kind::false_value);
    case Literal::Kind::number:
      return kind(v) == json::Kind::number && number(v).value == literal.number;
    case Literal::Kind::string:
      break;
  }
  if (kind(v) != json::Kind::string) return false;
  std::string buffer;
  return document.string(v.node, buffer) == literal.string;
}

}  // namespace gltfx::schema

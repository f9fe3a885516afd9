// SPDX-License-Identifier: Apache-2.0
#include "schema/value.hpp"

namespace gltfx::schema {

bool Values::has_type(Value v, std::uint8_t types) const {
  if (types == 0) return true;
  switch (kind(v)) {
    case json::Kind::null:
      return (types & kNull) != 0;
    case json::Kind::false_value:
    case json::Kind::true_value:
      return (types & kBoolean) != 0;
    case json::Kind::string:
      return (types & kString) != 0;
    case json::Kind::array:
    case json::Kind::number_array:
      return (types & kArray) != 0;
    case json::Kind::object:
      return (types & kObject) != 0;
    case json::Kind::number:
      return (types & kNumber) != 0 || ((types & kInteger) != 0 && number(v).is_integer());
    case json::Kind::key:
      break;
  }
  return false;
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

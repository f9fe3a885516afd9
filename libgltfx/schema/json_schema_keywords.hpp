// SPDX-License-Identifier: Apache-2.0
/// The keywords of JSON Schema 2020-12 that schemas of users may have.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "schema/json_schema.hpp"

namespace gltfx::schema {

/// The form of a keyword's value, and its meaning.
enum class Shape2020 : std::uint8_t {
  annotation,
  consumed,  ///< read with another keyword
  type,
  literal,
  literals,
  number,
  count,
  flag,
  pattern,
  names,
  names_map,
  schema,
  schemas,
  schema_map,
  pattern_map,
  reference,
};

struct Keyword2020 {
  std::string_view name;
  Shape2020 shape;
  Assertion::Kind kind = Assertion::Kind::type;
};

/// The keyword of that name, or null.
const Keyword2020* find_keyword(std::string_view name);

/// The mistake of an unknown keyword, with what to write in its place.
std::string unknown_keyword(std::string_view name);

}  // namespace gltfx::schema

// SPDX-License-Identifier: Apache-2.0
/// What a value of a wrong form means, where it can mean only one thing.
#pragma once

#include <string>
#include <string_view>

#include "json/document.hpp"
#include "schema/set.hpp"
#include "schema/value.hpp"

namespace gltfx::schema {

/// The JSON text of the number that a string spells, also with a decimal comma; empty: it spells
/// none, or "1,500", which may be a thousand and a half.
std::string spelt_number(std::string_view text);

/// The JSON text of a list of decimal commas, "[0,5, 1, 1,25]", with decimal points; empty: it is
/// none, or does not hold as many numbers as the shape wants.
std::string with_decimal_points(const json::Document& document, json::NodeId numbers,
                                const Shape& shape);

/// The JSON text of a value of the wrong type in the type that the shape wants: without quotes,
/// with quotes, a texture's index as an object; empty: it is not certain.
std::string meant_value(const Set& set, const Values& values, const Shape& shape, Value value);

}  // namespace gltfx::schema

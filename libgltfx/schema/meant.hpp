// SPDX-License-Identifier: Apache-2.0
/// The meaning of a value of a wrong form, if there is only one.
#pragma once

#include <string>
#include <string_view>

#include "json/document.hpp"
#include "schema/set.hpp"
#include "schema/value.hpp"

namespace gltfx::schema {

/// The JSON text of the number that a string spells, also with a decimal comma; empty: it does not
/// spell one, or it is ambiguous, such as "1,500".
std::string spelt_number(std::string_view text);

/// The JSON text of a list of decimal commas, "[0,5, 1, 1,25]", with decimal points; empty: it is
/// not such a list, or does not have as many numbers as the shape requires.
std::string with_decimal_points(const json::Document& document, json::NodeId numbers,
                                const Shape& shape);

/// The JSON text of a value of the wrong type in the type of the shape: without quotes, with
/// quotes, a texture's index as an object; empty: it is not certain.
std::string meant_value(const Set& set, const Values& values, const Shape& shape, Value value);

}  // namespace gltfx::schema

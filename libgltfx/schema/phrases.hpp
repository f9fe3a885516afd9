// SPDX-License-Identifier: Apache-2.0
/// The phrases of findings: what was found, what is expected.
#pragma once

#include <string>

#include "base/json_pointer.hpp"
#include "schema/value.hpp"

namespace gltfx::schema {

/// "'metallicFactor'", "Element 2 of 'children'", "The document".
std::string name_of(const Path& path);
/// A sentence as the end of another one: "Unlit materials ..." as "unlit materials ...".
std::string clause(std::string text);
/// A scalar as written, cut; "an array", "an object".
std::string shown(const Values& values, Value value);
/// "a number", "a string or an object". An integer beside a number is not named.
std::string type_phrase(std::uint8_t types);
/// What a number must be: "between 0 and 1", "above 0"; empty without limits.
std::string range_phrase(const Shape& shape);
/// "1 (LINES), 4 (TRIANGLES) or 5": the values of an enum.
std::string list_phrase(const Shape& shape);
/// "exactly 3", "at least 1", "between 1 and 16" for a count of things; `one` and `many` name them.
std::string count_phrase(std::uint64_t least, std::uint64_t most, const char* one,
                         const char* many);
/// All requirements of a shape on a scalar, for shapes that are alternatives: "0", "at least 1".
std::string scalar_phrase(const Set& set, const Shape& shape);
/// "'a'", "'a' and 'b'", "'a', 'b' and 'c'".
std::string all_of_phrase(const std::vector<std::string>& names);

/// What to write instead of a value of the wrong type; empty when nothing is obvious. `optional`:
/// the value is that of an optional member.
std::string type_help(const Set& set, const Values& values, const Shape& shape, Value value,
                      bool optional);
/// What to add for a member that is missing.
std::string missing_help(const Set& set, const Property& property);

}  // namespace gltfx::schema

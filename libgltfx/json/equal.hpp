// SPDX-License-Identifier: Apache-2.0
/// Whether two values are equal.
#pragma once

#include <string_view>

#include "json/document.hpp"

namespace gltfx::json {

/// Numbers are compared by their exact value and sign, half surrogates as they are written, objects
/// independent of the order of their members (the last of those with one name counts). Values whose
/// equality is not certain count as different. Iterative; linear in both values. Both arguments are
/// values, or keys, of `document`.
bool equal(const Document& document, NodeId one, NodeId other);
/// The same for a value of another document, `theirs`.
bool equal(const Document& ours, NodeId one, const Document& theirs, NodeId other);

/// The same, but numbers are equal if their nearest doubles are: 0 and -0.
bool equal_by_value(const Document& ours, NodeId one, const Document& theirs, NodeId other);

/// Whether two numbers have the same value and sign, each of the text that it stands in.
bool same_number(std::string_view our_text, const Number& one, std::string_view their_text,
                 const Number& other);

}  // namespace gltfx::json

// SPDX-License-Identifier: Apache-2.0
/// Numbers from and to text, also where the standard library supports integers only.
#pragma once

#include <charconv>
#include <string>

namespace gltfx {

/// The number that begins at `first`, as std::from_chars() reads it.
std::from_chars_result read_double(const char* first, const char* last, double& value);

/// A double as ECMAScript writes it (ECMA-262, Number::toString): the shortest digits that read
/// back equal, with an exponent from 1e21 on and below 1e-6; but "-0".
std::string number_text(double value);

}  // namespace gltfx

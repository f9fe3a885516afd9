// SPDX-License-Identifier: Apache-2.0
/// Whether two values of one document say the same.
#pragma once

#include "json/document.hpp"

namespace gltfx::json {

/// Numbers are compared by their exact value and sign, half surrogates as they are written, objects
/// whatever the order of their members (the last of those with one name counts). Where that is not
/// certain, values are different. Iterative; linear in both values. Both are values, or keys, of
/// `document`.
bool equal(const Document& document, NodeId one, NodeId other);

}  // namespace gltfx::json

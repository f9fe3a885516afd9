// SPDX-License-Identifier: Apache-2.0
/// Whether two values of one document are equal.
#pragma once

#include "json/document.hpp"

namespace gltfx::json {

/// Numbers are compared by their exact value and sign, half surrogates as they are written, objects
/// independent of the order of their members (the last of those with one name counts). Values whose
/// equality is not certain count as different. Iterative; linear in both values. Both are values,
/// or keys, of
/// `document`.
bool equal(const Document& document, NodeId one, NodeId other);

}  // namespace gltfx::json

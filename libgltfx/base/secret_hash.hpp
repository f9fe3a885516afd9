// SPDX-License-Identifier: Apache-2.0
/// A hash for contents from untrusted sources.
#pragma once

#include "base/hash.hpp"

namespace gltfx {

/// With a secret that is drawn at first use, one for the whole process.
const KeyedHash& secret_hash();

}  // namespace gltfx

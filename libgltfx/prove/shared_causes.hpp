// SPDX-License-Identifier: Apache-2.0
/// One edit of data that several objects use is one change.
#pragma once

#include "prove/changes.hpp"

namespace gltfx::prove {

/// Merges changes of the same elements of accessors, of primitives of the same data, and of data
/// that only one asset can read.
void merge_shared_causes(const Comparison& comparison);

}  // namespace gltfx::prove

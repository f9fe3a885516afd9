// SPDX-License-Identifier: Apache-2.0
/// How much a transform stretches lengths.
#pragma once

#include "model/node.hpp"

namespace gltfx::model {

/// The greatest length that a vector of length 1 gets: the greatest singular value of the linear
/// part. NaN or infinite if a column is.
double longest_axis(const Affine& transform);

}  // namespace gltfx::model

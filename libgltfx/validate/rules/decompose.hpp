// SPDX-License-Identifier: Apache-2.0
/// Whether a matrix is a translation after a rotation after a scale.
#pragma once

#include <array>
#include <string_view>

namespace gltfx::validate {

/// Empty when the matrix can be taken apart, otherwise what it does instead, to follow "The
/// matrix": "shears: ...". Column-major, single precision as everywhere in glTF. The test is the
/// one that is in use in the field (taken apart and put together again, its norm changes by less
/// than 0.00005), which lets some sheared matrices pass; `strictly` asks for columns at right
/// angles, too.
std::string_view why_not_decomposable(const std::array<float, 16>& matrix, bool strictly);

}  // namespace gltfx::validate

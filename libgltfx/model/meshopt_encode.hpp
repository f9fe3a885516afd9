// SPDX-License-Identifier: Apache-2.0
/// Makes meshoptimizer streams that every reader of EXT_meshopt_compression supports: attributes in
/// version 0, triangles and indices in version 1, without filters.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "model/meshopt.hpp"

namespace gltfx::model::meshopt {

/// The stream of `elements`, whose bytes are little-endian numbers as in the asset. It is checked
/// by decoding: attributes and indices are equal bit for bit, triangles keep their order and
/// winding, but may begin at another corner. Nothing if the layout is invalid, has a filter or does
/// not match the elements, or if an index is not preserved: for triangles, the library supports
/// only indices below 0xffffffff.
std::optional<std::vector<std::byte>> encode(std::span<const std::byte> elements,
                                             const Layout& layout);

}  // namespace gltfx::model::meshopt

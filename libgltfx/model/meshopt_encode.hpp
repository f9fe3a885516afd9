// SPDX-License-Identifier: Apache-2.0
/// Makes streams of meshoptimizer that every reader of EXT_meshopt_compression takes: attributes in
/// version 0, triangles and indices in version 1, without filters.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "model/meshopt.hpp"

namespace gltfx::model::meshopt {

/// The stream of `elements`, whose bytes are little-endian numbers as in the asset. It has been
/// decoded again: attributes and indices come back bit for bit, triangles in their order and
/// winding, though one may begin with another corner. Nothing when the layout is not sound, has a
/// filter or is not that of the elements, or when an index does not come back: the library takes
/// only triangles of indices below 0xffffffff.
std::optional<std::vector<std::byte>> encode(std::span<const std::byte> elements,
                                             const Layout& layout);

}  // namespace gltfx::model::meshopt

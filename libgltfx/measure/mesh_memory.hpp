// SPDX-License-Identifier: Apache-2.0
/// Memory of the graphics card that meshes take.
#pragma once

#include <cstdint>

#include "measure/source.hpp"

namespace gltfx::measure {

/// The bytes of all accessors that primitives read, decompressed, each accessor once.
std::uint64_t mesh_memory(const Source& source);

}  // namespace gltfx::measure

// SPDX-License-Identifier: Apache-2.0
/// A mesh on its way to the encoder, and the comparison with what comes back.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codec/client.hpp"

namespace gltfx::codec {

/// Why a mesh cannot be encoded, as one sentence; empty when it can.
std::string find_flaw(const DracoMesh& mesh);

/// A mesh without flaws as one payload.
std::vector<std::byte> pack(const DracoMesh& mesh);
/// The mesh in a payload, with spans into it. Nothing when they do not fit together.
std::optional<DracoMesh> unpack(std::span<const std::byte> payload);

/// Whether two meshes without flaws have the same triangles, each as often: equal values of all
/// attributes, told by their ids, bit for bit, in the same winding. The order of points and of
/// triangles, and the corner that a triangle begins with, do not matter.
bool have_same_triangles(const DracoMesh& a, const DracoMesh& b);

}  // namespace gltfx::codec

// SPDX-License-Identifier: Apache-2.0
/// Packs a mesh for the encoder, and compares it with the decoded result.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "codec/client.hpp"

namespace gltfx::codec {

/// Why a mesh cannot be encoded, as one sentence; empty: it can.
std::string find_flaw(const DracoMesh& mesh);

/// A mesh without flaws as one payload.
std::vector<std::byte> pack(const DracoMesh& mesh);
/// The mesh in a payload, with spans into it. Nothing if the payload is inconsistent.
std::optional<DracoMesh> unpack(std::span<const std::byte> payload);

/// Whether two meshes without flaws have the same triangles, with the same number of repetitions:
/// all attributes, matched by id, have equal values bit for bit, in the same winding. The order of
/// points and of triangles, and the first corner of a triangle, do not matter.
bool have_same_triangles(const DracoMesh& a, const DracoMesh& b);

}  // namespace gltfx::codec

// SPDX-License-Identifier: Apache-2.0
/// Triangles and their shared vertices and edges.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/mesh.hpp"
#include "rules/payload/phases.hpp"

namespace gltfx::validate {

using Indices = std::vector<std::uint32_t>;
/// The vertices of its corners, in the order of specification section 3.7.2.1.
using Triangle = std::array<std::uint32_t, 3>;

/// The numbers of an accessor of unsigned scalars. Nothing if it has another format, no readable
/// bytes of its own, or exceeds the budget of the phase.
std::optional<Indices> read_indices(DataPhase& phase, std::uint32_t accessor);

/// The triangles of a primitive, with or without indices; nothing if it has none, or as above.
std::optional<std::vector<Triangle>> read_triangles(DataPhase& phase,
                                                    const model::Primitive& primitive);

/// Triangles of a list, strip or fan over `indices`; none for other modes.
std::vector<Triangle> triangles_of(model::Mode mode, const Indices& indices);

/// Two vertices, in any order.
constexpr std::uint64_t edge_of(std::uint32_t a, std::uint32_t b) {
  return a < b ? std::uint64_t{a} << 32U | b : std::uint64_t{b} << 32U | a;
}

/// The edges of triangles, sorted, each once. Edges of length 0 are omitted.
std::vector<std::uint64_t> edges_of(const std::vector<Triangle>& triangles);

/// By vertex: the first vertex at the same position, of an accessor of three floats. Nothing as for
/// read_indices().
std::optional<Indices> first_at_position(DataPhase& phase, std::uint32_t accessor);

/// Likewise for positions that differ only by the error of single precision: some four millionths
/// of the extent.
std::optional<Indices> first_near_position(DataPhase& phase, std::uint32_t accessor);

}  // namespace gltfx::validate

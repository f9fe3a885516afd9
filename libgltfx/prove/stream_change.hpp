// SPDX-License-Identifier: Apache-2.0
/// Puts the distances of vertices into words.
#pragma once

#include <cstdint>
#include <string>

#include "prove/changes.hpp"
#include "prove/soup_pair.hpp"

namespace gltfx::prove {

/// "3 triangles"; of one corner points, of two lines.
std::string counted_elements(std::uint64_t count, unsigned arity);

/// The bound of a stream, in the units of a StreamDistance.
double limit_of(const Comparison& comparison, const SoupStream& stream, double scale);

/// Kind, level, sentence and measure of a change of one stream. `scale`: from the space of the soup
/// to that of the scene.
Change describe_stream(const Comparison& comparison, const StreamDistance& distance, unsigned arity,
                       double scale);

}  // namespace gltfx::prove

// SPDX-License-Identifier: Apache-2.0
/// Compares two sets of triangles, lines or points.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "prove/soup.hpp"

namespace gltfx::prove {

/// Distances up to which elements belong together; all in the units of the soup.
struct SoupScale {
  double position = 0;         ///< of POSITION
  double texels = 1;           ///< of the largest image, for texture coordinates
  double facing = 0;           ///< degrees between faces that are shaded flat
  std::vector<double> limits;  ///< by stream, as StreamDistance::greatest
};

/// The distance of one stream in two rows, as StreamDistance::greatest.
double stream_distance(const SoupStream& stream, const double* a, const double* b,
                       const SoupScale& scale);

/// The greatest distance of a stream.
struct StreamDistance {
  const SoupStream* stream = nullptr;  ///< of the first soup
  double greatest = 0;  ///< position: in the space of the soup; degrees; texels; plain numbers
  std::uint64_t elements = 0;  ///< how many differ
  std::size_t first = 0;       ///< the first of them, in the first soup
  bool mirrored = false;       ///< texture coordinates: v is 1 - v everywhere
};

struct SoupDifference {
  std::vector<StreamDistance> distances;  ///< above 0 only
  std::uint64_t fewer = 0, more = 0;      ///< elements without a counterpart
  bool reversed = false;                  ///< all others have the other winding
  bool unseen = false;                    ///< no element of both shows anything
  /// Elements without a counterpart, and those with one in about their place that is not within
  /// limits.
  std::vector<std::uint32_t> left, their_left;
  std::vector<StreamDistance> near;  ///< of all other elements, above 0 only
  bool same() const { return distances.empty() && fewer == 0 && more == 0 && !reversed; }
};

/// Preconditions: equal streams and arity. Elements are paired in order if their lists agree, else
/// by the attributes that are equal, else by place. n log n.
SoupDifference compare_soups(const Soup& ours, const Soup& theirs, const SoupScale& scale);

}  // namespace gltfx::prove

// SPDX-License-Identifier: Apache-2.0
/// Two primitives, opened to be compared.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/geometry.hpp"
#include "prove/column.hpp"
#include "prove/differences.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// An attribute that both have, of the primitives or of a morph target.
struct Stream {
  std::string name;  ///< as in messages: "POSITION", "NORMAL of target 2"
  model::SemanticKind kind = model::SemanticKind::invalid;
  bool of_target = false;              ///< values are added to others
  json::NodeId value = json::kNoNode;  ///< in `before`
  Column ours, theirs;                 ///< with as many components
  std::string quantity() const;        ///< for Measured
  unsigned components() const { return ours.components(); }
};

/// What one of the two draws: vertices by the corners of its triangles, segments or points.
struct Corners {
  model::Mode mode = model::Mode::triangles;
  std::vector<std::uint32_t> indices;  ///< of any value; all vertices in a row where there are none
  std::uint64_t vertices = 0;          ///< so many can be read
  std::uint32_t restart = UINT32_MAX;  ///< the index that begins anew

  /// The same corners as a list of triangles, segments or points without a repeated vertex.
  std::vector<std::uint32_t> assembled() const;
  /// Vertices of an element of assembled().
  std::size_t arity() const;
};

struct PrimitivePair {
  std::vector<Stream> streams;  ///< in the order of names
  Corners ours, theirs;
};

/// Opens what can be read. What only one has, or cannot be read in `after`, is told; nothing where
/// there is no more to compare. `ours`, `theirs`: objects of primitives.
std::optional<PrimitivePair> open_pair(const Side& before, const Side& after, json::NodeId ours,
                                       json::NodeId theirs, Differences& found);

}  // namespace gltfx::prove

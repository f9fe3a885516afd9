// SPDX-License-Identifier: Apache-2.0
/// Two primitives, opened for comparison.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/geometry.hpp"
#include "prove/column.hpp"
#include "prove/differences.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// An attribute of both primitives, or of the same morph target of both.
struct Stream {
  std::string name;  ///< as in messages: "POSITION", "NORMAL of target 2"
  model::SemanticKind kind = model::SemanticKind::invalid;
  bool of_target = false;              ///< values are added to other values
  json::NodeId value = json::kNoNode;  ///< in `before`
  Column ours, theirs;                 ///< with equal numbers of components
  std::string quantity() const;        ///< for Measured
  unsigned components() const { return ours.components(); }
};

/// The shapes that one of the two draws: vertices by the corners of its triangles, segments or
/// points.
struct Corners {
  model::Mode mode = model::Mode::triangles;
  std::vector<std::uint32_t> indices;  ///< with any values; without indices: all vertices in order
  std::uint64_t vertices = 0;          ///< number of readable vertices
  std::uint32_t restart = UINT32_MAX;  ///< the index that restarts a strip

  /// The same corners as a list of triangles, segments or points without a repeated vertex.
  std::vector<std::uint32_t> assembled() const;
  /// Number of vertices of an element of assembled().
  std::size_t arity() const;
};

struct PrimitivePair {
  std::vector<Stream> streams;  ///< sorted by name
  Corners ours, theirs;
};

/// Attributes by name; of those with one name the last.
std::map<std::string_view, const model::Attribute*> by_name(
    const std::vector<model::Attribute>& attributes);

/// What a primitive draws, by the numbers of what it refers to.
std::string storage_key(const Side& side, json::NodeId primitive);

/// Opens what can be read. What only one has, or cannot be read in `after`, is told; nothing where
/// there is no more to compare. `ours`, `theirs`: objects of primitives.
std::optional<PrimitivePair> open_pair(const Side& before, const Side& after, json::NodeId ours,
                                       json::NodeId theirs, Differences& found);

}  // namespace gltfx::prove

// SPDX-License-Identifier: Apache-2.0
/// Triangles, lines or points with all values of their corners, independent of how a primitive
/// stores them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "model/mesh.hpp"
#include "model/node.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// An attribute, or an attribute of a morph target. Joints and weights of a vertex are one stream
/// of pairs (joint, weight), sorted by joint, without those of weight 0.
struct SoupStream {
  std::string name;  ///< "POSITION", "NORMAL of target 2", "WEIGHTS_0"
  model::SemanticKind kind = model::SemanticKind::invalid;
  std::uint64_t set = 0;
  bool of_target = false;
  unsigned offset = 0;  ///< of its first number in a row
  unsigned width = 0;
  json::NodeId value = json::kNoNode;  ///< the index in the text
  /// Of joints, of weights that are pairs with them; kNoNode: they are plain numbers.
  json::NodeId joints = json::kNoNode;
};

struct Soup {
  std::vector<SoupStream> streams;  ///< sorted by name
  unsigned width = 0;               ///< numbers of a row
  unsigned arity = 3;               ///< corners of an element
  std::vector<double> rows;         ///< by vertex
  std::vector<std::uint32_t> corners;
  /// Whether all of the primitive could be read.
  bool readable = true;
  /// The index of the first accessor that cannot be read, in the text; kNoNode: another reason.
  json::NodeId unread = json::kNoNode;

  std::size_t vertices() const { return width == 0 ? 0 : rows.size() / width; }
  std::size_t elements() const { return corners.size() / arity; }
  const double* row(std::uint32_t vertex) const {
    return rows.data() + std::size_t{vertex} * width;
  }
  const SoupStream* find(model::SemanticKind kind) const;
};

/// Reads a primitive. `joints`: the numbers that stand for the joints of its skin; a joint that is
/// not among them stands for itself.
Soup read_soup(const Side& side, json::NodeId primitive, const std::vector<double>& joints);

/// Where a surface is placed; `turn` places its normals and tangents.
void place_soup(Soup& soup, const model::Affine& place, const model::Affine& turn);

/// A soup with other streams, which all have the same names in `from`; rows are padded with the
/// values that missing numbers mean: ones for colors of vertices, otherwise zeros.
void append_soup(Soup& to, const Soup& from);

/// By element: equal for equal corners in any turn (lines in any direction). Zeros: two corners are
/// equal, so that it shows nothing. `without`: a stream that does not count, or null; `reversed`:
/// of the other winding.
std::vector<Hash128> hash_elements(const Soup& soup, const SoupStream* without = nullptr,
                                   bool reversed = false);

/// Of all elements that show something, in their order, after those of `before`.
Hash128 hash_order(const Soup& soup, Hash128 before);

/// Of the streams, and of all elements that show something, in any order; where none does, of the
/// different vertices.
Hash128 hash_soup(const Soup& soup);

}  // namespace gltfx::prove

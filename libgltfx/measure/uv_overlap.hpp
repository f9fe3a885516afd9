// SPDX-License-Identifier: Apache-2.0
/// Triangles that share area in the plane of texture coordinates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "measure/box_tree.hpp"
#include "measure/uv_cover.hpp"
#include "measure/uv_plane.hpp"

namespace gltfx::measure {

/// Whether two triangles share area: by more than kUvNoise along the normals of all six edges.
bool share_area(const UvTriangle& one, const UvTriangle& other);

/// Finds the triangles that share area with another one. Takes time n log n for surfaces that
/// people make; any other one runs out of a budget of work that is linear in n.
class UvOverlap {
 public:
  /// All triangles have an area and are finite.
  explicit UvOverlap(const UvSurface& sound);

  /// False: out of work. Call it first.
  bool find();
  /// The number of triangles that share area.
  std::size_t count() const { return triangles_.size() - alone_.back().front(); }
  /// The covered area; exact where nothing overlaps. Nothing: out of work.
  std::optional<UvCover> cover() const;

 private:
  std::size_t end_of(std::size_t leaf) const;
  void mark(std::size_t triangle);
  bool test(std::size_t one, std::size_t other);
  bool test_leaves(std::size_t one, std::size_t other);
  bool test_against_later(std::size_t leaf);

  BoxTree tree_;
  std::vector<UvTriangle> triangles_;  // in the order of the tree
  std::vector<UvBox> boxes_;           // as triangles_
  std::vector<std::uint8_t> shared_;   // as triangles_
  /// By level and node of the tree: triangles that share no area, as far as is known.
  std::vector<std::vector<std::uint32_t>> alone_;
  std::uint64_t pairs_left_, leaves_left_, nodes_left_;
};

}  // namespace gltfx::measure

// SPDX-License-Identifier: Apache-2.0
/// An animation at the moments that tell where it leads: its keyframes, and moments between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "model/geometry.hpp"
#include "model/keyframes.hpp"

namespace gltfx::model {

/// Not thread-safe: transforms are kept when they are first asked for.
class ClipMoments {
 public:
  static constexpr std::size_t kMost = 4096;

  /// Keeps a reference to the source. `budget`: memory for transforms; others are computed each
  /// time.
  ClipMoments(const GeometrySource& source, const schema::Set& schemas, std::uint32_t animation,
              MemoryBudget& budget);

  std::uint32_t animation() const { return animation_; }
  /// Seconds, in order, at most kMost. Empty: it moves no node and no morph target.
  const std::vector<double>& times() const { return times_; }
  bool moves(NodeIndex node) const { return moved_.count(node) > 0; }
  /// Precondition: moves().
  Affine transform(NodeIndex node, std::size_t moment);
  Affine transform_at(NodeIndex node, double time) const;
  /// Whether it changes the weights of the morph targets of a node with a mesh.
  bool morphs(NodeIndex node, std::uint32_t mesh) const;
  /// What morph_weights() takes for the node.
  AnimatedValues weights_at(NodeIndex node, std::uint32_t mesh, double time) const;

 private:
  struct Parts {
    std::array<float, 3> translation;
    std::array<float, 4> rotation;
    std::array<float, 3> scale;
  };
  /// A node, and the channels that move it.
  struct Moved {
    std::optional<std::size_t> translation, rotation, scale;
    Parts stored{};
    Vector3 exact{};           ///< the translation as it is written
    std::vector<Parts> known;  ///< by moment; empty: not kept
    bool tried = false;
  };

  void add_channel(std::size_t channel);
  bool is_read(std::size_t channel) const;
  void find_times();
  void add_times(const ClipChannel& channel, std::uint64_t& steps);
  Parts parts_at(const Moved& moved, double time) const;
  static Affine affine_of(const Moved& moved, const Parts& parts);

  const GeometrySource& source_;
  std::uint32_t animation_;
  MemoryBudget& budget_;
  std::vector<ClipChannel> channels_;
  std::unordered_map<NodeIndex, Moved> moved_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> weights_;  ///< channels by owner
  std::vector<double> times_;
};

}  // namespace gltfx::model

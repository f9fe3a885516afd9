// SPDX-License-Identifier: Apache-2.0
/// What bounding volumes of nodes enclose, and what they miss (glTF 2.1, "Bounding volumes"): the
/// geometry of the node and of those below it, at rest and while animations play.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "model/point_blocks.hpp"
#include "model/shape.hpp"
#include "schema/set.hpp"

namespace gltfx::model {

/// A vertex against a volume.
struct VolumeMiss {
  double distance = 0;  ///< to the volume, in the space of its node; negative: inside
  NodeIndex node = 0;   ///< that draws the vertex
  PointBlocks::Origin vertex;
  std::optional<std::uint32_t> animation;  ///< absent: at rest
  double time = 0;                         ///< of the animation, seconds
  double reach = 0;                        ///< distance of the vertex from the origin of the node
};

/// What a volume misses.
struct VolumeVerdict {
  NodeIndex node = 0;
  bool complete = true;  ///< false: some geometry or moments could not be looked at
  bool moves = false;    ///< an animation moves geometry against the volume
  VolumeMiss at_rest;    ///< the vertex that is farthest outside, likewise of all moments
  VolumeMiss greatest;
};

/// Positions are rounded. A vertex within this distance of the volume is not outside of it.
double tolerance_of(const BoundingVolume& volume, const VolumeMiss& miss);

/// A volume that encloses all.
struct FittedVolume {
  Vector3 half{};    ///< as BoundingVolume::half
  Vector3 center{};  ///< likewise
};

/// Meshes that are part of the asset in another way, as points in the space of a node: those of
/// external assets.
class MorePoints {
 public:
  virtual ~MorePoints() = default;
  /// Null: there are none. Sets `complete` to false if there are some that cannot be read.
  virtual const PointBlocks* of(NodeIndex node, bool& complete) = 0;
};

class VolumeContents {
 public:
  /// Keeps references; `more` may be null. Precondition: nodes are a forest.
  VolumeContents(const GeometrySource& source, const schema::Set& schemas, MorePoints* more);
  ~VolumeContents();

  const std::vector<std::optional<BoundingVolume>>& volumes() const { return volumes_; }
  /// Of all volumes, in the order of nodes. The work for all is limited: verdicts may be
  /// incomplete.
  std::vector<VolumeVerdict> judge();
  /// A volume of the same kind and rotation around all that the volume of a node should enclose;
  /// nothing: not all of that could be looked at. `poses`: also while animations play.
  std::optional<FittedVolume> fit(NodeIndex node, bool poses);

 private:
  struct Shared;
  class Search;
  Shared& shared();

  const GeometrySource& source_;
  const schema::Set& schemas_;
  MorePoints* more_;
  std::vector<std::optional<BoundingVolume>> volumes_;  ///< by node
  std::unique_ptr<Shared> shared_;
};

}  // namespace gltfx::model

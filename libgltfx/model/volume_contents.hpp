// SPDX-License-Identifier: Apache-2.0
/// What bounding volumes of nodes enclose, and what they miss (glTF 2.1, "Bounding volumes"): the
/// geometry of the node and of those below it, at rest and while animations play.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/point_blocks.hpp"
#include "model/shape.hpp"
#include "schema/set.hpp"

namespace gltfx::model {

class MorePoints;
class VolumeScopes;

/// An external asset below a node, or below another one there, that has animations.
struct MovingPart {
  const GeometrySource* source = nullptr;  ///< lives as long as the MorePoints
  Affine place;                            ///< of its scene in the space of the node, at rest
  std::span<const std::uint8_t> drawn;     ///< by node: it is in the scene
  MorePoints* more = nullptr;              ///< of its nodes
  std::string name;                        ///< of the asset
};

/// A vertex against a volume.
struct VolumeMiss {
  double distance = 0;  ///< to the volume, in the space of its node; negative: inside
  NodeIndex node = 0;   ///< that draws the vertex, or has the external asset that does
  PointBlocks::Origin vertex;
  std::optional<std::uint32_t> animation;  ///< absent: at rest
  const MovingPart* external = nullptr;    ///< that has the animation; null: the asset itself
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
/// external assets, at rest.
class MorePoints {
 public:
  virtual ~MorePoints() = default;
  /// Null: there are none. Sets `complete` to false if there are some that cannot be read.
  virtual const PointBlocks* of(NodeIndex node, bool& complete) = 0;
  /// Those among them that animations of their own move. The list stays where it is.
  virtual const std::vector<MovingPart>& moving(NodeIndex node) = 0;
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
  VolumeScopes& scopes();

  const GeometrySource& source_;
  const schema::Set& schemas_;
  MorePoints* more_;
  std::vector<std::optional<BoundingVolume>> volumes_;  ///< by node
  std::unique_ptr<VolumeScopes> scopes_;
};

}  // namespace gltfx::model

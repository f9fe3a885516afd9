// SPDX-License-Identifier: Apache-2.0
/// Positions of the corners of two primitives, and their distance when a skin moves them.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "model/pose.hpp"
#include "prove/side.hpp"

namespace gltfx::prove {

/// Positions of corresponding corners.
struct CornerList {
  std::vector<model::Vector3> here, there;
};

/// Joints and weights of the corners, all sets one after the other.
struct Influence {
  std::uint32_t joint = 0;
  double weight = 0;
};

/// The vertices of two primitives that corners use.
struct ComparedCorners {
  CornerList rest;
  CornerList moved;  ///< with all morph targets at 1; empty: there are none
  std::size_t sets = 0;
  std::vector<Influence> here, there;  ///< 4 * sets for each corner
};

/// Nothing: there is nothing to compare. Differences other than those of values are not told.
std::optional<ComparedCorners> read_corners(const Side& before, const Side& after,
                                            json::NodeId ours, json::NodeId theirs);

/// Both assets at one moment of an animation.
struct PosePair {
  model::Pose here, there;
};
/// At rest, and at moments of the first animations, if the asset has skins.
std::vector<PosePair> read_poses(const Side& before, const Side& after);

/// Matrices of the joints of a skin at one moment, before and after.
struct JointPair {
  std::vector<model::Affine> here, there;
};
JointPair read_joints(const Side& before, const Side& after,
                      const std::pair<std::uint32_t, std::uint32_t>& skins, const PosePair& pose);

/// The greatest distance of two corners in the space of the scene.
double farthest_skinned(const ComparedCorners& corners, const JointPair& joints);

}  // namespace gltfx::prove

// SPDX-License-Identifier: Apache-2.0
/// The bones of humanoid avatars.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/node.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

inline constexpr std::string_view kAvatar = "VRMC_vrm";
inline constexpr std::string_view kAvatarAnimation = "VRMC_vrm_animation";

struct HumanBone {
  std::string name;
  std::string place;                   ///< place of that index, below `humanBones`: "hips/node"
  json::NodeId value = json::kNoNode;  ///< the index of its node in the text
  model::NodeIndex node = 0;
};

/// The bones of `humanoid`.`humanBones` with a node; `extension` is the object with the humanoid.
/// Both forms are read: an object of bones, and the list of VRM 0.x.
std::vector<HumanBone> read_human_bones(const Context& context, json::NodeId extension);

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_pose.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "base/text.hpp"
#include "model/skin.hpp"

namespace gltfx {
namespace {

std::vector<bool> joints_of(const model::Asset& asset, const model::Views& views) {
  std::vector<bool> joints(views.nodes.size(), false);
  for (const json::NodeId object : asset.elements(model::RootArray::skins)) {
    if (object == json::kNoNode) continue;
    for (const model::NodeIndex joint : model::read_skin(asset, object).joint_nodes) {
      joints[joint] = true;
    }
  }
  return joints;
}

}  // namespace

std::optional<std::uint32_t> find_pose(const model::Asset& asset, const model::Views& views) {
  if (views.animations.empty() || asset.count(model::RootArray::skins) == 0) return std::nullopt;
  const std::vector<bool> joints = joints_of(asset, views);
  std::optional<std::uint32_t> first;
  for (std::uint32_t i = 0; i < views.animations.size(); ++i) {
    const model::Animation& animation = views.animations[i];
    const bool moves = std::any_of(animation.channels.begin(), animation.channels.end(),
                                   [&](const model::AnimationChannel& channel) {
                                     return channel.node && joints[*channel.node];
                                   });
    if (!moves) continue;
    const std::string name = lower_case(asset.name(animation.object));
    if (name.find("idle") != std::string::npos) return i;
    if (!first) first = i;
  }
  return first;
}

}  // namespace gltfx

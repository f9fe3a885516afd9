// SPDX-License-Identifier: Apache-2.0
#include "rules/shows/flat_nodes.hpp"

#include <algorithm>
#include <string_view>

#include "model/pose.hpp"

namespace gltfx::validate {

bool is_flat(const model::Affine& transform) {
  const auto& c = transform.columns;
  for (std::size_t i = 0; i < 3; ++i) {
    const model::Vector3 across = model::cross(c[i], c[(i + 1) % 3]);
    if (model::dot(across, across) > 0) return false;
  }
  return true;
}

bool may_change_scales(const Context& context) {
  for (const model::Animation& animation : context.views.animations) {
    for (const model::AnimationChannel& channel : animation.channels) {
      if (channel.path == model::AnimationPath::scale ||
          channel.path == model::AnimationPath::other) {
        return true;
      }
    }
  }
  const auto& used = context.checked.extensions_used;
  return std::any_of(used.begin(), used.end(), [](const auto& name) {
    return std::string_view(name) == "KHR_interactivity";
  });
}

std::optional<model::NodeIndex> FlatNodes::cause(model::NodeIndex node) {
  std::vector<model::NodeIndex> path;
  std::optional<model::NodeIndex> above;
  for (model::NodeIndex at = node; at != model::kNoNodeIndex; at = context_.graph.parent(at)) {
    if (known_[at].seen) {
      above = known_[at].cause;
      break;
    }
    known_[at].seen = true;  // a loop of parents ends here
    path.push_back(at);
  }
  for (auto at = path.rbegin(); at != path.rend(); ++at) {
    const model::Node& own = context_.views.nodes[*at];
    const bool scaled = own.scale != json::kNoNode || own.matrix != json::kNoNode;
    if (scaled && is_flat(model::stored_transform(context_.asset, own))) above = *at;
    known_[*at].cause = above;
  }
  return known_[node].cause;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/skin_scenes.hpp"

namespace gltfx::validate {

SkinScenes::SkinScenes(const model::Asset& asset, const model::SceneGraph& graph) {
  const auto& scenes = asset.elements(model::RootArray::scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto scene = static_cast<std::uint32_t>(i);
    model::for_each_index(asset, asset.document().find(scenes[i], "nodes"), model::RootArray::nodes,
                          [&](std::uint64_t, std::optional<std::uint32_t> node, Span) {
                            // A listed node that is no root is reported as such.
                            if (!node || !graph.is_root(*node)) return;
                            Scenes& list = scenes_[*node];
                            if (list.empty() || list.back() != scene) list.push_back(scene);
                          });
  }
}

const SkinScenes::Scenes& SkinScenes::scenes_of(model::NodeIndex root) const {
  static const Scenes kNone;
  const auto found = scenes_.find(root);
  return found == scenes_.end() ? kNone : found->second;
}

std::optional<std::uint32_t> SkinScenes::scene_without(model::NodeIndex root,
                                                       model::NodeIndex other) {
  if (root == other) return std::nullopt;
  const auto [known, fresh] =
      known_.try_emplace(std::uint64_t{root} << 32 | other, std::optional<std::uint32_t>());
  if (!fresh) return known->second;
  const Scenes& shown = scenes_of(other);
  auto at = shown.begin();
  for (const std::uint32_t scene : scenes_of(root)) {
    while (at != shown.end() && *at < scene) ++at;
    if (at == shown.end() || *at != scene) {
      known->second = scene;
      break;
    }
  }
  return known->second;
}

}  // namespace gltfx::validate

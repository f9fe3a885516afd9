// SPDX-License-Identifier: Apache-2.0
/// Which scenes show which trees.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "model/scene_graph.hpp"

namespace gltfx::validate {

/// The scenes that list each root. Not thread-safe: keeps its answers.
class SkinScenes {
 public:
  SkinScenes(const model::Asset& asset, const model::SceneGraph& graph);

  /// A scene that shows the tree below `root`, but not the one below `other`. Each pair is compared
  /// once, and up to the first difference.
  std::optional<std::uint32_t> scene_without(model::NodeIndex root, model::NodeIndex other);

 private:
  using Scenes = std::vector<std::uint32_t>;  // ascending

  const Scenes& scenes_of(model::NodeIndex root) const;

  std::unordered_map<model::NodeIndex, Scenes> scenes_;
  std::unordered_map<std::uint64_t, std::optional<std::uint32_t>> known_;
};

}  // namespace gltfx::validate

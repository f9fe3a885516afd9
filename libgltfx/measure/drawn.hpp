// SPDX-License-Identifier: Apache-2.0
/// What a scene draws.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "measure/source.hpp"
#include "model/node.hpp"

namespace gltfx::measure {

/// Memory for the transforms of the copies that a node draws.
inline constexpr std::uint64_t kInstanceBytes = std::uint64_t{1} << 28U;

/// The nodes of a scene, each once, in the order in which they are reached.
struct SceneNodes {
  std::vector<model::NodeIndex> all;
  std::vector<std::uint32_t> depths;  ///< as `all`; a root has 1
  std::vector<model::NodeIndex>
      drawn;  ///< visible nodes with a mesh, without lower levels of detail
};

/// Of the scene with that index. Linear in the nodes.
SceneNodes nodes_of_scene(const Source& source, std::uint32_t scene);

/// The number of copies of its mesh that a node draws; nothing: their transforms cannot be read.
std::optional<std::uint64_t> copies_of(const Source& source, model::NodeIndex node);

/// Bounds the work of measures that look at each scene: a file may list one node in many scenes.
class SceneWork {
 public:
  explicit SceneWork(const Source& source)
      : left_(kFewNodes + kScenesPerNode * source.views().nodes.size()) {}
  /// Whether another scene with so many nodes may be measured.
  bool take(std::uint64_t nodes) {
    if (nodes > left_) return false;
    left_ -= nodes;
    return true;
  }

 private:
  static constexpr std::uint64_t kFewNodes = 1'000'000, kScenesPerNode = 16;
  std::uint64_t left_;
};

}  // namespace gltfx::measure

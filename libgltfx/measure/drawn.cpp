// SPDX-License-Identifier: Apache-2.0
#include "measure/drawn.hpp"

#include <utility>

#include "model/fields.hpp"
#include "model/instancing.hpp"

namespace gltfx::measure {
namespace {

// The nodes that MSFT_lod lists as lower levels of others.
std::vector<bool> lower_levels(const Source& source) {
  const model::Asset& asset = source.asset();
  std::vector<bool> lower(source.views().nodes.size());
  for (const model::Node& node : source.views().nodes) {
    if (node.extensions == json::kNoNode) continue;
    const json::NodeId lod = model::extension_object(source.document(), node.object, "MSFT_lod");
    if (lod == json::kNoNode) continue;
    model::for_each_index(asset, source.document().find(lod, "ids"), model::RootArray::nodes,
                          [&](std::uint64_t, const auto& index, const Span&) {
                            if (index) lower[*index] = true;
                          });
  }
  return lower;
}

class SceneWalk {
 public:
  SceneWalk(const Source& source, std::uint32_t scene)
      : source_(source),
        pose_(source.pose(scene)),
        lower_(lower_levels(source)),
        reached_(source.views().nodes.size()) {
    for (const model::NodeIndex root :
         model::choose_scene(source.asset(), source.views(), scene).nodes) {
      enter(root, 1, true);
    }
  }

  SceneNodes run() {
    for (std::size_t next = 0; next < nodes_.all.size(); ++next) {
      const model::NodeIndex node = nodes_.all[next];
      const bool drawn = drawn_[next];
      const std::uint32_t depth = nodes_.depths[next];
      model::for_each_index(source_.asset(), source_.views().nodes[node].children,
                            model::RootArray::nodes,
                            [&](std::uint64_t, const auto& child, const Span&) {
                              if (child) enter(*child, depth + 1, drawn);
                            });
    }
    return std::move(nodes_);
  }

 private:
  void enter(model::NodeIndex node, std::uint32_t depth, bool drawn) {
    if (reached_[node]) return;
    reached_[node] = true;
    drawn = drawn && !lower_[node] && pose_.visible[node] != 0;
    nodes_.all.push_back(node);
    nodes_.depths.push_back(depth);
    drawn_.push_back(drawn);
    if (drawn && source_.views().nodes[node].mesh) nodes_.drawn.push_back(node);
  }

  const Source& source_;
  const model::Pose& pose_;
  const std::vector<bool> lower_;
  std::vector<bool> reached_;
  SceneNodes nodes_;
  std::vector<bool> drawn_;  // as nodes_.all
};

}  // namespace

SceneNodes nodes_of_scene(const Source& source, std::uint32_t scene) {
  return SceneWalk(source, scene).run();
}

std::optional<std::uint64_t> copies_of(const Source& source, model::NodeIndex node) {
  model::MemoryBudget budget(kInstanceBytes);
  const auto copies = model::read_instancing(source.asset(), source.views(), source.resources(),
                                             source.views().nodes[node], budget);
  if (!copies) return 1;
  if (!copies->readable) return std::nullopt;
  return copies->transforms.size();
}

}  // namespace gltfx::measure

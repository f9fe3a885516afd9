// SPDX-License-Identifier: Apache-2.0
// Scenes: lists of roots (specification section 3.5.1).
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/node.hpp"
#include "model/scene_graph.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {
namespace {

void check_scene(const Context& context, json::NodeId scene, const Path& path) {
  const Path list(path, "nodes");
  const auto check = [&](std::uint64_t position, std::optional<std::uint32_t> node, Span span) {
    report_references(context, span);
    if (!node || context.graph.is_root(*node)) return;
    report_link(
        context, Path(list, position), span, Code::SCENE_NON_ROOT_NODE,
        fmt::format("Scene {} lists {} as a root, but it is a child of {}.", path.index(),
                    object_label(context, model::RootArray::nodes, *node),
                    object_label(context, model::RootArray::nodes, context.graph.parent(*node))));
  };
  model::for_each_index(context.asset, context.document.find(scene, "nodes"),
                        model::RootArray::nodes, check);
}

void check_scenes(const Context& context) {
  const Path root;
  const Path list(root, "scenes");
  const auto& scenes = context.asset.elements(model::RootArray::scenes);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (scenes[i] != json::kNoNode) check_scene(context, scenes[i], Path(list, i));
  }
}

/// A list of roots is read once, regardless of the number of findings in it.
struct RootLists {
  explicit RootLists(Fixing& fixing) : graph(fixing.elements(), fixing.views().nodes) {}
  model::SceneGraph graph;
  std::map<json::NodeId, bool> done;  ///< whether children were removed from a list
};

// A node listed after its root is drawn below the root, once; a node listed before it would be
// drawn without its ancestors.
bool remove_children(Fixing& fixing, const model::SceneGraph& graph, json::NodeId list) {
  std::set<std::uint32_t> roots;
  std::string text = "[";
  bool drawn = true;
  model::for_each_index(fixing.elements(), list, model::RootArray::nodes,
                        [&](std::uint64_t, std::optional<std::uint32_t> node, Span span) {
                          if (node && !graph.is_root(*node)) {
                            drawn = drawn && roots.contains(graph.root(*node));
                            return;
                          }
                          if (node) roots.insert(*node);
                          if (text.size() > 1) text += ", ";
                          text += span.in(fixing.document().text());
                        });
  return drawn && fixing.replace(list, text + "]");
}

bool remove_child(Fixing& fixing, const Subject& child) {
  const json::NodeId list = child.node();
  if (fixing.document().kind(list) != json::Kind::number_array) return false;
  RootLists& lists = fixing.table<RootLists>();
  const auto [known, is_new] = lists.done.try_emplace(list, false);
  if (is_new) known->second = remove_children(fixing, lists.graph, list);
  return known->second;
}

}  // namespace

const RuleGroup& scene_rules() {
  static constexpr LinkRule kLinkRules[] = {check_scenes};
  static constexpr FixEntry kFixes[] = {{Code::SCENE_NON_ROOT_NODE, remove_child}};
  static constexpr RuleGroup group{.link_rules = kLinkRules, .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
// Scenes: lists of roots (specification section 3.5.1).
#include <fmt/format.h>

#include "model/scene_graph.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr RuleDescription kRules[] = {
    {"SCENE_NON_ROOT_NODE", Severity::error, "A scene lists a node that has a parent",
     "A scene shows whole trees. A node listed by itself would appear without its parents' "
     "transforms, or twice.",
     "List the root of the tree instead, and not the node itself.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"children": [1]}, {"camera": 0}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"children": [1]}, {"camera": 0}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})",
     Fix::none, true},
};

void check_scene(const Context& context, json::NodeId scene, const Path& path) {
  const Path list(path, "nodes");
  const auto check = [&](std::uint64_t position, std::optional<std::uint32_t> node, Span span) {
    report_references(context, span);
    if (!node || context.graph.is_root(*node)) return;
    report_link(context, Path(list, position), span, "SCENE_NON_ROOT_NODE",
                fmt::format("Node {} is a child of node {}.", *node, context.graph.parent(*node)));
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

constexpr LinkRule kLinkRules[] = {check_scenes};

}  // namespace

const Family& scene_family() {
  static const Family family{"scene", kRules, {}, kLinkRules};
  return family;
}

}  // namespace gltfx::validate

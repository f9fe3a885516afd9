// SPDX-License-Identifier: Apache-2.0
// GODOT_single_root: an extension without objects whose name alone declares the form of the scene.
// This file is about that one extension and names it.
#include <algorithm>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/node.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kSingleRootExtension = "GODOT_single_root";

void report_missing(const Context& context, const Path& path, json::NodeId place,
                    std::string message) {
  report_link(context, path, place, Code::SINGLE_ROOT_MISSING, std::move(message));
}

// The problem of the only scene's list of nodes; empty: none.
std::string roots_error(const Context& context, json::NodeId list) {
  std::uint64_t count = 0;
  bool first = false;
  model::for_each_index(context.asset, list, model::RootArray::nodes,
                        [&](std::uint64_t, std::optional<std::uint32_t> node, Span) {
                          first = first || node == 0U;
                          ++count;
                        });
  if (count != 1)
    return fmt::format("The scene has {} roots; its only root must be node 0.", count);
  return first ? std::string() : "The root of the scene is not node 0.";
}

void check_single_root(const Context& context) {
  const auto& used = context.checked.extensions_used;
  if (std::find(used.begin(), used.end(), kSingleRootExtension) == used.end()) return;
  const json::Document& document = context.document;
  const Path root;
  const Path scenes(root, "scenes");
  const auto& objects = context.asset.elements(model::RootArray::scenes);
  const json::NodeId scene = document.find(document.root(), "scene");
  if (objects.size() != 1 || objects.front() == json::kNoNode) {
    report_missing(context, scenes, document.find(document.root(), "scenes"),
                   fmt::format("The asset has {} scenes; it must have one.", objects.size()));
    return;
  }
  if (scene == json::kNoNode) {
    report_missing(context, Path(root, "scene"), document.root(),
                   "'scene' is missing; it must be 0.");
  }
  const Path only(scenes, 0);
  const json::NodeId list = document.find(objects.front(), "nodes");
  const std::string error = roots_error(context, list);
  if (!error.empty()) {
    report_missing(context, Path(only, "nodes"), list != json::kNoNode ? list : objects.front(),
                   error);
    return;
  }
  const model::Node& node = context.views.nodes.front();
  if (model::read_transform(document, node).is_identity()) return;
  const Path nodes(root, "nodes");
  report_link(context, Path(nodes, 0), node.object, Code::SINGLE_ROOT_TRANSFORM,
              "Node 0, the single root, has a transform.");
}

}  // namespace

const RuleGroup& single_root_rules() {
  static constexpr LinkRule kLinkRules[] = {check_single_root};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

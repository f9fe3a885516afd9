// SPDX-License-Identifier: Apache-2.0
// VRMC_node_constraint: a node follows another one. Finding a cycle needs the whole graph; this
// file is about that one extension and names it.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/node.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kNodeConstraint = "VRMC_node_constraint";

// The object with the source: the first existing kind.
json::NodeId constraint_of(const Context& context, json::NodeId extension) {
  const json::NodeId constraint = model::object_member(context.document, extension, "constraint");
  for (const std::string_view kind : {"roll", "aim", "rotation"}) {
    const json::NodeId object = model::object_member(context.document, constraint, kind);
    if (object != json::kNoNode) return object;
  }
  return json::kNoNode;
}

// Each node follows at most one other: a walk from any node ends or returns to a visited node.
std::vector<bool> nodes_on_cycles(const std::vector<model::NodeIndex>& sources) {
  std::vector<bool> on_cycle(sources.size(), false);
  std::vector<std::size_t> walk_of(sources.size(), 0);  // 0: not visited
  for (std::size_t start = 0; start < sources.size(); ++start) {
    std::size_t at = start;
    while (at != model::kNoNodeIndex && walk_of[at] == 0) {
      walk_of[at] = start + 1;
      at = sources[at];
    }
    if (at == model::kNoNodeIndex || walk_of[at] != start + 1) continue;
    for (; !on_cycle[at]; at = sources[at]) on_cycle[at] = true;
  }
  return on_cycle;
}

void check_constraint_cycles(const Context& context) {
  if (!has_objects_of(context, kNodeConstraint)) return;
  std::vector<model::NodeIndex> sources(context.views.nodes.size(), model::kNoNodeIndex);
  for_each_extension(context, model::RootArray::nodes, kNodeConstraint,
                     [&](const ExtensionPlace& place, const Path&) {
                       const auto source = context.asset.index(constraint_of(context, place.object),
                                                               "source", model::RootArray::nodes);
                       if (source) sources[place.index] = *source;
                     });
  const std::vector<bool> on_cycle = nodes_on_cycles(sources);
  for_each_extension(
      context, model::RootArray::nodes, kNodeConstraint,
      [&](const ExtensionPlace& place, const Path& path) {
        if (!on_cycle[place.index]) return;
        const bool itself = sources[place.index] == place.index;
        const std::string node = object_label(context, model::RootArray::nodes, place.index);
        report_member(context.link_sink, context, path, place.object, "constraint",
                      Code::NODE_CONSTRAINT_CYCLE,
                      itself ? fmt::format("The constraint of {} follows the node itself.", node)
                             : fmt::format("The constraints of {} and of the nodes that it follows "
                                           "form a cycle.",
                                           node));
      });
}

}  // namespace

const RuleGroup& node_constraint_rules() {
  static constexpr LinkRule kLinkRules[] = {check_constraint_cycles};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
// Nodes and their morph weights, skins and children (specification sections 3.5 and 3.7.4).
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/node.hpp"
#include "model/skin.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

class NodeCheck {
 public:
  explicit NodeCheck(const Context& context)
      : context_(context),
        deformations_(
            model::read_deformations(context.views.meshes, context.version > schema::kVersion2)) {}

  void run() {
    const Path root;
    const Path list(root, "nodes");
    const auto& nodes = context_.views.nodes;
    const auto& overrides = context_.graph.overrides();
    auto next = overrides.begin();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Path path(list, i);
      if (nodes[i].object == json::kNoNode) continue;
      const model::Node& node = nodes[i];
      for (const json::NodeId value : {node.camera_value, node.skin_value, node.mesh_value}) {
        report_references(context_, value);
      }
      check(node, path);
      std::uint32_t reported = 0;  // references before this position in the text
      for (; next != overrides.end() && next->parent == i; ++next) {
        if (reported == 0) reported = context_.document.span(node.children).begin;
        report_references(context_,
                          Span{std::exchange(reported, next->span.begin), next->span.begin});
        report_override(*next, path);
      }
      report_references(context_, node.children);
    }
  }

 private:
  void check(const model::Node& node, const Path& path) {
    if (!node.mesh) return;
    const model::Deformation& mesh = deformations_[*node.mesh];
    if (!mesh.known) return;
    if (node.weights != json::kNoNode) check_weights(node, mesh, path);
    if (node.skin) {
      check_skinned(node, mesh, path);
    } else if (mesh.has_joints &&
               (node.skin_value == json::kNoNode || context_.deviations.broken_values_are_absent)) {
      report_link(context_, path, node.mesh_value, Code::NODE_SKINNED_MESH_WITHOUT_SKIN,
                  fmt::format("The node has no skin, but {} is skinned.", mesh_label(node)));
    }
  }

  std::string mesh_label(const model::Node& node) const {
    return object_label(context_, model::RootArray::meshes, *node.mesh);
  }

  void check_weights(const model::Node& node, const model::Deformation& mesh, const Path& path) {
    const json::Document& document = context_.document;
    if (document.kind(node.weights) != json::Kind::number_array) return;
    if (mesh.targets_are_broken && !context_.deviations.broken_values_are_absent) return;
    const std::size_t count = document.array_size(node.weights);
    if (count == mesh.morph_targets) return;
    report_link(context_, Path(path, "weights"), node.weights, Code::NODE_WEIGHTS_INVALID,
                fmt::format("The node has {} weight{}, but {} has {} morph target{}.", count,
                            count == 1 ? "" : "s", mesh_label(node), mesh.morph_targets,
                            mesh.morph_targets == 1 ? "" : "s"));
  }

  void check_skinned(const model::Node& node, const model::Deformation& mesh, const Path& path) {
    // Joints that exist but are not in order are reported at the mesh.
    const bool one_is_enough = context_.deviations.one_skinned_primitive_is_enough;
    if (one_is_enough ? mesh.has_joints : !mesh.has_rigid) return;
    report_link(context_, path, node.skin_value, Code::NODE_SKIN_WITH_NON_SKINNED_MESH,
                fmt::format("The node has {}, but {}{} has no JOINTS_0 and WEIGHTS_0.",
                            object_label(context_, model::RootArray::skins, *node.skin),
                            mesh.names_joints ? "a primitive of " : "", mesh_label(node)));
  }

  void report_override(const model::ParentOverride& found, const Path& parent) {
    // A child listed twice by one node is reported as a repeated element, and a loop is one error,
    // although it meets the tree above it.
    const bool reported = found.parent == found.previous || context_.graph.on_loop(found.child);
    if (reported && !context_.deviations.consequences_are_reported) return;
    const Path children(parent, "children");
    report_link(context_, Path(children, found.position), found.span, Code::NODE_PARENT_OVERRIDE,
                fmt::format("The node lists {} as a child, but it is already a child of {}.",
                            object_label(context_, model::RootArray::nodes, found.child),
                            object_label(context_, model::RootArray::nodes, found.previous)));
  }

  const Context& context_;
  std::vector<model::Deformation> deformations_;
};

void check_nodes(const Context& context) { NodeCheck(context).run(); }

}  // namespace

const RuleGroup& node_mesh_rules() {
  static constexpr LinkRule kLinkRules[] = {check_nodes};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

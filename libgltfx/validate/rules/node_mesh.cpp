// SPDX-License-Identifier: Apache-2.0
// Nodes and what hangs on them: morph weights, skins, children (specification sections 3.5 and
// 3.7.4).
#include <utility>

#include <fmt/format.h>

#include "model/node.hpp"
#include "model/skin.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGoodSkin =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"name": "joint"}], "skins": [{"joints": [1]}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}]})";

constexpr RuleDescription kRules[] = {
    {"NODE_PARENT_OVERRIDE", Severity::error, "A node is the child of two nodes",
     "The scene graph is a forest: a node with two parents has two places, and viewers show it "
     "at one of them.",
     "Keep it in one `children` list; copy the node where it is wanted twice.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"children": [2]}, {"children": [2]}, {"camera": 0}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"children": [2]}, {"children": [3]}, {"camera": 0}, {"camera": 0}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})",
     Fix::none, true},
    {"NODE_SKINNED_MESH_WITHOUT_SKIN", Severity::warning,
     "A mesh made to be skinned hangs on a node without a skin",
     "Its vertices name joints of a skin that is not there: the mesh stands still.",
     "Give the node the skin, or remove JOINTS_n and WEIGHTS_n from the mesh.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}]})",
     kGoodSkin, Fix::none, true},
    {"NODE_SKIN_WITH_NON_SKINNED_MESH", Severity::error,
     "A node has a skin, but its mesh has no joints",
     "A skin moves vertices by JOINTS_0 and WEIGHTS_0; without them there is nothing to move.",
     "Remove `skin`, or export the mesh with its joints and weights.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"name": "joint"}], "skins": [{"joints": [1]}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     kGoodSkin, Fix::none, true},
    {"NODE_WEIGHTS_INVALID", Severity::error,
     "A node has more or fewer morph weights than its mesh has targets",
     "Each weight belongs to one morph target, in their order.",
     "Give one weight for each morph target of the mesh.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "weights": [0.5, 1]}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "weights": [0.5]}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     Fix::none, true},
};

class NodeCheck {
 public:
  explicit NodeCheck(const Context& context)
      : context_(context), deformations_(model::read_deformations(context.views.meshes)) {}

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
      std::uint32_t told = 0;  // references before this place in the text
      for (; next != overrides.end() && next->parent == i; ++next) {
        if (told == 0) told = context_.document.span(node.children).begin;
        report_references(context_, Span{std::exchange(told, next->span.begin), next->span.begin});
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
    } else if (mesh.has_joints && (context_.khronos() || node.skin_value == json::kNoNode)) {
      report_link(context_, path, node.mesh_value, "NODE_SKINNED_MESH_WITHOUT_SKIN",
                  fmt::format("Mesh {} is bound to joints, but the node has no skin.", *node.mesh));
    }
  }

  void check_weights(const model::Node& node, const model::Deformation& mesh, const Path& path) {
    const json::Document& document = context_.document;
    if (document.kind(node.weights) != json::Kind::number_array) return;
    const std::size_t count = document.array_size(node.weights);
    if (count == mesh.morph_targets) return;
    report_link(context_, Path(path, "weights"), node.weights, "NODE_WEIGHTS_INVALID",
                fmt::format("The node has {} weight{}, mesh {} has {} morph target{}.", count,
                            count == 1 ? "" : "s", *node.mesh, mesh.morph_targets,
                            mesh.morph_targets == 1 ? "" : "s"));
  }

  void check_skinned(const model::Node& node, const model::Deformation& mesh, const Path& path) {
    // Joints that are there but not in order are reported at the mesh.
    if (mesh.has_joints || (mesh.names_joints && !context_.khronos())) return;
    report_link(context_, path, node.skin_value, "NODE_SKIN_WITH_NON_SKINNED_MESH",
                fmt::format("The node has skin {}, but mesh {} has neither JOINTS_0 nor "
                            "WEIGHTS_0.",
                            *node.skin, *node.mesh));
  }

  void report_override(const model::ParentOverride& found, const Path& parent) {
    // A child listed twice by one node is reported as a repeated element.
    if (found.parent == found.previous && !context_.khronos()) return;
    // Nor is a loop two faults, one of which is that it meets the tree above it.
    if (context_.graph.on_loop(found.child) && !context_.khronos()) return;
    const Path children(parent, "children");
    report_link(context_, Path(children, found.position), found.span, "NODE_PARENT_OVERRIDE",
                fmt::format("Node {} is a child of node {} already.", found.child, found.previous));
  }

  const Context& context_;
  std::vector<model::Deformation> deformations_;
};

void check_nodes(const Context& context) { NodeCheck(context).run(); }

constexpr LinkRule kLinkRules[] = {check_nodes};

}  // namespace

const Family& node_mesh_family() {
  static const Family family{"node_mesh", kRules, {}, kLinkRules};
  return family;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
// Rigid bodies and vehicles: parts that must be below the node they belong to, and joints, gravity
// and shapes that depend on other nodes or meshes. The checks need the whole graph.
#include <optional>
#include <unordered_map>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/mesh.hpp"
#include "model/node.hpp"
#include "model/scene_graph.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kBody = "OMI_physics_body";
constexpr std::string_view kRigidBodies = "KHR_physics_rigid_bodies";
constexpr std::string_view kBodies[] = {kBody, kRigidBodies};
constexpr std::string_view kVehicle = "OMI_vehicle_body";
constexpr std::string_view kVehicleParts[] = {"OMI_vehicle_wheel", "OMI_vehicle_thruster",
                                              "OMI_vehicle_hover_thruster"};

// The triggers that a compound trigger consists of.
void check_trigger_parts(const Context& context) {
  for (const std::string_view extension : kBodies) {
    if (!has_objects_of(context, extension)) continue;
    const model::Ancestry ancestry(context.graph);
    for_each_extension(
        context, model::RootArray::nodes, extension,
        [&](const ExtensionPlace& place, const Path& path) {
          const auto host = static_cast<model::NodeIndex>(place.index);
          const json::NodeId trigger =
              model::object_member(context.document, place.object, "trigger");
          const Path at(path, "trigger");
          const Path list(at, "nodes");
          model::for_each_index(
              context.asset, context.document.find(trigger, "nodes"), model::RootArray::nodes,
              [&](std::uint64_t position, std::optional<std::uint32_t> node, Span span) {
                const bool below =
                    node && *node != host && ancestry.is_ancestor_or_self(host, *node);
                if (!node || below) return;
                report_link(context, Path(list, position), span, Code::BODY_PART_NOT_BELOW,
                            fmt::format("The trigger includes {}, which is not below {}.",
                                        object_label(context, model::RootArray::nodes, *node),
                                        object_label(context, model::RootArray::nodes, host)));
              });
        });
  }
}

using NodeMarks = std::vector<bool>;

// Nodes below a marked node.
NodeMarks below(const Context& context, const NodeMarks& marked) {
  const std::size_t count = context.graph.size();
  NodeMarks found(count, false);
  NodeMarks known(count, false);
  std::vector<model::NodeIndex> way;
  for (model::NodeIndex start = 0; start < count; ++start) {
    for (model::NodeIndex at = start; at != model::kNoNodeIndex && !known[at];
         at = context.graph.parent(at)) {
      known[at] = true;
      way.push_back(at);
    }
    for (; !way.empty(); way.pop_back()) {
      const model::NodeIndex parent = context.graph.parent(way.back());
      if (parent != model::kNoNodeIndex) found[way.back()] = marked[parent] || found[parent];
    }
  }
  return found;
}

// Nodes whose object of the extension satisfies the predicate.
template <typename Predicate>
NodeMarks nodes_with(const Context& context, std::string_view extension, Predicate is_one) {
  NodeMarks marks(context.graph.size(), false);
  for_each_extension(
      context, model::RootArray::nodes, extension,
      [&](const ExtensionPlace& place, const Path&) { marks[place.index] = is_one(place.object); });
  return marks;
}

// The same nodes and their descendants.
template <typename Predicate>
NodeMarks parts_of(const Context& context, std::string_view extension, Predicate is_one) {
  NodeMarks marks = nodes_with(context, extension, is_one);
  const NodeMarks under = below(context, marks);
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = marks[i] || under[i];
  return marks;
}

std::string node_label(const Context& context, std::size_t node) {
  return object_label(context, model::RootArray::nodes, node);
}

void check_vehicle_parts(const Context& context) {
  NodeMarks under;
  for (const std::string_view part : kVehicleParts) {
    for_each_extension(
        context, model::RootArray::nodes, part, [&](const ExtensionPlace& place, const Path& path) {
          if (under.empty()) {
            under =
                below(context, nodes_with(context, kVehicle, [](json::NodeId) { return true; }));
          }
          if (under[place.index]) return;
          report_link(
              context, path, place.object, Code::BODY_PART_NOT_BELOW,
              fmt::format("No node above {} has {}.", node_label(context, place.index), kVehicle));
        });
  }
}

void check_joints(const Context& context) {
  constexpr std::string_view kJoint = "OMI_physics_joint";
  if (!has_objects_of(context, kJoint)) return;
  const json::Document& document = context.document;
  const auto type_of = [&](json::NodeId body) {
    return model::string_member(document, model::object_member(document, body, "motion"), "type");
  };
  const NodeMarks moved =
      parts_of(context, kBody, [&](json::NodeId body) { return type_of(body) == "dynamic"; });
  const NodeMarks bodies =
      parts_of(context, kBody, [&](json::NodeId body) { return !type_of(body).empty(); });
  for_each_extension(
      context, model::RootArray::nodes, kJoint, [&](const ExtensionPlace& place, const Path& path) {
        if (!moved[place.index]) {
          report_link(
              context, path, place.object, Code::JOINT_WITHOUT_BODY,
              fmt::format("No node above {} is a dynamic body.", node_label(context, place.index)));
        }
        const auto other =
            context.asset.index(place.object, "connectedNode", model::RootArray::nodes);
        if (!other || bodies[*other]) return;
        report_member(context.link_sink, context, path, place.object, "connectedNode",
                      Code::JOINT_WITHOUT_BODY,
                      fmt::format("The joint is connected to {}, and no node above that is a body.",
                                  node_label(context, *other)));
      });
}

// Joints of KHR_physics_rigid_bodies may connect one static side, but not two.
void check_joint_motions(const Context& context) {
  if (!has_objects_of(context, kRigidBodies)) return;
  const json::Document& document = context.document;
  const NodeMarks moved = parts_of(context, kRigidBodies, [&](json::NodeId body) {
    return model::object_member(document, body, "motion") != json::kNoNode;
  });
  for_each_extension(
      context, model::RootArray::nodes, kRigidBodies,
      [&](const ExtensionPlace& place, const Path& path) {
        const json::NodeId joint = model::object_member(document, place.object, "joint");
        const auto other = context.asset.index(joint, "connectedNode", model::RootArray::nodes);
        if (!other || moved[place.index] || moved[*other]) return;
        Finding finding =
            finding_on(context, joint, Code::JOINT_WITHOUT_BODY,
                       fmt::format("The joint has no effect: no node at or above {} and {} has a "
                                   "motion.",
                                   node_label(context, place.index), node_label(context, *other)));
        finding.severity = Severity::warning;
        context.link_sink.report(Path(path, "joint"), std::move(finding));
      });
}

// The reason why a node is invalid for gravity; empty: it is valid.
std::string gravity_refusal(const Context& context, const ExtensionPlace& place,
                            const NodeMarks& parts) {
  const json::Document& document = context.document;
  const json::NodeId body = model::extension_object(document, place.host, kBody);
  const auto has = [&](std::string_view member) {
    return body != json::kNoNode && document.find(body, member) != json::kNoNode;
  };
  const std::string node = capitalized(node_label(context, place.index));
  if (!has("trigger")) return fmt::format("{} has gravity, but no trigger.", node);
  for (const std::string_view other : {"motion", "collider"}) {
    if (has(other)) return fmt::format("{} has gravity, and a {} beside its trigger.", node, other);
  }
  if (!parts[place.index]) return {};
  return fmt::format("{} has gravity, and is part of the trigger of another node.", node);
}

NodeMarks trigger_parts(const Context& context) {
  NodeMarks parts(context.graph.size(), false);
  for_each_extension(
      context, model::RootArray::nodes, kBody, [&](const ExtensionPlace& place, const Path&) {
        const json::NodeId trigger =
            model::object_member(context.document, place.object, "trigger");
        model::for_each_index(context.asset, context.document.find(trigger, "nodes"),
                              model::RootArray::nodes,
                              [&](std::uint64_t, std::optional<std::uint32_t> node, Span) {
                                if (node) parts[*node] = true;
                              });
      });
  return parts;
}

void check_gravity(const Context& context) {
  constexpr std::string_view kGravity = "OMI_physics_gravity";
  if (!has_objects_of(context, kGravity)) return;
  const NodeMarks parts = trigger_parts(context);
  const json::Document& document = context.document;
  for_each_extension(
      context, model::RootArray::nodes, kGravity,
      [&](const ExtensionPlace& place, const Path& path) {
        std::string refusal = gravity_refusal(context, place, parts);
        if (!refusal.empty()) {
          report_link(context, path, place.object, Code::GRAVITY_WITHOUT_TRIGGER,
                      std::move(refusal));
        }
        const json::NodeId line = model::object_member(document, place.object, "line");
        const json::NodeId points = document.find(line, "points");
        if (points == json::kNoNode || !document.is_array(points)) return;
        const std::uint64_t length = document.array_size(points);
        if (length % 3 == 0) return;
        const Path at(path, "line");
        report_link(
            context, Path(at, "points"), points, Code::GRAVITY_LINE_LENGTH,
            fmt::format("'points' has {} numbers; it must have three for each point.", length));
      });
}

// The mode of a primitive without triangles.
std::optional<model::Mode> other_mode(const model::Mesh& mesh) {
  for (const model::Primitive& primitive : mesh.primitives) {
    if (primitive.mode && !model::draws_triangles(*primitive.mode)) return primitive.mode;
  }
  return std::nullopt;
}

void check_shape_meshes(const Context& context) {
  constexpr std::string_view kShapes = "OMI_physics_shape";
  const json::Document& document = context.document;
  const auto shapes = object_list(document, root_extension(context, kShapes), "shapes");
  std::unordered_map<std::uint32_t, std::optional<model::Mode>> modes;  // by mesh
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const std::string type = model::string_member(document, shapes[i], "type");
    if (type != "convex" && type != "trimesh") continue;
    const json::NodeId form = model::object_member(document, shapes[i], type);
    const auto mesh = context.asset.index(form, "mesh", model::RootArray::meshes);
    if (!mesh) continue;
    const auto [known, fresh] = modes.try_emplace(*mesh);
    if (fresh) known->second = other_mode(context.views.meshes[*mesh]);
    if (!known->second) continue;
    report_at(context.link_sink, fmt::format("/extensions/{}/shapes/{}/{}/mesh", kShapes, i, type),
              finding_on(context, document.find(form, "mesh"), Code::SHAPE_WITHOUT_TRIANGLES,
                         fmt::format("The shape is made of {}, which has a primitive of the mode "
                                     "{}; all must have triangles.",
                                     object_label(context, model::RootArray::meshes, *mesh),
                                     model::mode_name(*known->second))));
  }
}

}  // namespace

const RuleGroup& physics_rules() {
  static constexpr LinkRule kLinkRules[] = {check_trigger_parts, check_vehicle_parts,
                                            check_joints,        check_joint_motions,
                                            check_gravity,       check_shape_meshes};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
// Rigid bodies and vehicles: parts that must lie below the node they belong to, which only the
// scene graph tells.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/node.hpp"
#include "model/scene_graph.hpp"
#include "validate/context.hpp"
#include "validate/rules/extension_walk.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kBodies[] = {"OMI_physics_body", "KHR_physics_rigid_bodies"};
constexpr std::string_view kVehicle = "OMI_vehicle_body";
constexpr std::string_view kVehicleParts[] = {"OMI_vehicle_wheel", "OMI_vehicle_thruster",
                                              "OMI_vehicle_hover_thruster"};

// The triggers that make up another one.
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

// Nodes with a vehicle above them.
std::vector<bool> below_vehicles(const Context& context) {
  const std::size_t count = context.graph.size();
  std::vector<bool> below(count, false);
  std::vector<bool> vehicle(count, false);
  for_each_extension(
      context, model::RootArray::nodes, kVehicle,
      [&](const ExtensionPlace& place, const Path&) { vehicle[place.index] = true; });
  std::vector<bool> known(count, false);
  std::vector<model::NodeIndex> way;
  for (model::NodeIndex start = 0; start < count; ++start) {
    for (model::NodeIndex at = start; at != model::kNoNodeIndex && !known[at];
         at = context.graph.parent(at)) {
      known[at] = true;
      way.push_back(at);
    }
    for (; !way.empty(); way.pop_back()) {
      const model::NodeIndex parent = context.graph.parent(way.back());
      if (parent != model::kNoNodeIndex) below[way.back()] = vehicle[parent] || below[parent];
    }
  }
  return below;
}

void check_vehicle_parts(const Context& context) {
  std::vector<bool> below;
  for (const std::string_view part : kVehicleParts) {
    for_each_extension(
        context, model::RootArray::nodes, part, [&](const ExtensionPlace& place, const Path& path) {
          if (below.empty()) below = below_vehicles(context);
          if (below[place.index]) return;
          report_link(
              context, path, place.object, Code::BODY_PART_NOT_BELOW,
              fmt::format("No node above {} has {}.",
                          object_label(context, model::RootArray::nodes, place.index), kVehicle));
        });
  }
}

}  // namespace

const Family& bodies_family() {
  static constexpr LinkRule kLinkRules[] = {check_trigger_parts, check_vehicle_parts};
  static constexpr Family family{.order = 650, .additional = true, .link_rules = kLinkRules};
  return family;
}

}  // namespace gltfx::validate

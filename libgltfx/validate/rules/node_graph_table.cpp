// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/node_graph_table.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"translation": [0, 1, 0]}],
 "skins": [{"joints": [1]}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}]})";

constexpr RuleDescription kRules[] = {
    {"NODE_EMPTY", Severity::info, "A node is there for nothing",
     "Nothing hangs on it and nothing is below it; it costs every program that walks the scene.",
     "Remove the node, or give it `extras` when an application needs it as a mark.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"camera": 0}, {"name": "nothing"}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"camera": 0}, {"name": "mark", "extras": {"spawn": true}}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})",
     Fix::safe, true},
    {"NODE_LOOP", Severity::error, "A node is its own ancestor",
     "Programs that walk the scene graph never come to an end, or stop with an error.",
     "Remove one of the children that lead back up.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"camera": 0}, {"children": [2]}, {"children": [1]}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"camera": 0, "children": [1]}, {"children": [2]}, {"camera": 0}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})",
     Fix::none, true},
    {"NODE_SKINNED_MESH_LOCAL_TRANSFORMS", Severity::warning,
     "A node with a skinned mesh has a transform",
     "Skinned vertices are placed by the joints alone, so the model stands elsewhere than the "
     "transform says.",
     "Move the joints, or put the transform on a node above them.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0, "translation": [0, 1, 0]}, {"name": "joint"}],
 "skins": [{"joints": [1]}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}]})",
     kGood, Fix::none, true},
    {"NODE_SKINNED_MESH_NON_ROOT", Severity::info, "A node with a skinned mesh has a parent",
     "What the parents do does not reach the mesh, which easily surprises whoever moves them.",
     "Make the node a root of the scene.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"children": [0]}],
 "skins": [{"joints": [1]}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}]})",
     kGood, Fix::none, true},
    {"NODE_SKINNED_MESH_PARENT_TRANSFORMS", Severity::warning,
     "A node above a skinned mesh has a transform",
     "Skinned vertices are placed by the joints alone; a program that heeds the parents shows the "
     "model twice as far or twice as large.",
     "Make the node a root of the scene, and put the transform above the joints.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [1]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"translation": [0, 1, 0], "children": [0]}],
 "skins": [{"joints": [1]}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}]})",
     kGood, Fix::none, true},
    {"NODE_SKIN_NO_SCENE", Severity::error, "A scene shows a skinned mesh without its joints",
     "The joints are in none of the trees of this scene, so they have no place and the mesh no "
     "shape.",
     "Add the root of the joints to the scene.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "skin": 0}, {"name": "joint"}],
 "skins": [{"joints": [1]}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}]})",
     kGood, Fix::none, true},
};

}  // namespace

std::span<const RuleDescription> node_graph_rules() { return kRules; }

}  // namespace gltfx::validate

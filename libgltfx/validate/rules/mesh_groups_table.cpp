// SPDX-License-Identifier: Apache-2.0
// Examples of an extension name it, as those of any extension do.
#include "validate/rules/mesh_groups_table.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_primitive_restart"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"mode": 5, "indices": 1, "attributes": {"POSITION": 0}}, {"mode": 5, "indices": 1, "attributes": {"POSITION": 0}}],
  "extensions": {"EXT_mesh_primitive_restart": {"primitiveGroups": [{"primitives": [0, 1], "indices": 2}]}}}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5123, "type": "SCALAR", "count": 3},
  {"componentType": 5123, "type": "SCALAR", "count": 7}]})";

constexpr RuleDescription kRules[] = {
    {"MANIFOLD_PRIMITIVE_UNFIT", Severity::error,
     "A primitive cannot be part of the manifold its mesh claims to be",
     "The proof that the surface is closed rests on triangles that share their vertices by index; "
     "where they do not, it proves nothing.",
     "Use indexed TRIANGLES with the same accessors and one buffer view for all indices, or remove "
     "the extension.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_manifold"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"indices": 1, "attributes": {"POSITION": 0}}, {"indices": 1, "attributes": {"POSITION": 2}}],
  "extensions": {"EXT_mesh_manifold": {"manifoldPrimitive": {"attributes": {"POSITION": 0}, "indices": 1}}}}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5123, "type": "SCALAR", "count": 3},
  {"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_manifold"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"indices": 1, "attributes": {"POSITION": 0}}, {"indices": 1, "attributes": {"POSITION": 0}}],
  "extensions": {"EXT_mesh_manifold": {"manifoldPrimitive": {"attributes": {"POSITION": 0}, "indices": 1}}}}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5123, "type": "SCALAR", "count": 3}]})",
     Fix::none, false},
    {"RESTART_PRIMITIVES_DIFFER", Severity::error,
     "Primitives of one group differ in more than their indices",
     "The group is drawn in one call: with one material, one mode and one set of attributes.",
     "Group only primitives that are equal but for their indices.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_primitive_restart"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"mode": 5, "indices": 1, "attributes": {"POSITION": 0}}, {"mode": 5, "indices": 1, "attributes": {"POSITION": 3}}],
  "extensions": {"EXT_mesh_primitive_restart": {"primitiveGroups": [{"primitives": [0, 1], "indices": 2}]}}}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5123, "type": "SCALAR", "count": 3},
  {"componentType": 5123, "type": "SCALAR", "count": 7},
  {"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     kGood, Fix::none, false},
    {"RESTART_PRIMITIVE_REPEATED", Severity::error, "A primitive is in two groups",
     "Drawn by groups it would appear twice.", "Keep it in one group.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_primitive_restart"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"mode": 5, "indices": 1, "attributes": {"POSITION": 0}}, {"mode": 5, "indices": 1, "attributes": {"POSITION": 0}}],
  "extensions": {"EXT_mesh_primitive_restart": {"primitiveGroups": [{"primitives": [0, 1], "indices": 2}, {"primitives": [1], "indices": 2}]}}}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5123, "type": "SCALAR", "count": 3},
  {"componentType": 5123, "type": "SCALAR", "count": 7}]})",
     kGood, Fix::none, false},
    {"RESTART_PRIMITIVE_UNFIT", Severity::error,
     "A primitive is in a group that it cannot be drawn with",
     "Restart joins indexed strips, loops and fans without morph targets; others come out wrong.",
     "Take the primitive out of the group.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_primitive_restart"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"mode": 5, "indices": 1, "attributes": {"POSITION": 0}}, {"indices": 1, "attributes": {"POSITION": 0}}],
  "extensions": {"EXT_mesh_primitive_restart": {"primitiveGroups": [{"primitives": [0, 1], "indices": 2}]}}}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5123, "type": "SCALAR", "count": 3},
  {"componentType": 5123, "type": "SCALAR", "count": 7}]})",
     kGood, Fix::none, false},
};

}  // namespace

std::span<const RuleDescription> mesh_groups_rules() { return kRules; }

}  // namespace gltfx::validate

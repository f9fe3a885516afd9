// SPDX-License-Identifier: Apache-2.0
// Examples of an extension name it, as those of any extension do.
#include "validate/rules/instancing_table.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_gpu_instancing"], "extensionsRequired": ["EXT_mesh_gpu_instancing"],
 "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC3", "count": 2}]})";

constexpr RuleDescription kRules[] = {
    {"INSTANCING_ACCESSOR_INVALID_FORMAT", Severity::error,
     "An instance attribute has a format that it cannot have",
     "Instances are placed by these numbers; renderers read them as the one format they know.",
     "Write the attribute in one of its formats.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_gpu_instancing"], "extensionsRequired": ["EXT_mesh_gpu_instancing"],
 "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 2}]})",
     kGood, Fix::none, false},
    {"INSTANCING_NODE_WITHOUT_MESH", Severity::error,
     "A node without a mesh is to be drawn many times", "There is nothing to draw.",
     "Add the mesh, or remove the extension.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_gpu_instancing"], "extensionsRequired": ["EXT_mesh_gpu_instancing"],
 "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"children": [1], "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}}, {"mesh": 0}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC3", "count": 2}]})",
     kGood, Fix::none, false},
    {"INSTANCING_NODE_WITH_SKIN", Severity::warning, "A skinned mesh is to be drawn many times",
     "The joints place its vertices, the instances place it, too: what is drawn is not defined.",
     "Remove the skin or the instances.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_gpu_instancing"], "extensionsRequired": ["EXT_mesh_gpu_instancing"],
 "scene": 0, "scenes": [{"nodes": [0, 1]}],
 "nodes": [{"mesh": 0, "skin": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}}, {"name": "joint"}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC3", "count": 2},
  {"componentType": 5121, "type": "VEC4", "count": 1}, {"componentType": 5126, "type": "VEC4", "count": 1}],
 "skins": [{"joints": [1]}]})",
     kGood, Fix::none, false},
    {"INSTANCING_UNEQUAL_COUNT", Severity::error, "Instance attributes have different counts",
     "Each instance takes one element of each attribute; some have none.",
     "Give all attributes as many elements as there are instances.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_gpu_instancing"], "extensionsRequired": ["EXT_mesh_gpu_instancing"],
 "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1, "SCALE": 2}}}}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC3", "count": 2},
  {"componentType": 5126, "type": "VEC3", "count": 3}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_mesh_gpu_instancing"], "extensionsRequired": ["EXT_mesh_gpu_instancing"],
 "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1, "SCALE": 2}}}}],
 "meshes": [{"primitives": [{"mode": 0, "attributes": {"POSITION": 0}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC3", "count": 2},
  {"componentType": 5126, "type": "VEC3", "count": 2}]})",
     Fix::none, false},
};

}  // namespace

std::span<const RuleDescription> instancing_rules() { return kRules; }

}  // namespace gltfx::validate

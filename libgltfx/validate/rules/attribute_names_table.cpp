// SPDX-License-Identifier: Apache-2.0
// What is said of attribute names: the table. The rules are in attribute_names.cpp.
#include "validate/rules/attribute_names.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3}]})";

constexpr RuleDescription kRules[] = {
    {"MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY", Severity::error,
     "The sets of an attribute are not numbered from 0 without gaps",
     "Readers count sets up from 0 and stop at the first that is missing; the rest is never used.",
     "Number the sets 0, 1, 2 and so on.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_1": 1}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3}]})",
     kGood, Fix::none, true},
    {"MESH_PRIMITIVE_INVALID_ATTRIBUTE", Severity::error,
     "An attribute has a name that glTF does not know",
     "Readers drop attributes they do not know, so colours or texture coordinates are missing "
     "without a word.",
     "Use a name of the specification, or begin a name of your own with an underscore.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR": 1}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3}]})",
     kGood, Fix::none, true},
    {"MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH", Severity::error,
     "A primitive has not as many sets of joints as of weights",
     "A joint without a weight does not move anything, and a weight without a joint has nothing to "
     "follow.",
     "Write one WEIGHTS_n for each JOINTS_n.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "WEIGHTS_0": 1}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3}]})",
     kGood, Fix::none, true},
    {"MESH_PRIMITIVE_NO_POSITION", Severity::warning, "A primitive has no positions",
     "Without POSITION there is nothing to draw, and most readers leave the primitive out.",
     "Add POSITION, or remove the primitive.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"COLOR_0": 0}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC4", "count": 3}]})",
     kGood, Fix::none, true},
    {"MESH_PRIMITIVE_TANGENT_WITHOUT_NORMAL", Severity::warning,
     "A primitive has tangents, but no normals",
     "A tangent space needs both. Readers make flat normals and drop the tangents.",
     "Add NORMAL, or remove TANGENT.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TANGENT": 1}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3}]})",
     kGood, Fix::safe, true},
};

}  // namespace

std::span<const RuleDescription> attribute_name_rules() { return kRules; }

}  // namespace gltfx::validate

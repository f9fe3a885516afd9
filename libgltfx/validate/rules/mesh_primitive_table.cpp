// SPDX-License-Identifier: Apache-2.0
// What is said of primitives: the table. The rules are in mesh_primitive.cpp.
#include "validate/rules/mesh_primitive.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGoodIndices =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5123, "type": "SCALAR", "count": 1}]})";

constexpr std::string_view kGoodMorph =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "targets": [{"NORMAL": 0}]}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})";

constexpr RuleDescription kRules[] = {
    {"MESH_PRIMITIVE_INCOMPATIBLE_MODE", Severity::warning,
     "The number of vertices or indices does not go with the drawing mode",
     "Triangles take three vertices each, lines two. What is left over is dropped, and often shows "
     "that mode or count is wrong.",
     "Correct mode, or the count of the accessor.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 4, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 5}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 4, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     Fix::none, true},
    {"MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT", Severity::error,
     "The indices of a primitive are no plain unsigned integers",
     "GPUs take indices as 8, 16 or 32 bits without sign; readers refuse others.",
     "Convert the indices to SCALAR of UNSIGNED_BYTE, UNSIGNED_SHORT or UNSIGNED_INT.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5122, "type": "SCALAR", "count": 1}]})",
     kGoodIndices, Fix::none, true},
    {"MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE", Severity::error,
     "The indices of a primitive lie in a buffer view with a stride",
     "Index buffers have no gaps. Readers ignore the stride or refuse the view.",
     "Remove byteStride from the view, and write the indices without gaps.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"bufferView": 0, "componentType": 5123, "type": "SCALAR", "count": 1}],
 "bufferViews": [{"buffer": 0, "byteLength": 4, "byteStride": 4}],
 "buffers": [{"byteLength": 4, "uri": "data:application/octet-stream;base64,AAAAAA=="}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"bufferView": 0, "componentType": 5123, "type": "SCALAR", "count": 1}],
 "bufferViews": [{"buffer": 0, "byteLength": 4, "target": 34963}],
 "buffers": [{"byteLength": 4, "uri": "data:application/octet-stream;base64,AAAAAA=="}]})",
     Fix::none, true},
    {"MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT", Severity::error,
     "A morph target has not as many offsets as there are vertices",
     "Offsets are added vertex by vertex; readers run past the end of the shorter list.",
     "Write one offset for each vertex.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "targets": [{"NORMAL": 1}]}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC3", "count": 2}]})",
     kGoodMorph, Fix::none, true},
    {"MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR", Severity::error,
     "A morph target moves an attribute that the primitive does not have",
     "There is nothing to add the offsets to.",
     "Add the attribute to the primitive, or remove it from the target.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"NORMAL": 0}]}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]}]})",
     kGoodMorph, Fix::none, true},
    {"MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", Severity::error,
     "The attributes of a primitive have different numbers of elements",
     "Each vertex takes one element of each attribute; the shortest list ends too early.",
     "Write the same number of elements for all attributes.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC3", "count": 2}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC3", "count": 3}]})",
     Fix::none, true},
};

}  // namespace

std::span<const RuleDescription> mesh_primitive_rules() { return kRules; }

}  // namespace gltfx::validate

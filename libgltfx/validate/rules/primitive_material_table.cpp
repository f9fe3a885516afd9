// SPDX-License-Identifier: Apache-2.0
// What is said of materials on primitives: the table. The rules are in primitive_material.cpp.
#include "validate/rules/primitive_material.hpp"

namespace gltfx::validate {
namespace {

constexpr RuleDescription kRules[] = {
    {"MESH_PRIMITIVE_GENERATED_TANGENT_SPACE", Severity::warning,
     "A primitive leaves its tangents to the reader",
     "Readers compute tangents from texture coordinates, each in its own way, so seams and "
     "lighting differ from program to program.",
     "Export tangents along with the normal map (MikkTSpace is what most tools bake for).",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0, "TEXCOORD_0": 1}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 3}],
 "materials": [{"normalTexture": {"index": 0}}],
 "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0, "TANGENT": 1, "TEXCOORD_0": 2}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3},
  {"componentType": 5126, "type": "VEC2", "count": 3}],
 "materials": [{"normalTexture": {"index": 0}}],
 "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"}]})",
     Fix::none, true},
    {"MESH_PRIMITIVE_NO_TANGENT_SPACE", Severity::error,
     "A primitive has no tangents, and nothing to make them from",
     "A texture in tangent space needs normals and tangents. Readers may make them for the normal "
     "texture of the material, but it has none.",
     "Export NORMAL and TANGENT.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_clearcoat"], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0, "TEXCOORD_0": 1}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 3}],
 "materials": [{"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatNormalTexture": {"index": 0}}}}],
 "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_materials_clearcoat"], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0, "TANGENT": 1, "TEXCOORD_0": 2}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3},
  {"componentType": 5126, "type": "VEC2", "count": 3}],
 "materials": [{"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatNormalTexture": {"index": 0}}}}],
 "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"}]})",
     Fix::none, true},
    {"MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", Severity::error,
     "A texture reads texture coordinates that the primitive does not have",
     "Without coordinates a texture shows one colour, or the reader refuses the asset.",
     "Export the set of texture coordinates, or correct texCoord.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 3}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
  "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0, "texCoord": 1}}],
 "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mP4DwABAQEAHLCMmQAAAABJRU5ErkJggg=="}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 1}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 3}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
  "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0, "texCoord": 1}}],
 "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mP4DwABAQEAHLCMmQAAAABJRU5ErkJggg=="}]})",
     Fix::none, true},
    {"UNUSED_MESH_TANGENT", Severity::info, "The tangents of a primitive are not used",
     "Tangents only serve textures in tangent space, such as normal maps; they are 16 bytes a "
     "vertex.",
     "Remove TANGENT, or give the material its normal map.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0, "TANGENT": 1, "TEXCOORD_0": 2}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3},
  {"componentType": 5126, "type": "VEC2", "count": 3}],
 "materials": [{"occlusionTexture": {"index": 0}}],
 "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mP4DwABAQEAHLCMmQAAAABJRU5ErkJggg=="}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0, "TANGENT": 1, "TEXCOORD_0": 2}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC4", "count": 3},
  {"componentType": 5126, "type": "VEC2", "count": 3}],
 "materials": [{"normalTexture": {"index": 0}}],
 "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"}]})",
     Fix::safe, true},
};

}  // namespace

std::span<const RuleDescription> primitive_material_rules() { return kRules; }

}  // namespace gltfx::validate

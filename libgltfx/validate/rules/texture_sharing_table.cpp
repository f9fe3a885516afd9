// SPDX-License-Identifier: Apache-2.0
// What is said of slots that share an image: the table. The rules are in texture_sharing.cpp.
#include "validate/rules/texture_sharing.hpp"

namespace gltfx::validate {
namespace {

constexpr RuleDescription kRules[] = {
    {"TEXTURE_COLOR_SPACE_CONFLICT", Severity::warning,
     "One channel of an image is read as sRGB and as linear",
     "Colours are stored in sRGB, data such as roughness as they are. One channel cannot be "
     "both: one of the slots gets wrong values. Alpha is always linear, so data in A beside "
     "colours is fine.",
     "Give each of the slots an image of its own, or move the data into A.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}, {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "occlusionTexture": {"index": 0}}],
 "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}, {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "occlusionTexture": {"index": 1}}],
 "textures": [{"source": 0}, {"source": 1}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"},
  {"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR42mPgagAAAJcAiys17QIAAAAASUVORK5CYII="}]})",
     Fix::none, false},
    {"TEXTURE_PACKABLE", Severity::hint, "Occlusion could lie beside roughness and metalness",
     "Occlusion reads R, roughness and metalness G and B. Where both images have the same "
     "size and coordinates, one image does for both: less to load, and one lookup less for "
     "each pixel.",
     "Put occlusion into R of the other image, and let both slots refer to it.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}, {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}, "occlusionTexture": {"index": 1}}],
 "textures": [{"source": 0}, {"source": 1}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"},
  {"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAAAAADRSSBWAAAAC0lEQVR42mNgaAAAAIMAgRRrm0MAAAAASUVORK5CYII="}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}, {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}, "occlusionTexture": {"index": 0}}],
 "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"}]})",
     Fix::none, false},
    {"TEXTURE_PACKING_DISAGREES", Severity::info,
     "Channels that are packed into one image are laid out differently",
     "Maps that share an image were baked for one set of texture coordinates. When one slot "
     "names another set, transform or sampler, its channel lies on the wrong place.",
     "Give the slots the same texCoord, transform and sampler.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1, "TEXCOORD_1": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}, {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}, "occlusionTexture": {"index": 0, "texCoord": 1}}],
 "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}, {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}}, "occlusionTexture": {"index": 0}}],
 "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"}]})",
     Fix::none, false},
    {"TEXTURE_TRANSFORM_CLAMPED", Severity::hint,
     "A transform leads out of a texture that is clamped",
     "Behind the edge of a clamped texture its last texel is repeated: tiles become streaks.",
     "Let the sampler repeat, or keep the transform inside the image.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_texture_transform"], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}, {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}}}}],
 "textures": [{"source": 0, "sampler": 0}],
 "samplers": [{"wrapS": 33071, "wrapT": 33071}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_texture_transform"], "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}, {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [0.5, 0.5]}}}}}],
 "textures": [{"source": 0, "sampler": 0}],
 "samplers": [{"wrapS": 33071, "wrapT": 33071}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mNoaPi/p+E9AA2mBCs4tldTAAAAAElFTkSuQmCC"}]})",
     Fix::none, false},
};

}  // namespace

std::span<const RuleDescription> texture_sharing_rules() { return kRules; }

}  // namespace gltfx::validate

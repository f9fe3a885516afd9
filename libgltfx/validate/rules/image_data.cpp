// SPDX-License-Identifier: Apache-2.0
// The table of what phase 5 finds in images.
#include "validate/rules/families.hpp"

namespace gltfx::validate {
namespace {

// One grey pixel.
constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"},
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="}]})";

constexpr RuleDescription kRules[] = {
    {"IMAGE_DATA_INVALID", Severity::error, "The header of an image contradicts its format",
     "No reader can decode it; the model shows without the texture.", "Export the image again.",
     R"({"asset": {"version": "2.0"},
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAAMSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="}]})",
     kGood, Fix::none, true},
    {"IMAGE_FEATURES_UNSUPPORTED", Severity::warning,
     "An image asks for something that glTF ignores",
     "Colour profiles, gamma, pixels that are not square and animations are not applied to "
     "textures, so the picture differs from what the image editor showed.",
     "Convert the image to plain sRGB, or to linear values for data, with square pixels and one "
     "frame.",
     R"({"asset": {"version": "2.0"},
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAABGdBTUEAAOpgYgYacwAAAApJREFUeJxjaAAAAIIAgXfNcrYAAAAASUVORK5CYII="}]})",
     kGood, Fix::none, true},
    {"IMAGE_MIME_TYPE_INVALID", Severity::error, "An image is of another format than it says",
     "Readers choose the decoder by the type that is declared, and fail.",
     "Correct mimeType, or the media type of the data URI.",
     R"({"asset": {"version": "2.0"},
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==", "mimeType": "image/jpeg"}]})",
     kGood, Fix::none, true},
    {"IMAGE_NON_ENABLED_MIME_TYPE", Severity::error,
     "An image has a format that needs an extension",
     "glTF itself knows PNG and JPEG. Readers need not open anything else.",
     "Declare the extension that brings the format and refer to the image through it, or convert "
     "the image to PNG or JPEG.",
     R"({"asset": {"version": "2.0"},
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
 "images": [{"uri": "data:image/webp;base64,UklGRhwAAABXRUJQVlA4TA8AAAAvAAAAAAcQ/Y/+ByKi/wEA"}]})",
     kGood, Fix::none, true},
    {"IMAGE_NPOT_DIMENSIONS", Severity::info, "The width or height of an image is no power of two",
     "Some devices cannot make mipmaps of such textures or repeat them, and resample the image "
     "when it is loaded.",
     "Scale the image to a power of two.",
     R"({"asset": {"version": "2.0"},
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAMAAAACCAAAAAC4HznGAAAADklEQVR4nGNoaGhgAGIADAgDAcWhuYYAAAAASUVORK5CYII="}]})",
     kGood, Fix::none, true},
    {"IMAGE_UNEXPECTED_EOS", Severity::error, "An image ends before its header does",
     "It was cut off on its way; nothing can be shown.", "Fetch or export the image again.",
     R"({"asset": {"version": "2.0"},
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6"}]})",
     kGood, Fix::none, true},
    {"IMAGE_UNRECOGNIZED_FORMAT", Severity::warning, "An image has a format that is not known",
     "Readers know PNG and JPEG, and what declared extensions bring.",
     "Convert the image to PNG or JPEG.",
     R"({"asset": {"version": "2.0"},
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,R0lGODlhAAAAAAAAAAAAAAAAAAAAAAAAAAA="}]})",
     kGood, Fix::none, true},
    {"TEXTURE_INVALID_IMAGE_MIME_TYPE", Severity::error,
     "A texture uses an image of a format that it must not have",
     "The source of a texture is PNG or JPEG, so that every reader can show it; other formats "
     "stand in the extension that brings them.",
     "Point source to a PNG or JPEG, and the extension to the other image.",
     R"({"asset": {"version": "2.0"},
 "extensionsUsed": ["EXT_texture_webp"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0, "extensions": {"EXT_texture_webp": {"source": 0}}}],
 "images": [{"uri": "data:image/webp;base64,UklGRhwAAABXRUJQVlA4TA8AAAAvAAAAAAcQ/Y/+ByKi/wEA"}]})",
     R"({"asset": {"version": "2.0"},
 "extensionsUsed": ["EXT_texture_webp"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 0, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 1}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "textures": [{"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}}}],
 "images": [{"uri": "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg=="}, {"uri": "data:image/webp;base64,UklGRhwAAABXRUJQVlA4TA8AAAAvAAAAAAcQ/Y/+ByKi/wEA"}]})",
     Fix::none, true},
};

}  // namespace

const Family& image_data_family() {
  static const Family family{"image_data", kRules, {}, {}};
  return family;
}

}  // namespace gltfx::validate

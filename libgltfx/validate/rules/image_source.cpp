// SPDX-License-Identifier: Apache-2.0
// Images that lie in a buffer view, and which images a texture may show.
#include <fmt/format.h>

#include "model/usage.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"
#include "validate/rules/use.hpp"

namespace gltfx::validate {
namespace {

// The image is a PNG of one pixel.
constexpr RuleDescription kRules[] = {
    {"IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE", Severity::error,
     "The buffer view of an image has a stride",
     "An image is one run of bytes. A stride marks vertex data, so readers refuse the view or "
     "upload it as vertices.",
     "Remove byteStride from the view.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 3}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
 "textures": [{"source": 0}], "images": [{"bufferView": 0, "mimeType": "image/png"}],
 "bufferViews": [{"buffer": 0, "byteLength": 67, "byteStride": 4}],
 "buffers": [{"byteLength": 67, "uri": "data:application/octet-stream;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mP4DwABAQEAHLCMmQAAAABJRU5ErkJggg=="}]})",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC2", "count": 3}],
 "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
 "textures": [{"source": 0}], "images": [{"bufferView": 0, "mimeType": "image/png"}],
 "bufferViews": [{"buffer": 0, "byteLength": 67}],
 "buffers": [{"byteLength": 67, "uri": "data:application/octet-stream;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mP4DwABAQEAHLCMmQAAAABJRU5ErkJggg=="}]})",
     Fix::safe, true},
};

void check_image(const Context& context, json::NodeId image, const Path& path) {
  const Path at(path, "bufferView");
  const json::NodeId place = context.document.find(image, "bufferView");
  report_references(context, place);
  const auto view = context.asset.index(image, "bufferView", model::RootArray::buffer_views);
  if (!view) return;
  report_view_use(context, *view, model::ViewUse::image, place, at);
  if (!context.views.buffer_views[*view].byte_stride) return;
  report_link(context, at, place, "IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE",
              fmt::format("View {} holds an image, but has a byteStride.", *view));
}

void check_images(const Context& context) {
  const Path root;
  const Path array(root, "images");
  const auto& images = context.asset.elements(model::RootArray::images);
  for (std::size_t i = 0; i < images.size(); ++i) {
    check_image(context, images[i], Path(array, static_cast<std::uint64_t>(i)));
  }
}

// Textures first, then their extensions.
void check_textures(const Context& context) {
  if (!context.khronos()) return;
  const auto& textures = context.asset.elements(model::RootArray::textures);
  for (const json::NodeId texture : textures) {
    report_references(context, context.document.find(texture, "source"));
    report_references(context, context.document.find(texture, "sampler"));
  }
  report_references(context, context.document.find(context.document.root(), "textures"));
}

constexpr LinkRule kLinkRules[] = {check_images, check_textures};

}  // namespace

const Family& image_source_family() {
  static const Family family{"image_source", kRules, {}, kLinkRules};
  return family;
}

}  // namespace gltfx::validate

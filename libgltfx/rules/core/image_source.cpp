// SPDX-License-Identifier: Apache-2.0
// Images in a buffer view, and the images that a texture may use.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/usage.hpp"
#include "rules/context.hpp"
#include "rules/core/use.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

// The image is a PNG of one pixel.
void check_image(const Context& context, json::NodeId image, const Path& path) {
  const Path at(path, "bufferView");
  const json::NodeId place = context.document.find(image, "bufferView");
  report_references(context, place);
  const auto view = context.asset.index(image, "bufferView", model::RootArray::buffer_views);
  if (!view) return;
  report_view_use(context, *view, model::ViewUse::image, place, at);
  if (!context.views.buffer_views[*view].byte_stride) return;
  report_link(context, at, place, Code::IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE,
              fmt::format("Buffer view {} contains an image, but has a byteStride.", *view));
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
  const auto& textures = context.asset.elements(model::RootArray::textures);
  for (const json::NodeId texture : textures) {
    report_references(context, context.document.find(texture, "source"));
    report_references(context, context.document.find(texture, "sampler"));
  }
  report_references(context, context.document.find(context.document.root(), "textures"));
}

}  // namespace

const RuleGroup& image_source_rules() {
  static constexpr LinkRule kLinkRules[] = {check_images, check_textures};
  static constexpr FixEntry kFixes[] = {
      {Code::IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE, remove_used_stride}};
  static constexpr RuleGroup group{.link_rules = kLinkRules, .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
// VRMC_vrm: the thumbnail of an avatar. The sizes of images are not in the document.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/node.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/extensions/vrm_humanoid.hpp"
#include "rules/finding.hpp"
#include "rules/payload/phases.hpp"
#include "rules/payload/texture_slots.hpp"

namespace gltfx::validate {

void check_thumbnails(DataPhase& phase) {
  const json::Document& document = phase.context.document;
  const json::NodeId meta =
      model::object_member(document, root_extension(phase.context, kAvatar), "meta");
  const auto image = phase.context.asset.index(meta, "thumbnailImage", model::RootArray::images);
  if (!image) return;
  const auto& header = phase.resources.images[*image].header;
  if (!header || !header->doubt.empty()) return;
  const bool core = header->format == image::Format::png || header->format == image::Format::jpeg;
  if (core && header->width == header->height) return;
  const std::string label = image_label(phase.context, *image);
  report_at(
      phase.sink, fmt::format("/extensions/{}/meta/thumbnailImage", kAvatar),
      finding_on(phase.context, document.find(meta, "thumbnailImage"), Code::THUMBNAIL_NOT_SQUARE,
                 core ? fmt::format("The size of {} is {}x{}; it must be square.", label,
                                    header->width, header->height)
                      : fmt::format("The type of {} is {}; it must be PNG or JPEG.", label,
                                    image::media_type(header->format))));
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
#include "rules/core/accessor_extent.hpp"

#include <fmt/format.h>

#include "base/codes.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

void check_alignment(const Context& context, const Extent& extent, bool with_view,
                     const Path& path) {
  const std::uint64_t offset = extent.byte_offset.value_or(0);
  const bool aligned = offset % extent.component_size == 0;
  if (!aligned) {
    report_member(
        context.link_sink, context, path, extent.object, "byteOffset",
        Code::ACCESSOR_OFFSET_ALIGNMENT,
        fmt::format("byteOffset is {}, which is not a multiple of the component size, {} bytes.",
                    offset, extent.component_size));
  }
  // If the accessor's own offset is invalid, the sum adds no information.
  if (!with_view || (!aligned && !context.deviations.consequences_are_reported)) return;
  const std::uint64_t view_offset = context.views.buffer_views[extent.view].byte_offset.value_or(0);
  const Checked total = checked_add(view_offset, offset);
  if (!total || *total % extent.component_size == 0) return;
  report_link(context, path, extent.object, Code::ACCESSOR_TOTAL_OFFSET_ALIGNMENT,
              fmt::format("The data starts at byte {} of the buffer ({} in buffer view {} plus "
                          "{}), which is not a multiple of the component size, {} bytes.",
                          *total, view_offset, extent.view, offset, extent.component_size));
}

}  // namespace

bool is_measurable(const Context& context, const model::Accessor& accessor) {
  if (!context.deviations.unknown_formats_are_checked) {
    return accessor.count && accessor.format.known();
  }
  return accessor.count && accessor.format.component != model::ComponentType::none &&
         context.document.find(accessor.node, "type") != json::kNoNode;
}

void check_extent(const Context& context, const Extent& extent, const Path& path) {
  const bool has_offset = context.document.has_value(extent.object, "byteOffset");
  if (has_offset && !extent.byte_offset) return;
  const auto& view = context.views.buffer_views[extent.view];
  const bool starts = view.byte_offset || !context.document.has_value(view.node, "byteOffset");
  const bool minus_one = context.deviations.missing_integers_are_minus_one;
  check_alignment(context, extent, starts || !minus_one, path);
  if (minus_one ? !starts : !view.byte_length) return;
  const std::uint64_t offset = extent.byte_offset.value_or(0);
  const std::uint64_t length = extent.length.value_or(UINT64_MAX);
  if (view.byte_length && fits(offset, length, *view.byte_length)) return;
  std::string message =
      fmt::format("The elements take {} bytes at offset {}, but buffer view {} has only {} bytes.",
                  length, offset, extent.view, view.byte_length.value_or(0));
  if (!view.byte_length || offset > *view.byte_length) {
    report_member(context.link_sink, context, path, extent.object, "byteOffset",
                  Code::ACCESSOR_TOO_LONG, std::move(message));
  } else {
    report_link(context, path, extent.object, Code::ACCESSOR_TOO_LONG, std::move(message));
  }
}

}  // namespace gltfx::validate

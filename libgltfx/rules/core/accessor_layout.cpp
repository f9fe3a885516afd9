// SPDX-License-Identifier: Apache-2.0
// The place of accessor elements: correctly aligned and inside their buffer view.
#include <fmt/format.h>

#include "base/codes.hpp"
#include "rules/context.hpp"
#include "rules/core/accessor_extent.hpp"
#include "rules/core/use.hpp"
#include "rules/finding.hpp"
#include "rules/fix_users.hpp"

namespace gltfx::validate {
namespace {

Checked length_of(const model::Accessor& accessor, std::uint64_t stride) {
  const Checked before_last = checked_mul(*accessor.count - 1, stride);
  return before_last ? checked_add(*before_last, model::element_size(accessor.format)) : Checked();
}

void check_base(const Context& context, const model::Accessor& accessor, const Path& path) {
  report_references(context, context.document.find(accessor.node, "bufferView"));
  const model::BufferView* view = context.views.view_of(accessor);
  if (view == nullptr) return;
  const std::uint64_t size = model::element_size(accessor.format);
  if (view->byte_stride && *view->byte_stride < size) {
    report_link(
        context, path, accessor.node, Code::ACCESSOR_SMALL_BYTESTRIDE,
        fmt::format("byteStride of buffer view {} is {}, but an element ({}) takes {} bytes.",
                    *accessor.buffer_view, *view->byte_stride, model::format_text(accessor.format),
                    size));
    // Lengths computed with a wrong stride are meaningless.
    if (!context.deviations.consequences_are_reported) return;
  }
  const std::uint64_t stride = view->byte_stride.value_or(model::packed_stride(accessor.format));
  check_extent(context,
               {accessor.node, *accessor.buffer_view, accessor.byte_offset,
                model::component_size(accessor.format.component), length_of(accessor, stride)},
               path);
}

// Indices and values of a sparse accessor are packed, matrices without padding.
void check_part(const Context& context, const model::SparsePart& part, std::uint64_t count,
                const Path& path) {
  const json::NodeId place = context.document.find(part.node, "bufferView");
  report_references(context, place);
  if (!part.buffer_view) return;
  report_view_use(context, *part.buffer_view, model::ViewUse::other, place,
                  Path(path, "bufferView"));
  if (context.views.buffer_views[*part.buffer_view].byte_stride) {
    report_link(context, Path(path, "bufferView"), place, Code::BUFFER_VIEW_INVALID_BYTE_STRIDE,
                fmt::format("Buffer view {} has a byteStride, but contains sparse accessor data.",
                            *part.buffer_view));
  }
  const unsigned component = model::component_size(part.format.component);
  if (component == 0) return;
  const std::uint64_t element = std::uint64_t{component} * model::component_count(part.format.type);
  check_extent(
      context,
      {part.node, *part.buffer_view, part.byte_offset, component, checked_mul(count, element)},
      path);
}

void check_sparse(const Context& context, const model::Accessor& accessor, const Path& path) {
  const auto sparse = model::read_sparse(context.asset, accessor);
  if (!sparse) return;
  const bool indexes = model::can_index_elements(sparse->indices.format.component);
  if (!indexes && !context.deviations.unknown_formats_are_checked) return;
  const Path at(path, "sparse");
  if (*sparse->count > *accessor.count) {
    report_member(context.link_sink, context, at, accessor.sparse, "count",
                  Code::ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE,
                  fmt::format("The sparse accessor replaces {} elements, but has only {}.",
                              *sparse->count, *accessor.count));
  }
  check_part(context, sparse->indices, *sparse->count, Path(at, "indices"));
  check_part(context, sparse->values, *sparse->count, Path(at, "values"));
}

void check_accessors(const Context& context) {
  const Path root;
  const Path array(root, "accessors");
  const auto& accessors = context.views.accessors;
  for (std::size_t i = 0; i < accessors.size(); ++i) {
    if (!is_measurable(context, accessors[i])) continue;
    const Path path(array, static_cast<std::uint64_t>(i));
    check_base(context, accessors[i], path);
    check_sparse(context, accessors[i], path);
  }
}

// `place` is the accessor.
bool fix_small_stride(Fixing& fixing, const Subject& accessor) {
  const auto index = fixing.index(model::RootArray::accessors, accessor.value);
  const auto view = index ? fixing.views().accessors[*index].buffer_view : std::nullopt;
  return view && fix_stride(fixing, *view);
}

constexpr FixEntry kLayoutFixes[] = {{Code::ACCESSOR_SMALL_BYTESTRIDE, fix_small_stride}};

}  // namespace

const RuleGroup& accessor_layout_rules() {
  static constexpr LinkRule kLinkRules[] = {check_accessors};
  static constexpr RuleGroup group{.link_rules = kLinkRules, .fixes = kLayoutFixes};
  return group;
}

}  // namespace gltfx::validate

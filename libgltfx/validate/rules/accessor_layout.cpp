// SPDX-License-Identifier: Apache-2.0
// Where the elements of accessors lie: on the right boundaries and inside their buffer view.
#include <fmt/format.h>

#include "model/fields.hpp"
#include "validate/rules/accessor_extent.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"
#include "validate/rules/use.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "byteOffset": 4, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteOffset": 4, "byteLength": 16, "byteStride": 12, "target": 34962}],
 "buffers": [{"byteLength": 20, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAA="}]})";

constexpr std::string_view kGoodSparse =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_HEAT": 1}, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "SCALAR", "count": 1, "sparse": {"count": 1,
   "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 1}}}],
 "bufferViews": [{"buffer": 0, "byteLength": 4}, {"buffer": 0, "byteOffset": 4, "byteLength": 8}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})";

constexpr RuleDescription kRules[] = {
    {"ACCESSOR_OFFSET_ALIGNMENT", Severity::error,
     "The offset of an accessor is no multiple of its component size",
     "Numbers that straddle boundaries cannot be read as they lie: typed arrays throw, GPUs refuse "
     "the buffer.",
     "Pad the data, and make byteOffset a multiple of the component size.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "byteOffset": 2, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteOffset": 4, "byteLength": 16, "byteStride": 12, "target": 34962}],
 "buffers": [{"byteLength": 20, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAA="}]})",
     kGood, Fix::none, true},
    {"ACCESSOR_SMALL_BYTESTRIDE", Severity::error,
     "Elements of an accessor overlap: the stride of the view is smaller than one of them",
     "The stride leads to the next vertex before this one has ended.",
     "Write the true distance between vertices into byteStride.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "byteOffset": 4, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteOffset": 4, "byteLength": 16, "byteStride": 8, "target": 34962}],
 "buffers": [{"byteLength": 20, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAA="}]})",
     kGood, Fix::none, true},
    {"ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", Severity::error,
     "A sparse accessor replaces more elements than it has",
     "Every replaced element has an index of its own, so there cannot be more of them than "
     "elements.",
     "Correct sparse.count or count.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_HEAT": 1}, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "SCALAR", "count": 1, "sparse": {"count": 2,
   "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 1}}}],
 "bufferViews": [{"buffer": 0, "byteLength": 4}, {"buffer": 0, "byteOffset": 4, "byteLength": 8}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})",
     kGoodSparse, Fix::none, true},
    {"ACCESSOR_TOO_LONG", Severity::error,
     "The elements of an accessor reach beyond the end of its buffer view",
     "What lies behind the view belongs to something else or to nobody; readers refuse the asset "
     "or show torn geometry.",
     "Correct count and byteOffset, or make the view longer.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "byteOffset": 4, "componentType": 5126, "type": "VEC3", "count": 2, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteOffset": 4, "byteLength": 16, "byteStride": 12, "target": 34962}],
 "buffers": [{"byteLength": 20, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAA="}]})",
     kGood, Fix::none, true},
    {"ACCESSOR_TOTAL_OFFSET_ALIGNMENT", Severity::error,
     "The elements of an accessor begin at a byte of the buffer that is no multiple of the "
     "component size",
     "The offsets of the accessor and of its view add up. Numbers that straddle boundaries cannot "
     "be read as they lie.",
     "Move the buffer view to a multiple of the component size.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "byteOffset": 4, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteOffset": 2, "byteLength": 16, "byteStride": 12, "target": 34962}],
 "buffers": [{"byteLength": 20, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAAAAAAAAA="}]})",
     kGood, Fix::none, true},
};

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
    report_link(context, path, accessor.node, "ACCESSOR_SMALL_BYTESTRIDE",
                fmt::format("The stride of view {} is {} bytes, but an element ({}) takes {}.",
                            *accessor.buffer_view, *view->byte_stride,
                            model::format_text(accessor.format), size));
    if (!context.khronos()) return;  // lengths counted with a wrong stride mean nothing
  }
  const std::uint64_t stride = view->byte_stride.value_or(model::packed_stride(accessor.format));
  check_extent(context,
               {accessor.node, *accessor.buffer_view, accessor.byte_offset,
                model::component_size(accessor.format.component), length_of(accessor, stride)},
               path);
}

// Indices and values of a sparse accessor lie side by side, matrices without padding.
void check_part(const Context& context, const model::SparsePart& part, std::uint64_t count,
                const Path& path) {
  const json::NodeId place = context.document.find(part.node, "bufferView");
  report_references(context, place);
  if (!part.buffer_view) return;
  report_view_use(context, *part.buffer_view, model::ViewUse::other, place,
                  Path(path, "bufferView"));
  if (context.views.buffer_views[*part.buffer_view].byte_stride) {
    report_link(context, Path(path, "bufferView"), place, "BUFFER_VIEW_INVALID_BYTE_STRIDE",
                fmt::format("View {} has a byteStride, but holds a part of a sparse accessor.",
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
  if (!context.khronos() && !model::can_index_elements(sparse->indices.format.component)) return;
  const Path at(path, "sparse");
  if (*sparse->count > *accessor.count) {
    report_member(context.link_sink, context, at, accessor.sparse, "count",
                  "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE",
                  fmt::format("{} elements are replaced, but the accessor has only {}.",
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

constexpr LinkRule kLinkRules[] = {check_accessors};

}  // namespace

const Family& accessor_layout_family() {
  static const Family family{"accessor_layout", kRules, {}, kLinkRules};
  return family;
}

}  // namespace gltfx::validate

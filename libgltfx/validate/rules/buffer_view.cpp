// SPDX-License-Identifier: Apache-2.0
// Buffer views: their stride, and whether they fit their buffer.
#include "model/buffer_view.hpp"

#include <fmt/format.h>

#include "base/checked.hpp"
#include "model/fields.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "byteStride": 12, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})";

constexpr std::string_view kGoodIndices =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 1, "sparse": {"count": 1,
   "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 1}}}],
 "bufferViews": [{"buffer": 0, "byteLength": 4}, {"buffer": 0, "byteLength": 4}],
 "buffers": [{"byteLength": 4, "uri": "data:application/octet-stream;base64,AAAAAA=="}]})";

constexpr RuleDescription kRules[] = {
    {"BUFFER_VIEW_INVALID_BYTE_STRIDE", Severity::error,
     "A buffer view that holds no vertex attributes has a stride",
     "Indices and the parts of sparse accessors lie side by side without gaps; readers ignore the "
     "stride or read the wrong bytes.",
     "Remove byteStride, and write the elements without gaps.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 0}]}],
 "accessors": [{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5121, "type": "SCALAR", "count": 1, "sparse": {"count": 1,
   "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 1}}}],
 "bufferViews": [{"buffer": 0, "byteLength": 4, "byteStride": 4}, {"buffer": 0, "byteLength": 4}],
 "buffers": [{"byteLength": 4, "uri": "data:application/octet-stream;base64,AAAAAA=="}]})",
     kGoodIndices, Fix::none, true},
    {"BUFFER_VIEW_TOO_BIG_BYTE_STRIDE", Severity::error,
     "The stride of a buffer view is larger than the view",
     "A stride leads from one vertex to the next; here the next one lies outside, so length or "
     "stride is wrong.",
     "Correct byteStride or byteLength.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 12, "byteStride": 16, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})",
     kGood, Fix::none, true},
    {"BUFFER_VIEW_TOO_LONG", Severity::error, "A buffer view reaches beyond the end of its buffer",
     "Readers refuse the asset, or read memory that is not the buffer's.",
     "Correct byteOffset and byteLength, or the byteLength of the buffer.",
     R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 24, "byteStride": 12, "target": 34962}],
 "buffers": [{"byteLength": 12, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA"}]})",
     kGood, Fix::none, true},
};

void check_stride(const Context& context, json::NodeId object, const Path& path) {
  const model::BufferView view = model::read_buffer_view(context.asset, object);
  if (!view.byte_stride) return;
  if (view.byte_length && *view.byte_stride > *view.byte_length) {
    report_member(context.schema_sink, context, path, object, "byteStride",
                  "BUFFER_VIEW_TOO_BIG_BYTE_STRIDE",
                  fmt::format("The stride of {} bytes is larger than the view, which has {}.",
                              *view.byte_stride, *view.byte_length));
  }
  if (context.khronos() && *view.byte_stride % 4 != 0) {
    report_member(context.schema_sink, context, path, object, "byteStride", "VALUE_MULTIPLE_OF",
                  fmt::format("The stride of {} bytes is no multiple of 4.", *view.byte_stride));
  }
  if (view.target == model::ViewTarget::indices) {
    report_member(context.schema_sink, context, path, object, "byteStride",
                  "BUFFER_VIEW_INVALID_BYTE_STRIDE",
                  "A view whose target is vertex indices has no byteStride.");
  }
}

// Of a broken number the Khronos validator makes -1.
bool fits_khronos(const Context& context, const model::BufferView& view, std::uint64_t size,
                  bool& begins_outside) {
  const bool broken = !view.byte_offset && context.document.has_value(view.node, "byteOffset");
  const std::uint64_t less = (broken ? 1U : 0U) + (view.byte_length ? 0U : 1U);
  const Checked end = checked_add(view.byte_offset.value_or(0), view.byte_length.value_or(0));
  begins_outside = view.byte_offset.value_or(0) >= size;
  return !begins_outside && end && *end <= size + less;
}

void check_extent(const Context& context, const model::BufferView& view, const Path& path) {
  if (!view.buffer || (!view.byte_length && !context.khronos())) return;
  const json::NodeId buffer = context.asset.elements(model::RootArray::buffers)[*view.buffer];
  const auto size = model::unsigned_member(context.document, buffer, "byteLength");
  if (!size || *size == 0) return;
  const std::uint64_t offset = view.byte_offset.value_or(0);
  bool begins_outside = view.byte_offset && offset >= *size;
  if (context.khronos() ? fits_khronos(context, view, *size, begins_outside)
                        : fits(offset, *view.byte_length, *size))
    return;
  report_member(
      context.link_sink, context, path, view.node, begins_outside ? "byteOffset" : "byteLength",
      "BUFFER_VIEW_TOO_LONG",
      fmt::format("The view takes {} bytes from byte {} on, but buffer {} declares only {}.",
                  view.byte_length.value_or(0), offset, *view.buffer, *size));
}

void check_extents(const Context& context) {
  const Path root;
  const Path array(root, "bufferViews");
  const auto& views = context.views.buffer_views;
  for (std::size_t i = 0; i < views.size(); ++i) {
    report_references(context, views[i].node);
    check_extent(context, views[i], Path(array, static_cast<std::uint64_t>(i)));
  }
}

constexpr ObjectRuleEntry kObjectRules[] = {{"bufferView", check_stride, "target"}};
constexpr LinkRule kLinkRules[] = {check_extents};

}  // namespace

const Family& buffer_view_family() {
  static const Family family{"buffer_view", kRules, kObjectRules, kLinkRules};
  return family;
}

}  // namespace gltfx::validate

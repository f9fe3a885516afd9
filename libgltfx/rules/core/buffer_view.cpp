// SPDX-License-Identifier: Apache-2.0
// Buffer views: their stride, and whether they fit their buffer.
#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/codes.hpp"
#include "model/accessor.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/core/use.hpp"
#include "rules/finding.hpp"
#include "rules/fix_users.hpp"

namespace gltfx::validate {
namespace {

void check_stride(const Context& context, json::NodeId object, const Path& path) {
  const model::BufferView view = model::read_buffer_view(context.asset, object);
  if (!view.byte_stride) return;
  if (view.byte_length && *view.byte_stride > *view.byte_length) {
    report_member(context.schema_sink, context, path, object, "byteStride",
                  Code::BUFFER_VIEW_TOO_BIG_BYTE_STRIDE,
                  fmt::format("byteStride is {}, but the buffer view has only {} bytes.",
                              *view.byte_stride, *view.byte_length));
  }
  // Otherwise the walk reports it.
  if (context.deviations.reading_order && *view.byte_stride % 4 != 0) {
    report_member(context.schema_sink, context, path, object, "byteStride", Code::VALUE_MULTIPLE_OF,
                  fmt::format("byteStride is {}; it must be a multiple of 4.", *view.byte_stride));
  }
  if (view.target == model::ViewTarget::indices) {
    report_member(context.schema_sink, context, path, object, "byteStride",
                  Code::BUFFER_VIEW_INVALID_BYTE_STRIDE,
                  "The buffer view has a byteStride, but its target is vertex indices.");
  }
}

// With -1 for missing numbers.
bool fits_minus_one(const Context& context, const model::BufferView& view, std::uint64_t size,
                    bool& begins_outside) {
  const bool broken = !view.byte_offset && context.document.has_value(view.node, "byteOffset");
  const std::uint64_t less = (broken ? 1U : 0U) + (view.byte_length ? 0U : 1U);
  const Checked end = checked_add(view.byte_offset.value_or(0), view.byte_length.value_or(0));
  begins_outside = view.byte_offset.value_or(0) >= size;
  return !begins_outside && end && *end <= size + less;
}

void check_extent(const Context& context, const model::BufferView& view, const Path& path) {
  const bool minus_one = context.deviations.missing_integers_are_minus_one;
  if (!view.buffer || (!view.byte_length && !minus_one)) return;
  const json::NodeId buffer = context.asset.elements(model::RootArray::buffers)[*view.buffer];
  const auto size = model::unsigned_member(context.document, buffer, "byteLength");
  if (!size || *size == 0) return;
  const std::uint64_t offset = view.byte_offset.value_or(0);
  bool begins_outside = view.byte_offset && offset >= *size;
  if (minus_one ? fits_minus_one(context, view, *size, begins_outside)
                : fits(offset, *view.byte_length, *size))
    return;
  report_member(
      context.link_sink, context, path, view.node, begins_outside ? "byteOffset" : "byteLength",
      Code::BUFFER_VIEW_TOO_LONG,
      fmt::format("The buffer view takes {} bytes at offset {}, but buffer {} has only {} bytes.",
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

// A file in a view takes all of it (glTF 2.1).
void check_file_view(const Context& context, json::NodeId file, std::uint32_t view,
                     const Path& path) {
  const json::NodeId place = context.document.find(file, "bufferView");
  report_file_use(context, view, place, path);
  if (!context.views.buffer_views[view].byte_stride) return;
  report_link(context, path, place, Code::BUFFER_VIEW_INVALID_BYTE_STRIDE,
              fmt::format("Buffer view {} contains a file, but has a byteStride.", view));
}

// By index of views: whether a file takes all of it. Checks these views.
std::vector<bool> check_file_views(const Context& context) {
  const json::Document& document = context.document;
  std::vector<bool> taken(context.views.buffer_views.size());
  const json::NodeId files = document.find(document.root(), "files");
  if (files == json::kNoNode || document.kind(files) != json::Kind::array) return taken;
  const Path root;
  const Path array(root, "files");
  std::uint64_t index = 0;
  for (const json::NodeId file : document.elements(files)) {
    const Path object(array, index++);
    const auto view = context.asset.index(file, "bufferView", model::RootArray::buffer_views);
    if (!view) continue;
    taken[*view] = true;
    check_file_view(context, file, *view, Path(object, "bufferView"));
  }
  return taken;
}

// What is used as a whole is not used in part, even by accessors that nothing uses (glTF 2.1).
void check_whole_views(const Context& context) {
  if (context.version <= schema::kVersion2) return;
  const std::vector<bool> of_file = check_file_views(context);
  const model::Usage& usage = context.views.usage;
  const Path root;
  const Path array(root, "accessors");
  for (std::uint32_t i = 0; i < context.views.accessors.size(); ++i) {
    const auto view = context.views.accessors[i].buffer_view;
    if (!view || usage.accessor(i).used()) continue;
    const bool of_image = usage.view(*view).has(model::ViewUse::image);
    if (!of_image && !of_file[*view]) continue;
    const Path accessor(array, std::uint64_t{i});
    report_part_of_whole(context, i, *view, of_image ? "an image" : "a file",
                         Path(accessor, "bufferView"));
  }
}

// The subject is the stride, or refers to what uses its view.
bool drop_stride(Fixing& fixing, const Subject& subject) {
  if (subject.name != "byteStride") return remove_used_stride(fixing, subject);
  const auto view = fixing.index(model::RootArray::buffer_views, subject.owner);
  return view && remove_stride(fixing, *view);
}

constexpr FixEntry kStrideFixes[] = {{Code::BUFFER_VIEW_INVALID_BYTE_STRIDE, drop_stride},
                                     {Code::BUFFER_VIEW_TOO_BIG_BYTE_STRIDE, drop_stride}};

}  // namespace

const RuleGroup& buffer_view_rules() {
  static constexpr ObjectRuleEntry kObjectRules[] = {{"bufferView", check_stride, "target"}};
  static constexpr LinkRule kLinkRules[] = {check_extents, check_whole_views};
  static constexpr RuleGroup group{
      .object_rules = kObjectRules, .link_rules = kLinkRules, .fixes = kStrideFixes};
  return group;
}

}  // namespace gltfx::validate

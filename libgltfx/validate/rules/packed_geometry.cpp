// SPDX-License-Identifier: Apache-2.0
// What the JSON says of compressed geometry: KHR_draco_mesh_compression on primitives,
// EXT_meshopt_compression and KHR_meshopt_compression on buffer views. These compare objects with
// the ones they sit on, which no schema file states; this file is about them and names them.
#include <array>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/text.hpp"
#include "model/buffer_view.hpp"
#include "validate/rules/extension_walk.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"
#include "validate/rules/packed_geometry_table.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kDraco = "KHR_draco_mesh_compression";
constexpr std::array<std::string_view, 2> kMeshopt{"EXT_meshopt_compression",
                                                   "KHR_meshopt_compression"};

void report(const Context& context, const Path& path, json::NodeId place, std::string_view code,
            std::string message) {
  context.link_sink.report(path, finding_on(context, place, code, std::move(message)));
}

void check_draco_primitive(const Context& context, const ExtensionPlace& place, const Path& path) {
  const json::Document& document = context.document;
  const auto mode = model::unsigned_member(document, place.host, "mode").value_or(4);
  if (mode <= 6 && mode != 4 && mode != 5) {
    report(context, path, place.object, "DRACO_INVALID_MODE",
           fmt::format("The primitive is {}.", model::mode_name(static_cast<model::Mode>(mode))));
  }
  const json::NodeId packed = model::object_member(document, place.object, "attributes");
  const json::NodeId plain = model::object_member(document, place.host, "attributes");
  if (packed == json::kNoNode || plain == json::kNoNode) return;
  const Path at(path, "attributes");
  for (const auto member : document.members(packed)) {
    if (document.find(plain, member.key_id) != json::kNoNode) continue;
    const std::string_view name = document.key(member.key_id);
    report(context, Path(at, name), member.value, "DRACO_ATTRIBUTE_UNKNOWN",
           fmt::format("The primitive has no attribute {}.", gltfx::quoted(name)));
  }
}

void check_draco(const Context& context) {
  for_each_primitive_extension(context, kDraco, [&](const ExtensionPlace& place, const Path& path) {
    check_draco_primitive(context, place, path);
  });
}

void check_parent(const Context& context, const ExtensionPlace& place, const Path& path) {
  const model::BufferView& parent = context.views.buffer_views[place.index];
  const auto stride = model::unsigned_member(context.document, place.object, "byteStride");
  const auto count = model::unsigned_member(context.document, place.object, "count");
  const auto size = stride && count ? checked_mul(*stride, *count) : std::nullopt;
  if (size && parent.byte_length && *parent.byte_length != *size) {
    report_member(context.link_sink, context, path, place.object, "count",
                  "MESHOPT_LENGTH_MISMATCH",
                  fmt::format("{} elements of {} bytes are {} bytes, the buffer view has {}.",
                              *count, *stride, *size, *parent.byte_length));
  }
  if (stride && parent.byte_stride && *parent.byte_stride != *stride) {
    report_member(
        context.link_sink, context, path, place.object, "byteStride", "MESHOPT_STRIDE_MISMATCH",
        fmt::format("The stride is {}, that of the buffer view {}.", *stride, *parent.byte_stride));
  }
}

void check_packed_range(const Context& context, const ExtensionPlace& place, const Path& path) {
  const json::Document& document = context.document;
  const auto buffer = context.asset.index(place.object, "buffer", model::RootArray::buffers);
  const auto length = model::unsigned_member(document, place.object, "byteLength");
  if (!buffer || !length) return;
  const json::NodeId object = context.asset.elements(model::RootArray::buffers)[*buffer];
  const auto room = model::unsigned_member(document, object, "byteLength");
  const auto offset = model::unsigned_member(document, place.object, "byteOffset").value_or(0);
  const auto end = checked_add(offset, *length);
  if (!room || (end && *end <= *room)) return;
  report_member(context.link_sink, context, path, place.object, "byteLength", "MESHOPT_TOO_LONG",
                fmt::format("{} bytes from byte {} do not fit into buffer {} of {} bytes.", *length,
                            offset, *buffer, *room));
}

// A buffer that only says how large the decoded bytes are has none to read.
void check_fallback(const Context& context, std::string_view extension) {
  const json::Document& document = context.document;
  const auto& buffers = context.asset.elements(model::RootArray::buffers);
  const auto& views = context.views.buffer_views;
  const Path root;
  const Path list(root, "bufferViews");
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].node == json::kNoNode || !views[i].buffer) continue;
    const json::NodeId mark =
        model::extension_object(document, buffers[*views[i].buffer], extension);
    if (mark == json::kNoNode || !model::true_member(document, mark, "fallback")) continue;
    if (model::extension_object(document, views[i].node, extension) != json::kNoNode) continue;
    const Path at(list, i);
    report_member(context.link_sink, context, at, views[i].node, "buffer", "MESHOPT_FALLBACK_USED",
                  fmt::format("Buffer {} stands in for decoded bytes and has none of its own.",
                              *views[i].buffer));
  }
}

void check_meshopt(const Context& context) {
  for (const std::string_view extension : kMeshopt) {
    for_each_extension(context, model::RootArray::buffer_views, extension,
                       [&](const ExtensionPlace& place, const Path& path) {
                         check_parent(context, place, path);
                         check_packed_range(context, place, path);
                       });
    if (has_objects_of(context, extension)) check_fallback(context, extension);
  }
}

constexpr LinkRule kLinkRules[] = {check_meshopt, check_draco};

}  // namespace

const Family& packed_geometry_family() {
  static const Family family{"packed_geometry", packed_geometry_rules(), {}, kLinkRules};
  return family;
}

}  // namespace gltfx::validate

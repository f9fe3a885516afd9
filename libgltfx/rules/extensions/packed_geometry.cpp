// SPDX-License-Identifier: Apache-2.0
// The JSON of compressed geometry: KHR_draco_mesh_compression on primitives,
// EXT_meshopt_compression and KHR_meshopt_compression on buffer views. The rules compare objects
// with their hosts, which no schema file can state; this file is about these extensions and names
// them.
#include <algorithm>
#include <unordered_map>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/accessor.hpp"
#include "model/mesh.hpp"
#include "model/meshopt_view.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kDraco = "KHR_draco_mesh_compression";

// One attribute of the compressed data belongs to one attribute of the primitive.
void check_draco_ids(const Context& context, json::NodeId packed, const Path& path) {
  std::unordered_map<std::uint64_t, std::string_view> known;
  for (const auto member : context.document.members(packed)) {
    const auto id = context.document.unsigned_integer(member.value);
    if (!id) continue;
    const std::string_view name = context.document.key(member.key_id);
    const auto [first, fresh] = known.try_emplace(*id, name);
    if (fresh) continue;
    report_link(context, Path(path, name), member.value, Code::DRACO_ATTRIBUTE_ID_REPEATED,
                fmt::format("The attribute ID {} is already used by {}.", *id,
                            gltfx::quoted(first->second)));
  }
}

bool has_own_data(const Context& context, const std::optional<std::uint32_t>& accessor) {
  return accessor && context.views.accessors[*accessor].buffer_view.has_value();
}

// If the extension is required, readers that cannot decode the geometry do not load the asset.
void check_draco_copy(const Context& context, const ExtensionPlace& place, const Path& path) {
  const auto& required = context.checked.extensions_required;
  if (std::find(required.begin(), required.end(), kDraco) == required.end()) return;
  const json::Document& document = context.document;
  const json::NodeId packed = model::object_member(document, place.object, "attributes");
  const model::Primitive primitive = model::read_primitive(context.asset, place.host);
  const bool copy = has_own_data(context, primitive.indices) ||
                    std::any_of(primitive.attributes.begin(), primitive.attributes.end(),
                                [&](const model::Attribute& each) {
                                  return packed != json::kNoNode &&
                                         document.find(packed, each.name) != json::kNoNode &&
                                         has_own_data(context, each.accessor);
                                });
  if (!copy) return;
  report_link(context, path, place.object, Code::DRACO_COPY_UNREAD,
              "The extension is required, but the primitive also has uncompressed data.");
}

void check_draco_primitive(const Context& context, const ExtensionPlace& place, const Path& path) {
  const json::Document& document = context.document;
  const auto mode = model::unsigned_member(document, place.host, "mode").value_or(4);
  if (mode <= 6 && mode != 4 && mode != 5) {
    report_link(
        context, path, place.object, Code::DRACO_INVALID_MODE,
        fmt::format("The mode of the primitive is {}; it must be TRIANGLES or TRIANGLE_STRIP.",
                    model::mode_name(static_cast<model::Mode>(mode))));
  }
  const json::NodeId packed = model::object_member(document, place.object, "attributes");
  const json::NodeId plain = model::object_member(document, place.host, "attributes");
  if (packed == json::kNoNode || plain == json::kNoNode) return;
  const Path at(path, "attributes");
  check_draco_ids(context, packed, at);
  for (const auto member : document.members(packed)) {
    if (document.find(plain, member.key_id) != json::kNoNode) continue;
    const std::string_view name = document.key(member.key_id);
    report_link(context, Path(at, name), member.value, Code::DRACO_ATTRIBUTE_UNKNOWN,
                fmt::format("The primitive has no attribute {}.", gltfx::quoted(name)));
  }
}

void check_draco(const Context& context) {
  for_each_primitive_extension(context, kDraco, [&](const ExtensionPlace& place, const Path& path) {
    check_draco_primitive(context, place, path);
    check_draco_copy(context, place, path);
  });
}

void check_parent(const Context& context, const ExtensionPlace& place, const Path& path) {
  const model::BufferView& parent = context.views.buffer_views[place.index];
  const auto stride = model::unsigned_member(context.document, place.object, "byteStride");
  const auto count = model::unsigned_member(context.document, place.object, "count");
  const auto size = stride && count ? checked_mul(*stride, *count) : std::nullopt;
  if (size && parent.byte_length && *parent.byte_length != *size) {
    report_member(
        context.link_sink, context, path, place.object, "count", Code::MESHOPT_LENGTH_MISMATCH,
        fmt::format("count {} times byteStride {} is {} bytes, but the buffer view has {}.", *count,
                    *stride, *size, *parent.byte_length));
  }
  if (stride && parent.byte_stride && *parent.byte_stride != *stride) {
    report_member(context.link_sink, context, path, place.object, "byteStride",
                  Code::MESHOPT_STRIDE_MISMATCH,
                  fmt::format("byteStride is {}, but that of the buffer view is {}.", *stride,
                              *parent.byte_stride));
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
  report_member(
      context.link_sink, context, path, place.object, "byteLength", Code::MESHOPT_TOO_LONG,
      fmt::format(
          "The compressed data takes {} bytes at offset {}, but buffer {} has only {} bytes.",
          *length, offset, *buffer, *room));
}

bool is_fallback(const Context& context, json::NodeId buffer, std::string_view extension) {
  const json::NodeId mark = model::extension_object(context.document, buffer, extension);
  return mark != json::kNoNode && model::true_member(context.document, mark, "fallback");
}

// A buffer that only declares the size of the decoded bytes has no bytes to read.
void check_fallback(const Context& context, std::string_view extension) {
  const json::Document& document = context.document;
  const auto& buffers = context.asset.elements(model::RootArray::buffers);
  const auto& views = context.views.buffer_views;
  const Path root;
  const Path list(root, "bufferViews");
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (views[i].node == json::kNoNode || !views[i].buffer) continue;
    if (!is_fallback(context, buffers[*views[i].buffer], extension)) continue;
    if (model::extension_object(document, views[i].node, extension) != json::kNoNode) continue;
    const Path at(list, i);
    report_member(context.link_sink, context, at, views[i].node, "buffer",
                  Code::MESHOPT_FALLBACK_USED,
                  fmt::format("Buffer {} is a fallback buffer without data.", *views[i].buffer));
  }
}

// A fallback buffer has no streams either.
void check_source(const Context& context, std::string_view extension, const ExtensionPlace& place,
                  const Path& path) {
  const auto buffer = context.asset.index(place.object, "buffer", model::RootArray::buffers);
  if (!buffer) return;
  const json::NodeId object = context.asset.elements(model::RootArray::buffers)[*buffer];
  if (!is_fallback(context, object, extension)) return;
  report_member(
      context.link_sink, context, path, place.object, "buffer", Code::MESHOPT_FALLBACK_COMPRESSED,
      fmt::format("Buffer {} is a fallback buffer; it cannot contain compressed data.", *buffer));
}

// The first buffer of a GLB file is the BIN chunk.
void check_first_buffer(const Context& context, std::string_view extension) {
  const auto& buffers = context.asset.elements(model::RootArray::buffers);
  if (context.container.format != container::Format::glb || buffers.empty()) return;
  if (context.document.find(buffers[0], "uri") != json::kNoNode) return;
  if (!is_fallback(context, buffers[0], extension)) return;
  const Path root;
  const Path list(root, "buffers");
  report_link(context, Path(list, std::uint64_t{0}), buffers[0],
              Code::MESHOPT_FALLBACK_FIRST_IN_GLB,
              "The first buffer of the GLB is a fallback buffer; it must be the BIN chunk.");
}

void check_meshopt(const Context& context) {
  for (const std::string_view extension : model::kMeshoptExtensions) {
    for_each_extension(context, model::RootArray::buffer_views, extension,
                       [&](const ExtensionPlace& place, const Path& path) {
                         check_parent(context, place, path);
                         check_packed_range(context, place, path);
                         check_source(context, extension, place, path);
                       });
    if (!has_objects_of(context, extension)) continue;
    check_fallback(context, extension);
    check_first_buffer(context, extension);
  }
}

}  // namespace

const RuleGroup& packed_geometry_rules() {
  static constexpr LinkRule kLinkRules[] = {check_meshopt, check_draco};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

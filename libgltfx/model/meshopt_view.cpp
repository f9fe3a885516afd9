// SPDX-License-Identifier: Apache-2.0
#include "model/meshopt_view.hpp"

#include <string>

#include "base/checked.hpp"
#include "model/fields.hpp"

namespace gltfx::model {
namespace {

constexpr std::array<std::string_view, 3> kModes{"ATTRIBUTES", "TRIANGLES", "INDICES"};
constexpr std::array<std::string_view, 5> kFilters{"NONE", "OCTAHEDRAL", "QUATERNION",
                                                   "EXPONENTIAL", "COLOR"};

template <typename Enum, std::size_t Count>
std::optional<Enum> named(const std::array<std::string_view, Count>& names, std::string_view name,
                          std::size_t count = Count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (names[i] == name) return static_cast<Enum>(i);
  }
  return std::nullopt;
}

// The older extension has neither the second version of attribute streams nor the last filter.
bool is_older(std::string_view extension) { return extension == kMeshoptExtensions[0]; }

std::optional<meshopt::Layout> read_layout(const json::Document& document, json::NodeId object,
                                           std::string_view extension) {
  const auto count = unsigned_member(document, object, "count");
  const auto stride = unsigned_member(document, object, "byteStride");
  const auto mode = named<meshopt::Mode>(kModes, string_member(document, object, "mode"));
  const bool filtered = document.find(object, "filter") != json::kNoNode;
  const auto filter = named<meshopt::Filter>(
      kFilters, filtered ? string_member(document, object, "filter") : std::string(kFilters[0]),
      is_older(extension) ? kFilters.size() - 1 : kFilters.size());
  if (!count || !stride || !mode || !filter) return std::nullopt;
  const meshopt::Layout layout{*count, *stride, *mode, *filter, is_older(extension) ? 0U : 1U};
  return layout.sound() ? std::optional(layout) : std::nullopt;
}

}  // namespace

std::optional<MeshoptView> read_meshopt_view(const Asset& asset, json::NodeId buffer_view) {
  const json::Document& document = asset.document();
  for (const std::string_view extension : kMeshoptExtensions) {
    const json::NodeId object = extension_object(document, buffer_view, extension);
    if (object == json::kNoNode) continue;
    const auto buffer = asset.index(object, "buffer", RootArray::buffers);
    const auto length = unsigned_member(document, object, "byteLength");
    const auto offset = start_of(document, object, unsigned_member(document, object, "byteOffset"));
    const auto layout = read_layout(document, object, extension);
    if (!buffer || !length || !offset || !layout) return std::nullopt;
    return MeshoptView{extension, object, *buffer, *offset, *length, *layout};
  }
  return std::nullopt;
}

std::optional<container::Bytes> stream_bytes(const MeshoptView& view,
                                             const ResourceData& resources) {
  const auto& bytes = resources.buffers[view.buffer];
  if (!bytes || !fits(view.byte_offset, view.byte_length, bytes->size())) return std::nullopt;
  return bytes->part(static_cast<std::size_t>(view.byte_offset),
                     static_cast<std::size_t>(view.byte_length));
}

}  // namespace gltfx::model

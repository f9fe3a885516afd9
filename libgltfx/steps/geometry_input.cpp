// SPDX-License-Identifier: Apache-2.0
#include "steps/geometry_input.hpp"

#include <utility>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "container/opened_files.hpp"
#include "model/accessor_data.hpp"

namespace gltfx::steps {
model::ResourceData load_plain_buffers(const StepInput& input, const model::Asset& elements) {
  container::OpenedFiles files(input.asset.resolver());
  const std::vector<bool> images(elements.count(model::RootArray::images), false);
  model::LoadedResources loaded = model::load_resources(
      input.asset.container(), files, elements, input.asset.views(), input.options.jobs, &images);
  for (model::MissingData& missing : loaded.missing) {
    if (missing.kind != model::MissingData::Kind::buffer) continue;
    input.unread.push_back({fmt::format("/buffers/{}", missing.index), std::move(missing.why)});
  }
  return std::move(loaded.data);
}

model::ResourceData load_buffers(const StepInput& input, const model::Asset& elements) {
  model::ResourceData data = load_plain_buffers(input, elements);
  data.decoded_views.merge(data.unread_views);
  return data;
}

GeometryInput::GeometryInput(const StepInput& input)
    : document(input.asset.document()),
      asset(document),
      views(input.asset.views()),
      graph(document, input.schemas),
      resources(load_buffers(input, asset)) {}

std::string GeometryInput::pointer(json::NodeId value) const { return graph.tree().pointer(value); }

std::optional<std::uint32_t> GeometryInput::accessor_of(const graph::Use& use) const {
  if (use.at.element || use.kind != graph::UseKind::index) return std::nullopt;
  const graph::Tree& tree = graph.tree();
  const json::NodeId object = tree.parent(use.at.node);
  const json::NodeId list = tree.parent(object);
  const json::NodeId accessors = document.find(document.root(), "accessors");
  if (list == json::kNoNode || list != accessors) return std::nullopt;
  const std::uint32_t index = tree.position(object);
  const bool is_own = index < views.accessors.size() && views.accessors[index].node == object;
  return is_own ? std::optional(index) : std::nullopt;
}

std::optional<std::vector<std::uint32_t>> GeometryInput::accessors_of(json::NodeId view) const {
  std::vector<std::uint32_t> accessors;
  for (const graph::Use& use : graph.users(view)) {
    const auto accessor = accessor_of(use);
    if (!accessor) return std::nullopt;
    accessors.push_back(*accessor);
  }
  return accessors;
}

std::optional<std::uint64_t> GeometryInput::end_in_view(const model::Accessor& accessor) const {
  const model::BufferView* view = views.view_of(accessor);
  if (view == nullptr || !accessor.format.known() || !accessor.count) return std::nullopt;
  const auto begin = model::start_of(document, accessor.node, accessor.byte_offset);
  const std::uint64_t stride = view->byte_stride.value_or(model::packed_stride(accessor.format));
  const auto size = accessor.span_size(stride);
  const Checked end = begin && size ? checked_add(*begin, *size) : std::nullopt;
  if (!end || !view->byte_length || *end > *view->byte_length) return std::nullopt;
  const bool has_stride = document.find(view->node, "byteStride") != json::kNoNode;
  if (has_stride != view->byte_stride.has_value()) return std::nullopt;
  return *end;
}

std::optional<std::string> GeometryInput::elements_of(const model::Accessor& accessor) const {
  const auto data =
      model::AccessorData::open(asset, views, resources, accessor, model::Malformed::unusable);
  if (!data || data->implied()) return std::nullopt;
  const std::size_t size =
      std::size_t{data->components()} * model::component_size(data->format().component);
  std::string bytes(static_cast<std::size_t>(data->count()) * size, '\0');
  std::uint64_t next = 0;
  data->read(reinterpret_cast<std::byte*>(bytes.data()), 0, static_cast<std::size_t>(data->count()),
             next);
  return bytes;
}

std::optional<std::string> GeometryInput::elements_of(
    const model::Accessor& accessor, const std::vector<std::uint32_t>& positions) const {
  const auto data =
      model::AccessorData::open(asset, views, resources, accessor, model::Malformed::unusable);
  if (!data || data->implied()) return std::nullopt;
  const std::size_t size =
      std::size_t{data->components()} * model::component_size(data->format().component);
  std::string bytes(positions.size() * size, '\0');
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (positions[i] >= data->count()) return std::nullopt;
    data->read_one(reinterpret_cast<std::byte*>(bytes.data() + i * size), positions[i]);
  }
  return bytes;
}

std::string index_bytes(std::span<const std::uint32_t> indices, model::ComponentType type) {
  const std::size_t size = model::component_size(type);
  std::string bytes(size * indices.size(), '\0');
  for (std::size_t i = 0; i < indices.size(); ++i) {
    for (std::size_t k = 0; k < size; ++k)
      bytes[i * size + k] = static_cast<char>(indices[i] >> (8 * k) & 0xFFU);
  }
  return bytes;
}

}  // namespace gltfx::steps

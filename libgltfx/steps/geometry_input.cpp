// SPDX-License-Identifier: Apache-2.0
#include "steps/geometry_input.hpp"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "base/checked.hpp"
#include "base/text.hpp"
#include "model/accessor_data.hpp"
#include "steps/step_data.hpp"

namespace gltfx::steps {
GeometryInput::GeometryInput(const StepInput& input)
    : asset(input.asset.document()),
      views(input.asset.views()),
      graph(input.asset.document(), input.schemas),
      resources(load_buffers(input, asset)) {}

std::string GeometryInput::pointer(json::NodeId value) const { return graph.tree().pointer(value); }

std::optional<std::uint32_t> GeometryInput::accessor_of(const graph::Use& use) const {
  if (use.at.element || use.kind != graph::UseKind::index) return std::nullopt;
  const graph::Tree& tree = graph.tree();
  const json::NodeId object = tree.parent(use.at.node);
  const json::NodeId list = tree.parent(object);
  const json::NodeId accessors = asset.document().find(asset.document().root(), "accessors");
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
  const auto begin = model::start_of(asset.document(), accessor.node, accessor.byte_offset);
  const std::uint64_t stride = view->byte_stride.value_or(model::packed_stride(accessor.format));
  const auto size = accessor.span_size(stride);
  const Checked end = begin && size ? checked_add(*begin, *size) : std::nullopt;
  if (!end || !view->byte_length || *end > *view->byte_length) return std::nullopt;
  const bool has_stride = asset.document().find(view->node, "byteStride") != json::kNoNode;
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

void set_number(const json::Document& document, json::Editor& editor, json::NodeId object,
                std::string_view name, std::uint64_t value) {
  const json::NodeId old = document.find(object, name);
  if (old == json::kNoNode) {
    editor.append_member(object, name, std::to_string(value));
  } else {
    editor.replace(object, old, std::to_string(value));
  }
}

void remove_member(const json::Document& document, json::Editor& editor, json::NodeId object,
                   std::string_view name) {
  const json::NodeId value = document.find(object, name);
  if (value != json::kNoNode) editor.remove(object, value - 1);
}

void add_extension(const json::Document& document, json::Editor& editor, json::NodeId host,
                   std::string_view name, std::string_view json) {
  const json::NodeId extensions = document.find(host, "extensions");
  if (extensions != json::kNoNode) {
    editor.append_member(extensions, name, json);
  } else {
    editor.append_member(host, "extensions", fmt::format(R"({{"{}":{}}})", name, json));
  }
}

void remove_extension(const json::Document& document, json::Editor& editor, json::NodeId host,
                      std::string_view name) {
  const json::NodeId extensions = document.find(host, "extensions");
  const json::NodeId object = document.find(extensions, name);
  if (object == json::kNoNode) return;
  if (document.object_size(extensions) == 1) {
    editor.remove(host, extensions - 1);
  } else {
    editor.remove(extensions, object - 1);
  }
}

bool require_extension(const json::Document& document, json::Editor& editor,
                       std::string_view name) {
  std::array lists{change::NameList(document, "extensionsUsed"),
                   change::NameList(document, "extensionsRequired")};
  for (change::NameList& list : lists) {
    if (!list.can_change()) return false;
    list.add(name);
  }
  for (const change::NameList& list : lists) list.apply(editor);
  return true;
}

}  // namespace gltfx::steps

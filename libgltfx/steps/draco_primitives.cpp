// SPDX-License-Identifier: Apache-2.0
#include "steps/draco_primitives.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"
#include "graph/unknown_indices.hpp"
#include "model/draco.hpp"
#include "model/fields.hpp"
#include "steps/view_pool.hpp"

namespace gltfx::steps {
namespace {

using codec::Component;
using codec::DracoUse;
using model::ComponentType;

bool holds_number(const json::Document& document, json::NodeId object) {
  for (json::NodeId id = object; id < document.next(object); ++id) {
    const json::Kind kind = document.kind(id);
    if (kind == json::Kind::number || kind == json::Kind::number_array) return true;
  }
  return false;
}

std::optional<Component> component_of(ComponentType type) {
  switch (type) {
    case ComponentType::int8:
      return Component::int8;
    case ComponentType::uint8:
      return Component::uint8;
    case ComponentType::int16:
      return Component::int16;
    case ComponentType::uint16:
      return Component::uint16;
    case ComponentType::uint32:
      return Component::uint32;
    case ComponentType::float32:
      return Component::float32;
    default:
      return std::nullopt;
  }
}

DracoUse use_of(model::SemanticKind kind) {
  switch (kind) {
    case model::SemanticKind::position:
      return DracoUse::position;
    case model::SemanticKind::normal:
      return DracoUse::normal;
    case model::SemanticKind::color:
      return DracoUse::color;
    case model::SemanticKind::texcoord:
      return DracoUse::tex_coord;
    default:
      return DracoUse::generic;
  }
}

std::vector<std::uint32_t> widen(const std::string& bytes, std::size_t size) {
  std::vector<std::uint32_t> numbers(bytes.size() / size);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::memcpy(&numbers[i], bytes.data() + i * size, size);
  }
  return numbers;
}

/// Indices of any mode as a list of triangles.
class TriangleList {
 public:
  TriangleList(model::Mode mode, const std::vector<std::uint32_t>& indices) : indices_(indices) {
    if (mode == model::Mode::triangles) list_ = indices;
    for (std::size_t i = 2; mode != model::Mode::triangles && i < indices.size(); ++i) {
      const bool fan = mode == model::Mode::triangle_fan;
      if (fan) add(0, i - 1, i);
      // Every second triangle of a strip has the opposite winding.
      if (!fan && i % 2 == 0) add(i - 2, i - 1, i);
      if (!fan && i % 2 == 1) add(i - 1, i - 2, i);
    }
  }
  std::vector<std::uint32_t> take() { return std::move(list_); }

 private:
  // Skips triangles that repeat a vertex.
  void add(std::size_t a, std::size_t b, std::size_t c) {
    const std::uint32_t x = indices_[a];
    const std::uint32_t y = indices_[b];
    const std::uint32_t z = indices_[c];
    if (x != y && y != z && z != x) list_.insert(list_.end(), {x, y, z});
  }

  const std::vector<std::uint32_t>& indices_;
  std::vector<std::uint32_t> list_;
};

bool has_repeated_corner(const std::vector<std::uint32_t>& list) {
  for (std::size_t i = 0; i + 2 < list.size(); i += 3) {
    if (list[i] == list[i + 1] || list[i + 1] == list[i + 2] || list[i + 2] == list[i]) return true;
  }
  return false;
}

Result<std::vector<std::uint32_t>> read_triangles(const GeometryInput& input,
                                                  const model::Primitive& primitive,
                                                  std::uint32_t points) {
  std::vector<std::uint32_t> indices(points);
  std::iota(indices.begin(), indices.end(), 0U);
  if (primitive.indices) {
    const model::Accessor& accessor = input.views.accessors[*primitive.indices];
    if (accessor.format.type != model::ElementType::scalar ||
        !model::can_index_elements(accessor.format.component)) {
      return Error{"its indices are not integers"};
    }
    const auto bytes = input.elements_of(accessor);
    if (!bytes) return Error{"its indices cannot be read"};
    indices = widen(*bytes, model::component_size(accessor.format.component));
  }
  if (std::any_of(indices.begin(), indices.end(),
                  [&](std::uint32_t index) { return index >= points; })) {
    return Error{"one of its indices is out of range"};
  }
  if (primitive.mode == model::Mode::triangles && indices.size() % 3 != 0) {
    return Error{"its last triangle is incomplete"};
  }
  auto list = TriangleList(*primitive.mode, indices).take();
  if (list.empty()) return Error{"it has no triangles"};
  if (has_repeated_corner(list)) return Error{"Draco does not keep triangles that repeat a vertex"};
  return list;
}

// Omits vertices that no triangle uses, if there are many: other primitives may share the vertices.
// Returns the old positions of the others; empty: all stay.
std::vector<std::uint32_t> take_used(DracoSource& source) {
  if (source.triangles.size() >= source.mesh.points) return {};
  std::vector<std::uint32_t> used = source.triangles;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (std::uint32_t& corner : source.triangles) {
    const auto found = std::lower_bound(used.begin(), used.end(), corner);
    corner = static_cast<std::uint32_t>(found - used.begin());
  }
  source.mesh.points = static_cast<std::uint32_t>(used.size());
  return used;
}

}  // namespace

DracoPrimitives::DracoPrimitives(const GeometryInput& input, StepOutcome& outcome)
    : input_(input), outcome_(outcome), meant_(unknown_integers(input.graph)) {
  for (const model::Mesh& mesh : input.views.meshes) {
    for (const model::Primitive& primitive : mesh.primitives) {
      if (primitive.node == json::kNoNode) continue;
      DracoPrimitive& each = all_.emplace_back(DracoPrimitive{&primitive, mesh.node, false, {}});
      for (const model::Attribute& attribute : primitive.attributes) {
        if (attribute.accessor) each.accessors.push_back(*attribute.accessor);
      }
      if (primitive.indices) each.accessors.push_back(*primitive.indices);
      for (const std::uint32_t accessor : each.accessors) {
        users_[accessor].push_back(all_.size() - 1);
        ++places_[accessor];
      }
    }
  }
  find_unknown();
  for (std::size_t i = 0; i < all_.size(); ++i) {
    if (!all_[i].stays) consider(i);
  }
}

void DracoPrimitives::leave(std::size_t index, std::string reason) {
  if (all_[index].stays) return;
  outcome_.row.left.push_back({input_.pointer(all_[index].primitive->node), std::move(reason)});
  stay(index);
}

void DracoPrimitives::refuse(std::size_t index, std::string reason) {
  if (all_[index].stays) return;
  outcome_.row.refused.push_back({input_.pointer(all_[index].primitive->node), std::move(reason)});
  stay(index);
}

// All primitives that share accessors with it, directly or indirectly, also stay.
void DracoPrimitives::stay(std::size_t index) {
  all_[index].stays = true;
  std::vector<std::size_t> open{index};
  while (!open.empty()) {
    const std::size_t next = open.back();
    open.pop_back();
    for (const std::uint32_t accessor : all_[next].accessors) {
      const auto users = users_.extract(accessor);
      if (users.empty()) continue;
      for (const std::size_t user : users.mapped()) {
        if (all_[user].stays) continue;
        all_[user].stays = true;
        outcome_.row.left.push_back({input_.pointer(all_[user].primitive->node),
                                     fmt::format("it shares /accessors/{} with {}", accessor,
                                                 input_.pointer(all_[next].primitive->node))});
        open.push_back(user);
      }
    }
  }
}

void DracoPrimitives::consider(std::size_t index) {
  const model::Primitive& primitive = *all_[index].primitive;
  const json::Document& document = input_.asset.document();
  const json::NodeId extensions = document.find(primitive.node, "extensions");
  if (document.find(extensions, model::kDracoExtension) != json::kNoNode) {
    return leave(index, "it is already compressed");
  }
  if (!primitive.mode || !model::draws_triangles(*primitive.mode)) {
    return leave(index, "it has no triangles");
  }
  if (primitive.targets_are_broken || document.find(primitive.node, "targets") != json::kNoNode) {
    return leave(index, "it has morph targets");
  }
  if (find_extension_obstacle(index)) return;
  for (const model::Attribute& attribute : primitive.attributes) {
    if (!attribute.accessor) return refuse(index, "it has an attribute without an accessor");
  }
  if (primitive.find(model::SemanticKind::position) == nullptr) {
    return leave(index, "it has no positions");
  }
  if (primitive.indices_node != json::kNoNode && !primitive.indices) {
    return refuse(index, "its indices have no accessor");
  }
  for (const std::uint32_t accessor : all_[index].accessors) {
    std::string why = find_accessor_obstacle(accessor);
    if (!why.empty()) return leave(index, std::move(why));
    const model::BufferView& view = *input_.views.view_of(input_.views.accessors[accessor]);
    if (!input_.end_in_view(input_.views.accessors[accessor])) {
      return refuse(index,
                    fmt::format("/accessors/{} does not fit into its buffer view (see 'gltfx fix')",
                                accessor));
    }
    if (!input_.resources.part(document, view, 0, *view.byte_length)) {
      return refuse(index, fmt::format("the bytes of /accessors/{} are missing", accessor));
    }
    if (!meant_.contains(accessor)) continue;
    const json::NodeId unknown = graph::find_unknown_with_integer(input_.graph);
    return refuse(index, fmt::format("an extension such as {} may hold the index of /accessors/{} "
                                     "(describe it with --schema)",
                                     printable(input_.pointer(unknown)), accessor));
  }
}

void DracoPrimitives::find_unknown() {
  const graph::Tree& tree = input_.graph.tree();
  const json::Document& document = input_.asset.document();
  const json::NodeId meshes = document.find(document.root(), "meshes");
  for (const json::NodeId object : input_.graph.unknown_extensions()) {
    const json::NodeId element = tree.root_element(object);
    if (element == json::kNoNode || tree.parent(element) != meshes) continue;
    if (!holds_number(document, object)) continue;
    if (tree.parent(tree.parent(object)) == element) {
      unknown_.emplace(element, object);
      continue;
    }
    // The object is in a primitive: find it below the list of primitives.
    json::NodeId host = object;
    while (tree.parent(tree.parent(host)) != element) host = tree.parent(host);
    unknown_.emplace(host, object);
  }
}

// Whether extensions may contain data that depends on the order of vertices or triangles.
bool DracoPrimitives::find_extension_obstacle(std::size_t index) {
  const json::Document& document = input_.asset.document();
  const json::NodeId primitive = all_[index].primitive->node;
  for (const json::NodeId host : {primitive, all_[index].mesh}) {
    const auto found = unknown_.find(host);
    if (found == unknown_.end()) continue;
    refuse(index, fmt::format("{} may hold data about its vertices (describe it with --schema)",
                              printable(input_.pointer(found->second))));
    return true;
  }
  const json::NodeId extensions = model::object_member(document, primitive, "extensions");
  if (extensions == json::kNoNode) return false;
  for (const auto member : document.members(extensions)) {
    const json::NodeId accessors = document.find(document.root(), "accessors");
    std::set<json::NodeId> references;
    bool to_accessor = false;
    input_.graph.each_use_in(member.value, [&](const graph::Use& use) {
      references.insert(use.at.node);
      to_accessor = to_accessor || input_.graph.tree().parent(use.target) == accessors;
    });
    bool numbers = to_accessor;
    for (json::NodeId id = member.value; id < document.next(member.value); ++id) {
      const bool number =
          document.kind(id) == json::Kind::number || document.kind(id) == json::Kind::number_array;
      numbers = numbers || (number && !references.contains(id));
    }
    if (!numbers) continue;
    leave(index, fmt::format("its {} may depend on the order of its vertices",
                             gltfx::quoted(document.key(member.key_id))));
    return true;
  }
  return false;
}

std::string DracoPrimitives::find_accessor_obstacle(std::uint32_t index) const {
  const json::Document& document = input_.asset.document();
  const model::Accessor& accessor = input_.views.accessors[index];
  if (input_.graph.users(accessor.node).size() != places_.at(index)) {
    return fmt::format("/accessors/{} has other users", index);
  }
  if (accessor.sparse != json::kNoNode) return fmt::format("/accessors/{} is sparse", index);
  if (!accessor.buffer_view) return fmt::format("/accessors/{} has no bytes", index);
  if (document.find(accessor.node, "extensions") != json::kNoNode) {
    return fmt::format("/accessors/{} has extensions", index);
  }
  const json::NodeId view = input_.views.buffer_views[*accessor.buffer_view].node;
  if (document.find(view, "extensions") != json::kNoNode) {
    return fmt::format("/bufferViews/{} has extensions", *accessor.buffer_view);
  }
  return {};
}

Result<DracoSource> read_source(const GeometryInput& input, const DracoPrimitive& primitive) {
  DracoSource source;
  const auto& attributes = primitive.primitive->attributes;
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const model::Accessor& accessor = input.views.accessors[*attributes[i].accessor];
    const auto component = component_of(accessor.format.component);
    const unsigned components = model::component_count(accessor.format.type);
    if (!component || components == 0 || components > 4 || model::is_matrix(accessor.format.type)) {
      return Error{fmt::format("Draco has no type for {}", gltfx::quoted(attributes[i].name))};
    }
    if (!accessor.count || *accessor.count > UINT32_MAX) {
      return Error{fmt::format("{} has no count", gltfx::quoted(attributes[i].name))};
    }
    if (i == 0) source.mesh.points = static_cast<std::uint32_t>(*accessor.count);
    if (*accessor.count != source.mesh.points) return Error{"its attributes have different counts"};
    codec::DracoAttribute& added = source.mesh.attributes.emplace_back();
    added.id = static_cast<std::uint32_t>(i);
    added.component = *component;
    added.components = components;
    added.normalized = accessor.format.normalized;
    added.use =
        attributes[i].name == "POSITION" ? DracoUse::position : use_of(attributes[i].semantic.kind);
  }
  auto triangles = read_triangles(input, *primitive.primitive, source.mesh.points);
  if (!triangles) return triangles.error();
  source.triangles = *std::move(triangles);
  const std::vector<std::uint32_t> used = take_used(source);
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const model::Accessor& accessor = input.views.accessors[*attributes[i].accessor];
    auto bytes = used.empty() ? input.elements_of(accessor) : input.elements_of(accessor, used);
    if (!bytes) {
      return Error{
          fmt::format("{} cannot be read (see 'gltfx fix')", gltfx::quoted(attributes[i].name))};
    }
    source.values.push_back(*std::move(bytes));
  }
  source.mesh.faces = static_cast<std::uint32_t>(source.triangles.size() / 3);
  source.mesh.indices = source.triangles;
  for (std::size_t i = 0; i < source.values.size(); ++i) {
    source.mesh.attributes[i].values = std::as_bytes(std::span(source.values[i]));
  }
  return source;
}

}  // namespace gltfx::steps

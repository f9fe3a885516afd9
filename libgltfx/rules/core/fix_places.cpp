// SPDX-License-Identifier: Apache-2.0
// Fixes that depend on which vertices or elements are used.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "model/accessor_data.hpp"
#include "rules/core/fix_data.hpp"
#include "rules/core/fix_elements.hpp"
#include "rules/fix_users.hpp"

namespace gltfx::validate {
namespace {

using model::AccessorData;

// Marks the vertices that a primitive draws. False: all of them, or unknown.
bool mark_drawn(Fixing& fixing, const model::Primitive& primitive, std::vector<bool>& drawn) {
  if (!primitive.indices) return false;
  const model::Accessor& accessor = fixing.views().accessors[*primitive.indices];
  const auto data = AccessorData::open(fixing.elements(), fixing.views(), fixing.resources(),
                                       accessor, model::Malformed::unusable);
  if (!data || data->implied() || data->components() != 1) return false;
  model::with_component_type(data->format().component, [&](auto type) {
    data->visit<decltype(type)>([&](const auto* values, std::size_t count, std::uint64_t) {
      for (std::size_t i = 0; i < count; ++i) {
        const auto index = static_cast<double>(values[i]);
        if (index >= 0 && index < static_cast<double>(drawn.size())) {
          drawn[static_cast<std::size_t>(index)] = true;
        }
      }
    });
  });
  return true;
}

// The vertices of an attribute that are drawn; empty: unknown.
std::vector<bool> drawn_vertices(Fixing& fixing, std::uint32_t accessor, std::uint64_t count) {
  std::vector<bool> drawn(static_cast<std::size_t>(count));
  bool any = false;
  for (const model::Mesh& mesh : fixing.views().meshes) {
    for (const model::Primitive& primitive : mesh.primitives) {
      const bool uses = std::any_of(
          primitive.attributes.begin(), primitive.attributes.end(),
          [&](const model::Attribute& attribute) { return attribute.accessor == accessor; });
      if (!uses) continue;
      if (!mark_drawn(fixing, primitive, drawn)) return {};
      any = true;
    }
  }
  return any ? drawn : std::vector<bool>();
}

bool is_finite(const Elements& elements, std::uint64_t element) {
  for (unsigned c = 0; c < elements.components(); ++c) {
    if (!std::isfinite(elements.get(element, c))) return false;
  }
  return true;
}

}  // namespace

bool fill_unused_vertices(Fixing& fixing, const Subject& subject) {
  const auto accessor = fixing.index(model::RootArray::accessors, subject.value);
  if (!accessor) return false;
  const auto& roles = fixing.table<Users>().roles_of(*accessor);
  if (roles.size() != 1 || roles.begin()->starts_with("target ")) return false;
  auto elements = open_elements(fixing, *accessor, *roles.begin());
  if (!elements || !elements->is_float()) return false;
  const auto drawn = drawn_vertices(fixing, *accessor, elements->count());
  if (drawn.empty()) return false;
  std::optional<std::uint64_t> sound;
  std::vector<std::uint64_t> broken;
  for (std::uint64_t i = 0; i < elements->count(); ++i) {
    if (!is_finite(*elements, i)) {
      if (drawn[static_cast<std::size_t>(i)]) return false;
      broken.push_back(i);
    } else if (!sound) {
      sound = i;
    }
  }
  if (!sound || broken.empty()) return false;
  const std::string copy = elements->bytes(*sound);
  for (const std::uint64_t i : broken) elements->set_bytes(i, copy);
  follow_with_bounds(fixing, *accessor, *elements);
  return true;
}

bool sort_sparse(Fixing& fixing, const Subject& subject) {
  if (!fixing.graph().unknown_extensions().empty()) return false;
  const Users& users = fixing.table<Users>();
  const auto index = fixing.index(model::RootArray::accessors, subject.owner);
  if (!index || !fixing.claim(subject.value)) return false;
  const model::Accessor& accessor = fixing.views().accessors[*index];
  const auto sparse = model::read_sparse(fixing.elements(), accessor);
  if (!sparse || !sparse->indices.buffer_view || !sparse->values.buffer_view) return false;
  const auto indices =
      model::sparse_indices(fixing.elements(), fixing.views(), fixing.resources(), *sparse);
  const model::BufferView& keys = fixing.views().buffer_views[*sparse->indices.buffer_view];
  const model::BufferView& values = fixing.views().buffer_views[*sparse->values.buffer_view];
  for (const auto view : {*sparse->indices.buffer_view, *sparse->values.buffer_view}) {
    const bool alone = users.lies_apart(view) &&
                       fixing.views().usage.view(view).only() == model::ViewUse::other &&
                       users.accessors_in(view).empty() && users.sparse_parts_in(view).size() == 1;
    const model::BufferView& part = fixing.views().buffer_views[view];
    const bool compressed = fixing.document().find(part.node, "extensions") != json::kNoNode;
    if (!alone || compressed || part.byte_stride) return false;
  }
  if (!indices || !keys.buffer || !values.buffer) return false;
  const std::uint64_t count = *sparse->count;
  const std::uint64_t key_size = model::component_size(sparse->indices.format.component);
  const std::uint64_t value_size = std::uint64_t{model::component_count(accessor.format.type)} *
                                   model::component_size(accessor.format.component);
  const std::uint64_t key_begin =
      keys.byte_offset.value_or(0) + sparse->indices.byte_offset.value_or(0);
  const std::uint64_t value_begin =
      values.byte_offset.value_or(0) + sparse->values.byte_offset.value_or(0);
  std::vector<std::uint64_t> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), std::uint64_t{0});
  std::sort(order.begin(), order.end(), [&](std::uint64_t a, std::uint64_t b) {
    return indices->index(a) < indices->index(b);
  });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (indices->index(order[i - 1]) == indices->index(order[i]))
      return false;  // it is unclear which one applies
  }
  const auto rearrange = [&](std::uint32_t buffer, std::uint64_t begin, std::uint64_t size) {
    std::string* content = fixing.content(buffer);
    if (content == nullptr || begin > content->size() || count * size > content->size() - begin) {
      return false;
    }
    std::string sorted;
    for (const std::uint64_t from : order) {
      sorted += std::string_view(*content).substr(begin + from * size, size);
    }
    content->replace(begin, sorted.size(), sorted);
    return true;
  };
  return rearrange(*keys.buffer, key_begin, key_size) &&
         rearrange(*values.buffer, value_begin, value_size);
}

}  // namespace gltfx::validate

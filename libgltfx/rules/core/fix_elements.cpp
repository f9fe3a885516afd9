// SPDX-License-Identifier: Apache-2.0
#include "rules/core/fix_elements.hpp"

#include <algorithm>
#include <cmath>

#include "base/checked.hpp"
#include "model/accessor_data.hpp"
#include "rules/fix_users.hpp"

namespace gltfx::validate {
namespace {

using model::Accessor;
using model::BufferView;
using model::ComponentType;

// Limit, because each accessor of a view is compared with all others.
constexpr std::size_t kMostNeighbours = 4096;

std::uint64_t stride_of(const BufferView& view, const Accessor& accessor) {
  return view.byte_stride.value_or(model::packed_stride(accessor.format));
}

/// Bytes of an accessor within its view.
struct Extent {
  std::uint64_t begin, end, stride, size;
};

std::optional<Extent> extent_of(const BufferView& view, const Accessor& accessor) {
  const std::uint64_t stride = stride_of(view, accessor);
  const std::uint64_t size = model::element_size(accessor.format);
  if (!accessor.count || size == 0 || stride < size) return std::nullopt;
  const auto length = accessor.span_size(stride);
  const std::uint64_t begin = accessor.byte_offset.value_or(0);
  const Checked end = length ? checked_add(begin, *length) : Checked();
  if (!end) return std::nullopt;
  return Extent{begin, *end, stride, size};
}

// Elements of one stride do not overlap if their offsets within the stride do not.
bool lie_apart(const Extent& a, const Extent& b) {
  if (a.end <= b.begin || b.end <= a.begin) return true;
  if (a.stride != b.stride) return false;
  const std::uint64_t from = a.begin % a.stride;
  const std::uint64_t other = b.begin % b.stride;
  return from < other ? from + a.size <= other && other + b.size <= from + a.stride
                      : other + b.size <= from && from + a.size <= other + b.stride;
}

bool is_alone(Fixing& fixing, std::uint32_t index, const Extent& own) {
  const Accessor& accessor = fixing.views().accessors[index];
  const BufferView& view = fixing.views().buffer_views[*accessor.buffer_view];
  const auto& neighbours = fixing.table<Users>().accessors_in(*accessor.buffer_view);
  if (neighbours.size() > kMostNeighbours) return false;
  return std::all_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t other) {
    if (other == index) return true;
    const auto extent = extent_of(view, fixing.views().accessors[other]);
    return extent && lie_apart(own, *extent);
  });
}

}  // namespace

ReadBudget::ReadBudget(Fixing& fixing) {
  for (const auto& buffer : fixing.resources().buffers) left_ += buffer ? buffer->size() * 4 : 0;
}

bool ReadBudget::take(std::uint64_t count, unsigned components) {
  const Checked cost = checked_mul(count, components);
  if (!cost || *cost > left_) return false;
  left_ -= *cost;
  return true;
}

std::optional<Elements> open_elements(Fixing& fixing, std::uint32_t index, std::string_view role) {
  if (index >= fixing.views().accessors.size()) return std::nullopt;
  const Accessor& accessor = fixing.views().accessors[index];
  const bool plain = accessor.buffer_view && accessor.sparse == json::kNoNode &&
                     model::is_core_component(accessor.format.component) &&
                     !model::is_matrix(accessor.format.type);
  const bool floats = accessor.format.component == ComponentType::float32;
  if (!plain && !(floats && accessor.buffer_view && accessor.sparse == json::kNoNode)) {
    return std::nullopt;
  }
  const Users& users = fixing.table<Users>();
  const auto& roles = users.roles_of(index);
  const bool fits_role = role.empty() || (roles.size() == 1 && *roles.begin() == role);
  const std::uint32_t view_index = *accessor.buffer_view;
  if (!fits_role || users.has_others(view_index) || !users.sparse_parts_in(view_index).empty() ||
      !users.lies_apart(view_index) ||
      fixing.views().usage.view(view_index).has(model::ViewUse::image)) {
    return std::nullopt;
  }
  const BufferView& view = fixing.views().buffer_views[view_index];
  const auto extent = extent_of(view, accessor);
  if (!extent || !view.buffer || !view.byte_length || !is_alone(fixing, index, *extent)) {
    return std::nullopt;
  }
  const Checked begin = checked_add(view.byte_offset.value_or(0), extent->begin);
  std::string* content = fixing.content(*view.buffer);
  if (content == nullptr || !begin || extent->end > *view.byte_length ||
      !fits(*begin, extent->end - extent->begin, content->size()) ||
      fixing.is_claimed(accessor.node)) {
    return std::nullopt;
  }
  return Elements(*content, accessor.format, *accessor.count, *begin, extent->stride);
}

void follow_with_bounds(Fixing& fixing, std::uint32_t index, const Elements& elements) {
  const Accessor& accessor = fixing.views().accessors[index];
  fixing.claim(accessor.node);
  for (const json::NodeId array : {accessor.min, accessor.max}) {
    if (array == json::kNoNode) continue;
    if (!model::is_sound_bound(fixing.document(), accessor.format, array)) continue;
    const bool minimum = array == accessor.min;
    std::vector<double> bound(elements.components());
    for (unsigned c = 0; c < elements.components(); ++c) {
      bound[c] = elements.get(0, c);
      for (std::uint64_t i = 1; i < elements.count(); ++i) {
        const double value = elements.get(i, c);
        bound[c] = minimum ? std::min(bound[c], value) : std::max(bound[c], value);
      }
    }
    if (fixing.claim(array)) {
      correct_numbers(fixing, accessor.format.component, array, bound);
    }
  }
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
#include "rules/fix_users.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "base/checked.hpp"

namespace gltfx::validate {

using model::ViewUse;

namespace {

// Among the objects that refer to accessors, the other elements of arrays are samplers and
// primitives.
bool is_morph_target(Fixing& fixing, json::NodeId object) {
  const graph::Tree& tree = fixing.tree();
  return !tree.is_member(object) && tree.member(object, "input") == json::kNoNode &&
         tree.member(object, "attributes") == json::kNoNode;
}

}  // namespace

Users::Users(Fixing& fixing)
    : views_(fixing.views()),
      accessors_(views_.buffer_views.size()),
      others_(views_.buffer_views.size()),
      overlaps_(views_.buffer_views.size()),
      sparse_parts_(views_.buffer_views.size()),
      roles_(views_.accessors.size()),
      unknown_(!fixing.graph().unknown_extensions().empty()) {
  read(fixing);
  find_others(fixing);
  find_roles(fixing);
  find_overlaps();
}

void Users::read(Fixing& fixing) {
  for (std::uint32_t i = 0; i < views_.accessors.size(); ++i) {
    const model::Accessor& accessor = views_.accessors[i];
    if (accessor.buffer_view) accessors_[*accessor.buffer_view].push_back(i);
    const auto sparse = model::read_sparse(fixing.elements(), accessor);
    if (!sparse) continue;
    for (const model::SparsePart* part : {&sparse->indices, &sparse->values}) {
      sparse_objects_.insert(part->node);
      if (!part->buffer_view) continue;
      sparse_parts_[*part->buffer_view].push_back(
          {sparse->count.value_or(0), std::uint64_t{model::component_size(part->format.component)} *
                                          model::component_count(part->format.type)});
    }
  }
}

// References from objects that are neither accessors nor images, such as objects of extensions.
void Users::find_others(Fixing& fixing) {
  const graph::Tree& tree = fixing.tree();
  const auto is_known = [&](json::NodeId object) {
    if (sparse_objects_.contains(object)) return true;
    if (object == json::kNoNode || tree.root_element(object) != object) return false;
    const std::string_view array = tree.name(tree.parent(object));
    return array == "accessors" || array == "images";
  };
  for (std::size_t i = 0; i < others_.size(); ++i) {
    const json::NodeId view = views_.buffer_views[i].node;
    const auto users = fixing.graph().users(view);
    others_[i] = fixing.document().find(view, "extensions") != json::kNoNode ||
                 !std::all_of(users.begin(), users.end(), [&](const graph::Use& use) {
                   return is_known(tree.parent(use.at.node));
                 });
  }
}

void Users::find_roles(Fixing& fixing) {
  const graph::Tree& tree = fixing.tree();
  for (std::size_t i = 0; i < roles_.size(); ++i) {
    for (const graph::Use& use : fixing.graph().users(views_.accessors[i].node)) {
      const bool member = !use.at.element && tree.is_member(use.at.node);
      std::string name(member ? tree.name(use.at.node) : std::string_view());
      if (member && is_morph_target(fixing, tree.parent(use.at.node))) name.insert(0, "target ");
      roles_[i].insert(std::move(name));
    }
  }
}

// In the order of their first bytes, a view overlaps the previous one if it begins before that
// ends.
void Users::find_overlaps() {
  struct Range {
    std::uint64_t begin, end;
    std::uint32_t buffer, view;
  };
  std::vector<Range> ranges;
  for (std::uint32_t i = 0; i < views_.buffer_views.size(); ++i) {
    const model::BufferView& view = views_.buffer_views[i];
    const std::uint64_t begin = view.byte_offset.value_or(0);
    if (!view.buffer) continue;
    ranges.push_back({begin, saturating_add(begin, view.byte_length.value_or(0)), *view.buffer, i});
  }
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) {
    return std::tie(a.buffer, a.begin) < std::tie(b.buffer, b.begin);
  });
  const Range* furthest = nullptr;
  for (const Range& range : ranges) {
    const bool same = furthest != nullptr && furthest->buffer == range.buffer;
    if (same && range.begin < furthest->end) {
      overlaps_[range.view] = overlaps_[furthest->view] = true;
    }
    if (!same || range.end > furthest->end) furthest = &range;
  }
}

std::vector<const model::Primitive*> primitives_with(Fixing& fixing, std::uint32_t accessor) {
  const graph::Tree& tree = fixing.tree();
  std::vector<const model::Primitive*> found;
  for (const graph::Use& use : fixing.graph().users(fixing.views().accessors[accessor].node)) {
    const json::NodeId attributes = tree.parent(use.at.node);
    const json::NodeId mesh = tree.root_element(attributes);
    const auto index = fixing.index(model::RootArray::meshes, mesh);
    if (!index) continue;
    const model::Mesh& of = fixing.views().meshes[*index];
    const std::uint32_t position = tree.position(tree.parent(attributes));
    const bool is_primitive =
        position < of.primitives.size() && of.primitives[position].attributes_node == attributes;
    if (is_primitive) found.push_back(&of.primitives[position]);
  }
  return found;
}

bool remove_stride(Fixing& fixing, std::uint32_t view) {
  const model::BufferView& strided = fixing.views().buffer_views[view];
  const json::NodeId member = fixing.document().find(strided.node, "byteStride");
  if (fixing.is_claimed(member)) return false;
  const Users& users = fixing.table<Users>();
  if (member == json::kNoNode || users.has_others(view)) return false;
  const auto& accessors = users.accessors_in(view);
  // Attributes that share a view need its stride.
  if (fixing.views().usage.view(view).has(ViewUse::vertices) && accessors.size() > 1) return false;
  const auto stays = [&](std::uint64_t count, std::uint64_t size) {
    return count == 1 || strided.byte_stride == size;
  };
  const auto& sparse = users.sparse_parts_in(view);
  const bool in_place =
      std::all_of(accessors.begin(), accessors.end(),
                  [&](std::uint32_t index) {
                    const model::Accessor& accessor = fixing.views().accessors[index];
                    return stays(accessor.count.value_or(0), model::packed_stride(accessor.format));
                  }) &&
      std::all_of(sparse.begin(), sparse.end(), [&](const SparseElements& elements) {
        return stays(elements.count, elements.size);
      });
  return in_place && fixing.remove_member(member);
}

namespace {

// Whether the elements of accessors fill a view when they are stored one after the other, each
// packed, except for padding after the last one.
bool fill_in_turn(const model::Views& views, const model::BufferView& view,
                  const std::vector<std::uint32_t>& accessors) {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> places;
  for (const std::uint32_t index : accessors) {
    const model::Accessor& accessor = views.accessors[index];
    const auto size = accessor.span_size(model::packed_stride(accessor.format));
    const std::uint64_t begin = accessor.byte_offset.value_or(0);
    if (!size) return false;
    places.emplace_back(begin, saturating_add(begin, *size));
  }
  std::sort(places.begin(), places.end());
  std::uint64_t end = 0;
  for (const auto& place : places) {
    if (place.first < end || place.first > end + 3) return false;
    end = place.second;
  }
  return view.byte_length && end <= *view.byte_length && *view.byte_length <= end + 3;
}

// The stride of packed elements if it is the same for all accessors.
std::optional<std::uint64_t> common_stride(const model::Views& views,
                                           const std::vector<std::uint32_t>& accessors) {
  std::optional<std::uint64_t> common;
  for (const std::uint32_t index : accessors) {
    const std::uint64_t packed = model::packed_stride(views.accessors[index].format);
    if (packed == 0 || (common && *common != packed)) return std::nullopt;
    common = packed;
  }
  return common;
}

/// By buffer view: whether its stride is corrected. Many accessors may use one view.
struct CorrectedStrides {
  explicit CorrectedStrides(const Fixing&) {}
  std::map<std::uint32_t, bool> views;
};

bool correct_stride(Fixing& fixing, std::uint32_t index) {
  const model::BufferView& view = fixing.views().buffer_views[index];
  const json::NodeId member = fixing.document().find(view.node, "byteStride");
  const Users& users = fixing.table<Users>();
  if (member == json::kNoNode || !fixing.document().is_number(member)) return false;
  if (users.has_others(index) || !users.sparse_parts_in(index).empty()) return false;
  const double stride = fixing.document().number(member).value;
  const auto& accessors = users.accessors_in(index);
  if (accessors.empty()) return stride == 0 && fixing.remove_member(member);
  const auto packed = common_stride(fixing.views(), accessors);
  if (!packed) return false;
  const auto declared = static_cast<double>(*packed);
  const bool lost = stride < declared && fill_in_turn(fixing.views(), view, accessors);
  const bool one = accessors.size() == 1 && fixing.views().accessors[accessors[0]].count == 1U;
  if (stride != declared && !lost && !one) return false;
  const bool shared =
      accessors.size() > 1 && fixing.views().usage.view(index).has(ViewUse::vertices);
  if (!shared) return fixing.remove_member(member);
  return *packed % 4 == 0 && fixing.replace_scalar(member, std::to_string(*packed));
}

}  // namespace

bool fix_stride(Fixing& fixing, std::uint32_t index) {
  const auto [view, is_new] = fixing.table<CorrectedStrides>().views.try_emplace(index, false);
  if (is_new) return view->second = correct_stride(fixing, index);
  if (!view->second) return false;
  const json::NodeId object = fixing.views().buffer_views[index].node;
  return fixing.claim(fixing.document().find(object, "byteStride"));
}

}  // namespace gltfx::validate

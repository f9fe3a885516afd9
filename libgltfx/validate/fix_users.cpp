// SPDX-License-Identifier: Apache-2.0
#include "validate/fix_users.hpp"

#include <algorithm>
#include <tuple>

#include "base/checked.hpp"
#include "base/fork.hpp"
#include "edit/references.hpp"
#include "model/fields.hpp"

namespace gltfx::validate {

using model::AccessorUse;
using model::RootArray;
using model::ViewUse;

namespace {

// Among the objects that refer to accessors, other elements of arrays are samplers and primitives.
bool is_morph_target(Fixing& fixing, json::NodeId object) {
  const json::Document& document = fixing.document();
  const json::NodeId above = fixing.parent(object);
  return above != json::kNoNode && document.is_array(above) &&
         document.find(object, "input") == json::kNoNode &&
         document.find(object, "attributes") == json::kNoNode;
}

}  // namespace

ExtensionsSeen::ExtensionsSeen(Fixing& fixing) {
  const json::Document& document = fixing.document();
  const json::KeyId extras = document.key_id("extras");
  const json::KeyId extensions = document.key_id("extensions");
  for (json::NodeId id = 0; id < document.node_count();) {
    const json::Node& node = document.node(id);
    const bool key = node.kind == json::Kind::key;
    if (key && node.next == extensions && document.is_object(id + 1)) {
      for (const auto member : document.members(id + 1)) {
        const std::string_view name = document.key(member.key_id);
        if (!names_.emplace(name).second) continue;
        all_known_ = all_known_ && fixing.schemas().find_extension(name) != schema::kNone;
      }
    }
    id = key && node.next == extras ? document.next(id + 1) : id + 1;
  }
}

Users::Users(Fixing& fixing)
    : views_(fixing.views()),
      uses_(views_.buffer_views.size()),
      accessors_(views_.buffer_views.size()),
      others_(views_.buffer_views.size()),
      overlaps_(views_.buffer_views.size()),
      sparse_parts_(views_.buffer_views.size()),
      roles_(views_.accessors.size()),
      unknown_(!fixing.table<ExtensionsSeen>().all_known()) {
  read(fixing);
  find_others(fixing);
  find_overlaps();
}

void Users::use(std::optional<std::uint32_t> accessor, AccessorUse kind) {
  if (!accessor) return;
  const auto view = views_.accessors[*accessor].buffer_view;
  if (view) uses_[*view].insert(model::view_use(kind));
}

void Users::read(Fixing& fixing) {
  const model::Asset& elements = fixing.elements();
  for (std::uint32_t i = 0; i < views_.accessors.size(); ++i) {
    const model::Accessor& accessor = views_.accessors[i];
    if (accessor.buffer_view) accessors_[*accessor.buffer_view].push_back(i);
    const auto sparse = model::read_sparse(elements, accessor);
    if (!sparse) continue;
    for (const model::SparsePart* part : {&sparse->indices, &sparse->values}) {
      if (!part->buffer_view) continue;
      uses_[*part->buffer_view].insert(ViewUse::other);
      sparse_parts_[*part->buffer_view].push_back(
          {sparse->count.value_or(0), std::uint64_t{model::component_size(part->format.component)} *
                                          model::component_count(part->format.type)});
    }
  }
  for (const model::Mesh& mesh : views_.meshes) {
    for (const model::Primitive& primitive : mesh.primitives) {
      for (const model::Attribute& attribute : primitive.attributes) {
        use(attribute.accessor, AccessorUse::vertex_attribute);
      }
      for (const json::NodeId target : primitive.targets) {
        for (const model::Attribute& attribute : model::read_attributes(elements, target)) {
          use(attribute.accessor, AccessorUse::vertex_attribute);
        }
      }
      use(primitive.indices, AccessorUse::indices);
    }
  }
  for (const json::NodeId skin : elements.elements(RootArray::skins)) {
    use(elements.index(skin, "inverseBindMatrices", RootArray::accessors),
        AccessorUse::inverse_bind_matrices);
  }
  for (const model::Animation& animation : views_.animations) {
    for (const model::AnimationSampler& sampler : animation.samplers) {
      use(sampler.input, AccessorUse::animation_input);
      use(sampler.output, AccessorUse::animation_output);
    }
  }
  for (const json::NodeId image : elements.elements(RootArray::images)) {
    const auto view = elements.index(image, "bufferView", RootArray::buffer_views);
    if (view) uses_[*view].insert(ViewUse::image);
  }
}

// References of objects that are neither accessors nor images: those of extensions.
void Users::find_others(Fixing& fixing) {
  const json::Document& document = fixing.document();
  const edit::References references(document, fixing.schemas());
  std::set<json::NodeId> known;
  for (const RootArray array : {RootArray::accessors, RootArray::images}) {
    for (const json::NodeId object : fixing.elements().elements(array)) known.insert(object);
  }
  for (const model::Accessor& accessor : views_.accessors) {
    const auto sparse = model::read_sparse(fixing.elements(), accessor);
    if (sparse) known.insert({sparse->indices.node, sparse->values.node});
  }
  for (const edit::Reference& reference : references.to("bufferViews")) {
    if (reference.index >= others_.size()) continue;
    const json::NodeId value = fixing.node_around(reference.span);
    const json::NodeId object = value == json::kNoNode ? value : fixing.parent(value);
    if (!known.contains(object)) others_[reference.index] = true;
  }
  for (std::size_t i = 0; i < views_.buffer_views.size(); ++i) {
    const json::NodeId view = views_.buffer_views[i].node;
    if (document.find(view, "extensions") != json::kNoNode) others_[i] = true;
  }
  json::NodeId asked = json::kNoNode;  // references of one object follow each other
  bool target = false;
  for (const edit::Reference& reference : references.to("accessors")) {
    if (reference.index >= roles_.size()) continue;
    const json::NodeId value = fixing.node_at(reference.span);
    const json::NodeId object = value == json::kNoNode ? value : fixing.parent(value);
    if (object == json::kNoNode || !document.is_object(object)) {
      roles_[reference.index].emplace();
      continue;
    }
    if (object != asked) target = is_morph_target(fixing, object);
    asked = object;
    const std::string name(document.key(document.node(value - 1).next));
    roles_[reference.index].insert(target ? "target " + name : name);
  }
}

// In the order of their first bytes, one overlaps another where it begins before that ends.
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

PrimitivesByAttribute::PrimitivesByAttribute(Fixing& fixing) {
  for (const model::Mesh& mesh : fixing.views().meshes) {
    for (const model::Primitive& primitive : mesh.primitives) {
      for (const model::Attribute& attribute : primitive.attributes) {
        if (attribute.accessor) users_[*attribute.accessor].push_back(&primitive);
      }
    }
  }
}

const std::vector<const model::Primitive*>& PrimitivesByAttribute::of(
    std::uint32_t accessor) const {
  const auto found = users_.find(accessor);
  return found == users_.end() ? empty_value<std::vector<const model::Primitive*>>()
                               : found->second;
}

bool remove_stride(Fixing& fixing, std::uint32_t view) {
  const model::BufferView& strided = fixing.views().buffer_views[view];
  const json::NodeId member = fixing.document().find(strided.node, "byteStride");
  const Users& users = fixing.table<Users>();
  if (member == json::kNoNode || users.has_others(view)) return false;
  const auto& accessors = users.accessors_in(view);
  // Attributes that share a view need its stride.
  if (users.uses_of_view(view).contains(ViewUse::vertices) && accessors.size() > 1) return false;
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

// Whether the elements of accessors fill a view when they lie one behind the other, each packed;
// but for what pads the last one.
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

// The distance of packed elements, where it is the same for all accessors.
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

}  // namespace

bool mend_stride(Fixing& fixing, std::uint32_t index) {
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
  const bool shared = accessors.size() > 1 && users.uses_of_view(index).contains(ViewUse::vertices);
  if (!shared) return fixing.remove_member(member);
  return *packed % 4 == 0 && fixing.replace_scalar(member, std::to_string(*packed));
}

}  // namespace gltfx::validate

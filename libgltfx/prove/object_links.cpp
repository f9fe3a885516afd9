// SPDX-License-Identifier: Apache-2.0
// References: their targets are compared, not their numbers.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "model/texture.hpp"
#include "prove/column.hpp"
#include "prove/object_walk.hpp"
#include "prove/primitive_pair.hpp"

namespace gltfx::prove {
namespace {

using model::RootArray;

std::optional<json::NodeId> shown_image(const Side& side, json::NodeId texture,
                                        std::unordered_set<json::NodeId>& reached) {
  const auto& images = side.asset().elements(RootArray::images);
  const std::vector<std::uint32_t> indices = model::read_texture(side.asset(), texture).images;
  for (const std::uint32_t index : indices) reached.insert(images[index]);
  return indices.empty() ? std::nullopt : std::optional(images[indices.front()]);
}

}  // namespace

void ObjectWalk::compare_links(const Place& place, const Link& ours, const Link* theirs) {
  if (theirs == nullptr || (ours.pointer == nullptr) != (theirs->pointer == nullptr)) {
    return differ(place, "is no longer such a reference");
  }
  if (ours.pointer != nullptr) return compare_pointers(place, ours, *theirs);
  if (theirs->target == json::kNoNode) return differ(place, "leads nowhere");
  follow(place, {ours.target, theirs->target});
}

void ObjectWalk::compare_pointers(const Place& place, const Link& ours, const Link& theirs) {
  const graph::PointerText& here = *ours.pointer;
  const graph::PointerText& there = *theirs.pointer;
  bool same = here.steps.size() == there.steps.size();
  for (std::size_t i = 0; same && i < here.steps.size(); ++i) {
    const bool both = i < here.way.size() && i < there.way.size();
    const json::NodeId list = both ? before_.tree().parent(here.way[i]) : json::kNoNode;
    if (both && before_.is_table(list)) {
      follow(place, {here.way[i], there.way[i]});
    } else {
      same = here.steps[i] == there.steps[i];
    }
  }
  if (!same) differ(place, "points elsewhere");
}

void ObjectWalk::follow(const Place& place, const Pair& pair) {
  known_.reached_here.insert(pair.ours);
  known_.reached_there.insert(pair.theirs);
  const schema::TypeId type = before_.type(pair.ours);
  if (type != after_.type(pair.theirs)) return differ(place, "leads to another kind of object");
  if (type == types_.node) {
    if (!nodes_.matches(pair.ours, pair.theirs)) differ(place, "leads to another node");
    return;
  }
  const json::NodeId partner_there =
      known_.partners_here.try_emplace(pair.ours, pair.theirs).first->second;
  const json::NodeId partner_here =
      known_.partners_there.try_emplace(pair.theirs, pair.ours).first->second;
  const bool is_pointed =
      known_.pointed_here.contains(pair.ours) || known_.pointed_there.contains(pair.theirs);
  if (is_pointed && (partner_there != pair.theirs || partner_here != pair.ours)) {
    return differ(place, "leads to another object, and a JSON pointer distinguishes the two");
  }
  const std::pair told(pair.ours, pair.theirs);
  if (known_.contents.are_joined(pair) || known_.unread.contains(told)) return;
  if (compare_payloads(place, pair)) {
    known_.contents.join(pair);
  } else {
    known_.unread.insert(told);
  }
  if (type == types_.accessor) {
    if (known_.accessor_members.join(pair)) open_.push_back(pair);
  } else if (type != types_.buffer_view && type != types_.buffer) {
    if (type == types_.image) payloads_.images.push_back(pair);
    open_.push_back(pair);
  }
}

bool ObjectWalk::compare_payloads(const Place& place, const Pair& pair) {
  const schema::TypeId type = before_.type(pair.ours);
  if (type == types_.accessor) return compare_accessors(place, pair);
  if (type == types_.buffer_view) return compare_views(place, pair);
  const auto has_bytes = [](const Side& side, json::NodeId image) {
    return side.resources().images[side.index(image)].bytes.has_value();
  };
  return type != types_.image || (has_bytes(before_, pair.ours) && has_bytes(after_, pair.theirs));
}

bool ObjectWalk::compare_accessors(const Place& place, const Pair& pair) {
  const auto ours = Column::open(before_, before_.index(pair.ours));
  if (!ours) {
    found_.leave_out(before_.pointer(pair.ours), "cannot be read");
    return false;
  }
  const auto theirs = Column::open(after_, after_.index(pair.theirs));
  if (!theirs) {
    differ(place, "leads to an accessor that cannot be read any more");
    return false;
  }
  if (ours->count() != theirs->count() || ours->components() != theirs->components()) {
    differ(place,
           fmt::format("leads to {} elements of {} components in place of {} of {}",
                       theirs->count(), theirs->components(), ours->count(), ours->components()));
    return true;
  }
  const Farthest far = farthest(Metric::component, *ours, *theirs);
  if (far.distance == 0) return true;
  differ(place, fmt::format("leads to an element {} that is {:.6g} away", far.at, far.distance),
         far.distance);
  return true;
}

bool ObjectWalk::compare_views(const Place& place, const Pair& pair) {
  const auto bytes = [](const Side& side, json::NodeId node) {
    const model::BufferView& view = side.views().buffer_views[side.index(node)];
    return side.resources().part(side.document(), view, 0, view.byte_length.value_or(0));
  };
  const auto ours = bytes(before_, pair.ours);
  if (!ours) {
    found_.leave_out(before_.pointer(pair.ours), "cannot be read");
    return false;
  }
  const auto theirs = bytes(after_, pair.theirs);
  if (!theirs) {
    differ(place, "leads to bytes that cannot be read any more");
    return false;
  }
  if (!container::same_bytes(*ours, *theirs)) differ(place, "leads to other bytes");
  return true;
}

// Compares the images that a reader of all formats shows.
void ObjectWalk::compare_textures(const Pair& pair) {
  const auto ours = shown_image(before_, pair.ours, known_.reached_here);
  const auto theirs = shown_image(after_, pair.theirs, known_.reached_there);
  if (!ours) return;
  if (!theirs) return differ({pair.ours}, "no longer has an image");
  follow({pair.ours}, {*ours, *theirs});
}

// Names and other members of accessors whose elements are compared with the primitive.
void ObjectWalk::compare_accessor_members(const Pair& pair) {
  const auto join = [&](const std::optional<std::uint32_t>& here,
                        const std::optional<std::uint32_t>& there) {
    if (!here || !there) return;
    const Pair accessors{before_.asset().elements(RootArray::accessors)[*here],
                         after_.asset().elements(RootArray::accessors)[*there]};
    if (known_.accessor_members.join(accessors)) open_.push_back(accessors);
  };
  const auto join_lists = [&](const std::vector<model::Attribute>& here,
                              const std::vector<model::Attribute>& there) {
    const auto others = by_name(there);
    for (const model::Attribute& attribute : here) {
      const auto other = others.find(attribute.name);
      if (other != others.end()) join(attribute.accessor, other->second->accessor);
    }
  };
  const model::Primitive ours = model::read_primitive(before_.asset(), pair.ours);
  const model::Primitive theirs = model::read_primitive(after_.asset(), pair.theirs);
  join(ours.indices, theirs.indices);
  join_lists(ours.attributes, theirs.attributes);
  for (std::size_t i = 0; i < std::min(ours.targets.size(), theirs.targets.size()); ++i) {
    join_lists(model::read_attributes(before_.asset(), ours.targets[i]),
               model::read_attributes(after_.asset(), theirs.targets[i]));
  }
}

std::vector<json::NodeId> ObjectWalk::unused(
    const Side& side, json::NodeId array, const std::unordered_set<json::NodeId>& reached) const {
  std::vector<json::NodeId> elements;
  if (side.document().kind(array) != json::Kind::array) return elements;
  for (const json::NodeId element : side.document().elements(array)) {
    const schema::TypeId type = side.type(element);
    const bool apart = type == types_.node || type == types_.accessor || type == types_.buffer ||
                       type == types_.buffer_view;
    if (!apart && !reached.contains(element)) elements.push_back(element);
  }
  return elements;
}

// In the order of their lists, because unused objects can only be matched by position.
void ObjectWalk::compare_unused() {
  std::map<std::string_view, Pair> arrays;
  for (const schema::TargetArray& array : before_.graph().checked().targets) {
    if (before_.is_table(array.node)) arrays[array.pointer].ours = array.node;
  }
  for (const schema::TargetArray& array : after_.graph().checked().targets) {
    if (after_.is_table(array.node)) arrays[array.pointer].theirs = array.node;
  }
  for (const auto& [pointer, pair] : arrays) {
    if (!is_of_version(types_.root, pointer.substr(1))) compare_unused(std::string(pointer), pair);
  }
  // What is compared may have more of them.
  for (std::size_t i = 0; i < local_.pairs.size(); ++i) {
    const auto [owner, pair] = local_.pairs[i];
    compare_unused(before_.pointer(pair.ours == json::kNoNode ? owner : pair.ours), pair);
  }
}

void ObjectWalk::compare_unused(const std::string& pointer, const Pair& arrays) {
  std::vector<json::NodeId> here, there;
  if (arrays.ours != json::kNoNode) here = unused(before_, arrays.ours, known_.reached_here);
  if (arrays.theirs != json::kNoNode) there = unused(after_, arrays.theirs, known_.reached_there);
  if (here.size() != there.size()) {
    found_.add(pointer, fmt::format("has {} elements that nothing refers to in place of {}",
                                    there.size(), here.size()));
  }
  for (std::size_t i = 0; i < std::min(here.size(), there.size()); ++i) {
    follow({here[i]}, {here[i], there[i]});
  }
  drain();
}

void ObjectWalk::note_local_tables(const Pair& pair) {
  const json::Document& here = before_.document();
  const json::Document& there = after_.document();
  for (const auto member : here.members(pair.ours)) {
    if (!local_.here.contains(member.value)) continue;
    const json::NodeId other = there.find(pair.theirs, here.key(member.key_id));
    const bool both = local_.there.contains(other);
    local_.pairs.push_back({pair.ours, {member.value, both ? other : json::kNoNode}});
  }
  for (const auto member : there.members(pair.theirs)) {
    if (!local_.there.contains(member.value)) continue;
    const json::NodeId other = here.find(pair.ours, there.key(member.key_id));
    if (local_.here.contains(other)) continue;
    local_.pairs.push_back({pair.ours, {json::kNoNode, member.value}});
  }
}

}  // namespace gltfx::prove

// SPDX-License-Identifier: Apache-2.0
#include "change/removal_closure.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/text.hpp"

namespace gltfx::change {
namespace {

constexpr std::string_view kExtensionsMember = "extensions";

// The names of a shape that only requires members.
std::vector<std::string_view> required_names(const schema::Set& set, schema::ShapeId id) {
  std::vector<std::string_view> names;
  const schema::TypeId type = id == schema::kNone ? schema::kNone : set.shape(id).type;
  if (type == schema::kNone) return names;
  for (const schema::Property& property : set.type(type).properties) {
    if (property.required) names.push_back(property.name);
  }
  return names;
}

}  // namespace

bool Removals::is_gone(Place place) const {
  if (gone_[place.node] || !place.element) return gone_[place.node];
  const auto found = gone_numbers_.find(place.node);
  return found != gone_numbers_.end() && found->second.count(*place.element) != 0;
}

json::NodeId Removals::container(Place place) const {
  return place.element ? place.node : graph_.tree().parent(place.node);
}

std::optional<std::string> Removals::remove(std::span<const Place> places) {
  for (const Place& place : places) waiting_.push_back({place, {}, true});
  for (std::size_t next = 0; next < waiting_.size(); ++next) {
    if (auto why = resolve(waiting_[next])) return why;
  }
  waiting_.clear();
  return std::nullopt;
}

// Why the position of an element must not change.
std::optional<std::string> Removals::find_position_obstacle(Place place) const {
  const json::NodeId array = container(place);
  const Tree& tree = graph_.tree();
  if (!tree.document().is_array(array)) return std::nullopt;
  const std::string name = printable(tree.pointer(place));
  if (place.element && !graph_.is_list_of_references(array)) {
    return fmt::format("{} is a number and no reference", name);
  }
  const schema::ShapeId shape = graph_.shape(array);
  if (shape == schema::kNone || graph_.set().shape(shape).by_position.empty()) return std::nullopt;
  return fmt::format("{} must stay where it is: {}", name,
                     printable(graph_.set().shape(shape).by_position));
}

// Whether the container of the value has too little left without it.
bool Removals::empties(Place place) const {
  const Tree& tree = graph_.tree();
  const json::NodeId holder = container(place);
  const auto lost = lost_.find(holder);
  const std::uint64_t gone = 1 + (lost == lost_.end() ? 0 : lost->second);
  const schema::ShapeId id = graph_.shape(holder);
  const bool array = tree.document().is_array(holder);
  std::uint64_t least = 0;
  if (id != schema::kNone) {
    const schema::Shape& shape = graph_.set().shape(id);
    least = array ? shape.min_items : shape.min_properties;
  }
  if (!array && tree.is_member(holder) && tree.name(holder) == kExtensionsMember) least = 1;
  return least > 0 && tree.size(holder) < gone + least;
}

bool Removals::lives(json::NodeId object, std::string_view member, json::NodeId without) const {
  const json::NodeId value = graph_.tree().member(object, member);
  return value != json::kNoNode && value != without && !gone_[value];
}

// Whether one of several sets of members is still complete, or none was before.
bool Removals::has_alternative(const schema::Shape& shape, json::NodeId object,
                               json::NodeId without) const {
  bool before = false;
  for (const auto* branches : {&shape.any_of, &shape.one_of}) {
    for (const schema::ShapeId branch : *branches) {
      const auto names = required_names(graph_.set(), branch);
      if (names.empty()) return true;
      const auto there = [&](std::string_view name) {
        return graph_.tree().member(object, name) != json::kNoNode;
      };
      const auto left = [&](std::string_view name) { return lives(object, name, without); };
      if (std::all_of(names.begin(), names.end(), left)) return true;
      before = before || std::all_of(names.begin(), names.end(), there);
    }
  }
  return !before;
}

// Whether an object needs the member.
bool Removals::falls(json::NodeId object, const Step& step) const {
  const schema::TypeId type = graph_.type(object);
  if (type == schema::kNone) return false;
  const json::NodeId value = step.place.node;
  const std::string_view name = graph_.tree().name(value);
  const bool extensions = name == kExtensionsMember;
  const schema::Set& set = graph_.set();
  for (const schema::Property& property : set.type(type).properties) {
    const bool itself = property.name == name;
    if (itself && property.required) return true;
    if (property.shape == schema::kNone || !set.shape(property.shape).essential) continue;
    const bool concerned = extensions || (itself && !step.asked);
    const std::string_view other = itself ? kExtensionsMember : std::string_view(property.name);
    if (concerned && !lives(object, other, value)) return true;
  }
  return !has_alternative(set.shape(set.type(type).shape), object, value);
}

std::optional<std::string> Removals::resolve(Step step) {
  const Tree& tree = graph_.tree();
  while (!is_gone(step.place)) {
    const json::NodeId holder = container(step.place);
    if (holder == json::kNoNode) return "the document itself must stay";
    if (auto why = find_position_obstacle(step.place)) return why;
    const Place whole{holder, std::nullopt};
    const bool array = tree.document().is_array(holder);
    const bool needed = !array && falls(holder, step);
    if (needed && holder == tree.document().root()) {
      return fmt::format("{} must stay: the document needs it",
                         printable(tree.pointer(step.place)));
    }
    if (needed && !cascade_) {
      need(whole, step.place, true);
      return std::nullopt;
    }
    if (!needed && !empties(step.place)) {
      take_out(step);
      if (!array) drop_dependents(holder, step.place);
      return std::nullopt;
    }
    if (step.asked && !array) step.cause = step.place;
    step = {whole, step.cause, step.asked && array};
  }
  return std::nullopt;
}

// Removes members that depend on this one.
void Removals::drop_dependents(json::NodeId object, Place place) {
  const schema::TypeId type = graph_.type(object);
  if (type == schema::kNone) return;
  const std::string_view name = graph_.tree().name(place.node);
  const schema::Shape& shape = graph_.set().shape(graph_.set().type(type).shape);
  for (const auto& [dependent, needed] : shape.dependent_required) {
    if (std::find(needed.begin(), needed.end(), name) == needed.end()) continue;
    const json::NodeId value = graph_.tree().member(object, dependent);
    if (value != json::kNoNode && !gone_[value]) need({value, std::nullopt}, place, false);
  }
}

void Removals::need(Place at, Place target, bool owner) {
  if (cascade_) {
    waiting_.push_back({at, target, false});
  } else {
    obstacles_.push_back({at, target, owner});
  }
}

void Removals::take_out(const Step& step) {
  removed_.push_back({step.place, step.cause});
  ++lost_[container(step.place)];
  if (step.place.element) {
    gone_numbers_[step.place.node].insert(*step.place.element);
    return;
  }
  const json::Document& document = graph_.tree().document();
  const json::NodeId end = document.next(step.place.node);
  for (json::NodeId id = step.place.node; id < end;) {
    const bool key = document.kind(id) == json::Kind::key;
    if (!key && gone_[id]) {
      id = document.next(id);
      continue;
    }
    gone_[id] = true;
    for (const graph::Use& use : graph_.users(id)) {
      const bool stands = use.kind != graph::UseKind::implied && !is_gone(use.at);
      if (stands) need(use.at, {id, std::nullopt}, false);
    }
    ++id;
  }
}

std::vector<Removed> Removals::outermost() const {
  std::vector<Removed> all;
  for (const Removed& removed : removed_) {
    if (!gone_[container(removed.place)]) all.push_back(removed);
  }
  return all;
}

std::vector<Obstacle> Removals::obstacles() const {
  std::vector<Obstacle> all;
  for (const Obstacle& obstacle : obstacles_) {
    if (!is_gone(obstacle.at)) all.push_back(obstacle);
  }
  return all;
}

}  // namespace gltfx::change

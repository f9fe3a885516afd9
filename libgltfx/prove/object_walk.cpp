// SPDX-License-Identifier: Apache-2.0
#include "prove/object_walk.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "json/equal.hpp"
#include "model/instancing.hpp"
#include "prove/regridded.hpp"

namespace gltfx::prove {
namespace {

constexpr std::string_view kExtensions = "extensions";

bool is_transform(std::string_view name) {
  return name == "matrix" || name == "rotation" || name == "scale" || name == "translation";
}

// What objects of all types have, whatever they store.
bool is_said_of_all(std::string_view name) {
  return name == "name" || name == "extras" || name == kExtensions;
}

std::unordered_set<json::NodeId> pointed(const Side& side) {
  std::unordered_set<json::NodeId> values;
  for (const graph::PointerText& pointer : side.graph().pointers()) {
    values.insert(pointer.way.begin(), pointer.way.end());
  }
  return values;
}

// Whose elements only their owner refers to, such as the samplers of an animation.
std::unordered_set<json::NodeId> local_tables(const Side& side) {
  std::unordered_set<json::NodeId> tables;
  for (const schema::TargetArray& array : side.graph().checked().local_targets) {
    if (side.is_table(array.node)) tables.insert(array.node);
  }
  return tables;
}

}  // namespace

std::uint64_t EqualValues::find(std::uint64_t value) {
  for (auto at = above_.find(value); at != above_.end(); at = above_.find(value)) {
    const auto next = above_.find(at->second);
    if (next != above_.end()) at->second = next->second;
    value = at->second;
  }
  return value;
}

bool EqualValues::join(const Pair& pair) {
  const std::uint64_t ours = find(pair.ours);
  const std::uint64_t theirs = find((std::uint64_t{1} << 32U) | pair.theirs);
  if (ours != theirs) above_.emplace(ours, theirs);
  return ours != theirs;
}

bool EqualValues::are_joined(const Pair& pair) {
  return find(pair.ours) == find((std::uint64_t{1} << 32U) | pair.theirs);
}

ObjectWalk::ObjectWalk(const Side& before, const Side& after, const NodePairs& nodes,
                       const PlacedMeshes& placed, const MeaningRequest& request,
                       Differences& found)
    : before_(before),
      after_(after),
      nodes_(nodes),
      placed_(placed),
      request_(request),
      found_(found),
      types_(before.graph().set()),
      storage_(storage_extensions(before.graph().set(), types_)) {
  known_.pointed_here = pointed(before);
  known_.pointed_there = pointed(after);
  local_.here = local_tables(before);
  local_.there = local_tables(after);
}

Payloads ObjectWalk::run() {
  open_.push_back({before_.document().root(), after_.document().root()});
  compare_declared("extensionsUsed");
  compare_declared("extensionsRequired");
  const std::size_t here = before_.asset().count(model::RootArray::nodes);
  const std::size_t there = after_.asset().count(model::RootArray::nodes);
  const bool more = request_.regridded && there > here;  // compare_objects() compares new ones
  if (here != there && !more)
    found_.add("/nodes", fmt::format("has {} nodes in place of {}", there, here));
  open_.insert(open_.end(), nodes_.all().begin(), nodes_.all().end());
  drain();
  if (!request_.unused_may_go) compare_unused();
  return std::move(payloads_);
}

void ObjectWalk::differ(const Place& place, std::string what, double amount) {
  found_.add(before_.tree().pointer(graph::Place{place.value, place.element}), std::move(what),
             amount);
}

void ObjectWalk::drain() {
  while (!open_.empty()) {
    const Pair pair = open_.front();
    open_.pop_front();
    compare(pair);
  }
}

void ObjectWalk::compare(const Pair& pair) {
  const json::Document& here = before_.document();
  const json::Document& there = after_.document();
  const Link* link = here.is_array(pair.ours) ? nullptr : before_.link(pair.ours);
  if (link != nullptr && link->target != json::kNoNode) {
    return compare_links({pair.ours}, *link, after_.link(pair.theirs));
  }
  if (here.is_array(pair.ours) && there.is_array(pair.theirs)) return compare_arrays(pair);
  if (here.kind(pair.ours) != there.kind(pair.theirs)) {
    return differ({pair.ours}, "has another type of value");
  }
  if (here.is_object(pair.ours)) return compare_objects(pair);
  if (json::equal(here, pair.ours, there, pair.theirs)) return;
  double apart = 0;
  if (here.is_number(pair.ours)) {
    apart = std::abs(here.number(pair.ours).value - there.number(pair.theirs).value);
  }
  differ({pair.ours}, "has another value", apart);
}

void ObjectWalk::compare_arrays(const Pair& pair) {
  const json::Document& here = before_.document();
  const json::Document& there = after_.document();
  if (before_.is_table(pair.ours) && after_.is_table(pair.theirs)) return;
  const std::size_t count = here.array_size(pair.ours);
  if (const std::size_t now = there.array_size(pair.theirs); now != count) {
    return differ({pair.ours}, fmt::format("has {} elements in place of {}", now, count));
  }
  if (here.kind(pair.ours) != there.kind(pair.theirs)) {
    return differ({pair.ours}, "has elements of another type");
  }
  if (here.kind(pair.ours) == json::Kind::number_array) return compare_numbers(pair);
  const auto theirs = there.elements(pair.theirs);
  auto next = theirs.begin();
  for (const json::NodeId element : here.elements(pair.ours)) {
    open_.push_back({element, *next});
    ++next;
  }
}

void ObjectWalk::compare_numbers(const Pair& pair) {
  const json::Document& here = before_.document();
  const json::Document& there = after_.document();
  json::NumberCursor ours(here, pair.ours);
  json::NumberCursor theirs(there, pair.theirs);
  for (std::uint64_t i = 0; ours.valid() && theirs.valid(); ours.advance(), theirs.advance()) {
    const Place place{pair.ours, i};
    const Link* link = before_.link(pair.ours, i);
    const Link* other = after_.link(pair.theirs, i++);
    if (link != nullptr && link->target != json::kNoNode) {
      compare_links(place, *link, other);
    } else if (!json::same_number(here.text(), ours.number(), there.text(), theirs.number())) {
      differ(place, "has another value", std::abs(ours.number().value - theirs.number().value));
    }
  }
}

ObjectWalk::Members ObjectWalk::members(const Side& side, json::NodeId object) const {
  Members members;
  for (const auto member : side.document().members(object)) {
    const std::string_view name = side.document().key(member.key_id);
    if (is_compared(side, object, name, member.value)) members.emplace_back(name, member.value);
  }
  std::sort(members.begin(), members.end());
  return members;
}

// Whether an object has the accessors of transforms of copies, which compare_places() compares.
bool ObjectWalk::is_of_copies(const Side& side, json::NodeId object) const {
  const json::NodeId node = side.tree().root_element(object);
  if (node == json::kNoNode || side.type(node) != types_.node) return false;
  const model::Node& drawn = side.views().nodes[side.index(node)];
  return model::instance_attributes(side.asset(), drawn) == object;
}

// Whether a member only exists in some versions, or tells the version.
bool ObjectWalk::is_of_version(schema::TypeId type, std::string_view name) const {
  if (!request_.older_version || type == schema::kNone) return false;
  if (type == types_.asset && (name == "version" || name == "minVersion" || name == "extras"))
    return true;
  const schema::Property* property = before_.graph().set().find_property(type, name);
  return property != nullptr && property->since > schema::kVersion2;
}

// Whether a member is compared as text, because no comparison of its data covers it.
bool ObjectWalk::is_compared(const Side& side, json::NodeId object, std::string_view name,
                             json::NodeId value) const {
  if (request_.regridded && (name == "TRANSLATION" || name == "SCALE") &&
      is_of_copies(side, object))
    return false;
  const schema::TypeId type = side.type(object);
  if (type == schema::kNone) {
    const graph::Tree& tree = side.tree();
    const bool list = tree.is_member(object) && tree.name(object) == kExtensions &&
                      side.type(tree.parent(object)) != schema::kNone;
    return !list || !storage_.contains(name);
  }
  if (is_mere_storage(side, name, value) || is_of_version(type, name)) return false;
  if (request_.regridded && type == types_.skin && name == "inverseBindMatrices") return false;
  if (request_.regridded && name == "thicknessFactor") return false;
  if (request_.image_names_may_go && type == types_.image && name == "name") return false;
  if (is_said_of_all(name)) return true;
  const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (type == types_.accessor || type == types_.image) {
    return side.graph().set().find_property(type, name) == nullptr;
  }
  if (type == types_.primitive) return !is_one_of({"attributes", "indices", "mode", "targets"});
  if (type == types_.texture) return name != "source";
  if (type == types_.root) return !is_one_of({"extensionsUsed", "extensionsRequired"});
  const bool curves = request_.animations == AnimationComparison::curves;
  if (type == types_.sampler && curves) return !is_one_of({"input", "interpolation", "output"});
  const bool moves = type == types_.node && &side == &before_ && placed_.may_move(object);
  return !moves || !is_transform(name);
}

// Tables, and objects with storage extensions only or none: their presence has no meaning.
bool ObjectWalk::is_mere_storage(const Side& side, std::string_view name,
                                 json::NodeId value) const {
  const json::Document& document = side.document();
  if (document.is_array(value)) return side.is_table(value);
  if (name != kExtensions || !document.is_object(value)) return false;
  for (const auto member : document.members(value)) {
    if (!storage_.contains(document.key(member.key_id))) return false;
  }
  return true;
}

void ObjectWalk::compare_objects(const Pair& pair) {
  const schema::TypeId type = before_.type(pair.ours);
  Members theirs = members(after_, pair.theirs);
  if (type == types_.node && placed_.may_move(pair.ours)) {
    std::erase_if(theirs, [](const auto& member) { return is_transform(member.first); });
  }
  Members ours = members(before_, pair.ours);
  if (type == types_.node && request_.regridded) take_mesh_child(pair, ours, theirs);
  compare_members(pair, ours, theirs);
  if (!request_.unused_may_go) note_local_tables(pair);
  if (type == types_.texture) compare_textures(pair);
  if (type == types_.primitive) {
    payloads_.primitives.push_back(pair);
    compare_accessor_members(pair);
  }
  if (type == types_.channel && request_.animations == AnimationComparison::curves) {
    payloads_.channels.push_back(pair);
  }
}

// Gives a node the mesh of its new child, which is left out.
void ObjectWalk::take_mesh_child(const Pair& pair, Members& ours, Members& theirs) {
  const json::Document& here = before_.document();
  const json::Document& there = after_.document();
  if (!here.holds(pair.ours, "mesh") || there.holds(pair.theirs, "mesh")) return;
  const auto child = find_mesh_child(after_, nodes_, pair.theirs);
  if (!child) return;
  const model::Node& drawn = after_.views().nodes[*child];
  theirs.emplace_back("mesh", drawn.mesh_value);
  if (drawn.weights != json::kNoNode) theirs.emplace_back("weights", drawn.weights);
  const auto list = [](const Side& side, json::NodeId node) {
    std::vector<json::NodeId> children;
    const auto& all = side.asset().elements(model::RootArray::nodes);
    model::for_each_index(side.asset(), side.document().find(node, "children"),
                          model::RootArray::nodes, [&](std::uint64_t, const auto& index, Span) {
                            children.push_back(index ? all[*index] : json::kNoNode);
                          });
    return children;
  };
  const auto children = list(before_, pair.ours);
  const auto now = list(after_, pair.theirs);
  bool same = now.size() == children.size() + 1;
  for (std::size_t i = 0; same && i < children.size(); ++i)
    same = nodes_.matches(children[i], now[i]);
  if (!same) differ({pair.ours}, "has other children");
  for (Members* const list_of : {&ours, &theirs})
    std::erase_if(*list_of, [](const auto& member) { return member.first == "children"; });
  std::sort(theirs.begin(), theirs.end());
}

void ObjectWalk::compare_members(const Pair& pair, const Members& ours, const Members& theirs) {
  const auto is_new = [&](const auto& member) {
    differ({pair.ours}, fmt::format("has a new member \"{}\"", member.first));
  };
  auto other = theirs.begin();
  for (const auto& [name, value] : ours) {
    for (; other != theirs.end() && other->first < name; ++other) is_new(*other);
    if (other != theirs.end() && other->first == name) {
      open_.push_back({value, other->second});
      ++other;
    } else {
      differ({value}, "is gone");
    }
  }
  for (; other != theirs.end(); ++other) is_new(*other);
}

// Compares two lists of names. Their order has no meaning.
void ObjectWalk::compare_declared(std::string_view list) {
  const auto read = [&](const Side& side) {
    Names names;
    const json::Document& document = side.document();
    const json::NodeId array = document.find(document.root(), list);
    if (array == json::kNoNode || !document.is_array(array)) return names;
    for (const json::NodeId element : document.elements(array)) {
      if (!document.is_string(element)) continue;
      std::string name = document.string(element);
      if (!storage_.contains(name)) names.insert(std::move(name));
    }
    return names;
  };
  const Names here = read(before_);
  const Names there = read(after_);
  for (const std::string& name : here) {
    if (request_.unused_may_go || there.contains(name)) continue;
    found_.add(fmt::format("/{}", list), fmt::format("no longer has \"{}\"", name));
  }
  for (const std::string& name : there) {
    if (!here.contains(name))
      found_.add(fmt::format("/{}", list), fmt::format("has a new \"{}\"", name));
  }
}

}  // namespace gltfx::prove

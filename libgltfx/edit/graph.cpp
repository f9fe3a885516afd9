// SPDX-License-Identifier: Apache-2.0
#include "edit/graph.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "base/json_pointer.hpp"
#include "schema/check.hpp"

namespace gltfx::edit {
namespace {

// "{name}" and "[name]" stand for what is chosen at run time.
bool is_parameter(const std::string& step) {
  return step.find('{') != std::string::npos || step.find('[') != std::string::npos;
}

// Where all arrays lie that a target with "*" may mean.
json::NodeId root_of_targets(const Tree& tree, const schema::Target& target) {
  json::NodeId at = tree.document().root();
  for (const std::string& step : target.steps) {
    const Place place = step == "*" ? Place() : tree.step(at, step);
    if (place.node == json::kNoNode) return at;
    at = place.node;
  }
  return at;
}

bool is_varied(const schema::Target& target) {
  return std::find(target.steps.begin(), target.steps.end(), "*") != target.steps.end();
}

}  // namespace

Graph::Graph(const Tree& tree, const schema::Set& set)
    : tree_(tree), set_(set), types_(tree.document().node_count(), schema::kNone) {
  walk();
  for (const List& list : lists_) note_indices(list);
  find_unknown();
  for (const IndexUse& use : indices_) {
    const bool there = use.list != json::kNoNode && tree_.document().is_array(use.list);
    const json::NodeId target = there ? tree_.element(use.list, use.index) : json::kNoNode;
    if (target != json::kNoNode) users_.push_back({target, use.at});
  }
  for (const PointerText& pointer : pointers_) {
    if (!pointer.way.empty()) users_.push_back({pointer.target(), {pointer.at, std::nullopt}});
  }
  std::stable_sort(users_.begin(), users_.end(), before);
}

void Graph::walk() {
  const json::Document& document = tree_.document();
  const schema::ReferenceVisitor indices = [&](const schema::ReferenceUse& use) {
    IndexUse found{{use.value, std::nullopt}, use.span, use.index, use.list, json::kNoNode};
    if (document.kind(use.value) == json::Kind::number_array) {
      found.at.element = tree_.number_at(use.value, use.span.begin);
    }
    if (is_varied(*use.target)) found.ambiguous = root_of_targets(tree_, *use.target);
    indices_.push_back(found);
  };
  const schema::PointerVisitor pointers = [this](json::NodeId at) { note_pointer(at); };
  schema::CheckOptions options;
  options.references = &indices;
  options.pointers = &pointers;
  options.slots = false;
  schema::NoFindings nobody;
  schema::check(document, set_, options, nobody, nobody,
                [this](const schema::ObjectType& type, json::NodeId object, const Path&) {
                  types_[object] = set_.shape(type.shape).type;
                  note_defaults(type, object);
                  note_lists(type, object);
                });
}

void Graph::note_defaults(const schema::ObjectType& type, json::NodeId object) {
  for (const schema::Property& property : type.properties) {
    if (property.default_json.empty() || property.shape == schema::kNone) continue;
    const auto& target = set_.shape(property.shape).ref;
    if (!target || target->base == schema::Target::Base::enclosing || is_varied(*target)) continue;
    if (tree_.member(object, property.name) != json::kNoNode) continue;
    const Place list{root_of_targets(tree_, *target), std::nullopt};
    const Place element = tree_.step(list.node, property.default_json);
    if (element.node != json::kNoNode) defaults_.push_back({object, &property, element.node});
  }
}

// Lists whose elements refer to something at times.
void Graph::note_lists(const schema::ObjectType& type, json::NodeId object) {
  const json::Document& document = tree_.document();
  for (const schema::Property& property : type.properties) {
    if (property.shape == schema::kNone) continue;
    const schema::Shape& shape = set_.shape(property.shape);
    if (!shape.may_refer && !shape.may_point) continue;
    const json::NodeId list = tree_.member(object, property.name);
    if (list == json::kNoNode) continue;
    if (document.kind(list) == json::Kind::number_array && shape.may_refer) {
      lists_.push_back({list, object, &*shape.may_refer});
    }
    if (document.kind(list) != json::Kind::array || !shape.may_point) continue;
    for (const json::NodeId element : document.elements(list)) {
      if (document.raw(element).starts_with("\"/")) note_pointer(element);
    }
  }
}

// When all types are known.
void Graph::note_indices(const List& list) {
  std::uint64_t position = 0;
  json::NodeId target = list.object;
  if (list.target->base == schema::Target::Base::enclosing) {
    const auto is_meant = [&](json::NodeId at) {
      return types_[at] != schema::kNone && set_.type(types_[at]).origin == list.target->enclosing;
    };
    while (target != json::kNoNode && !is_meant(target)) target = tree_.parent(target);
  } else {
    target = tree_.document().root();
  }
  for (const std::string& step : list.target->steps) {
    if (target != json::kNoNode) target = tree_.step(target, step).node;
  }
  for (json::NumberCursor at(tree_.document(), list.node); at.valid(); at.advance()) {
    const json::Number& number = at.number();
    const Place place{list.node, position++};
    if (!number.is_integer() || number.value < 0) continue;
    indices_.push_back(
        {place, number.span, static_cast<std::uint64_t>(number.value), target, json::kNoNode});
  }
}

void Graph::note_pointer(json::NodeId at) {
  const json::Document& document = tree_.document();
  auto steps = split_pointer(document.string(at));
  if (!steps) return;
  PointerText pointer;
  pointer.at = at;
  pointer.steps = *std::move(steps);
  json::NodeId place = document.root();
  for (const std::string& step : pointer.steps) {
    if (is_parameter(step) && tree_.step(place, step).node == json::kNoNode) {
      pointer.varying = place;
      break;
    }
    const Place next = tree_.step(place, step);
    if (next.node == json::kNoNode || next.element) break;
    place = next.node;
    pointer.way.push_back(place);
  }
  pointers_.push_back(std::move(pointer));
}

// Extras are nobody's business.
void Graph::find_unknown() {
  const json::Document& document = tree_.document();
  const json::KeyId extras = document.key_id("extras");
  const json::KeyId extensions = document.key_id("extensions");
  for (json::NodeId id = 0; id < document.node_count();) {
    const json::Node& node = document.node(id);
    const bool key = node.kind == json::Kind::key;
    if (key && node.next == extensions && document.is_object(id + 1)) {
      const schema::TypeId host = types_[tree_.parent(id)];
      for (const auto member : document.members(id + 1)) {
        const schema::ExtensionId known = set_.find_extension(document.key(member.key_id));
        const bool at_home =
            known != schema::kNone && host != schema::kNone &&
            set_.extensions()[known].shape_on(set_.type(host).origin) != schema::kNone;
        if (!at_home) unknown_.push_back(member.value);
      }
    }
    id = key && node.next == extras ? document.next(id + 1) : id + 1;
  }
}

schema::ShapeId Graph::shape(json::NodeId value) const {
  std::vector<json::NodeId> way;
  json::NodeId at = value;
  for (; types_[at] == schema::kNone; at = tree_.parent(at)) {
    if (tree_.parent(at) == json::kNoNode) return schema::kNone;
    way.push_back(at);
  }
  schema::ShapeId shape = set_.type(types_[at]).shape;
  for (auto child = way.rbegin(); child != way.rend(); ++child) {
    shape = shape_of_child(at, shape, *child);
    if (shape == schema::kNone) return shape;
    at = *child;
  }
  return shape;
}

schema::ShapeId Graph::shape_of_child(json::NodeId parent, schema::ShapeId shape,
                                      json::NodeId child) const {
  const schema::Shape& described = set_.shape(shape);
  if (!tree_.is_member(child)) return described.items;
  const std::string_view name = tree_.name(child);
  const schema::TypeId type = types_[parent] == schema::kNone ? described.type : types_[parent];
  if (type != schema::kNone) {
    if (const schema::Property* own = set_.find_property(type, name)) return own->shape;
  }
  for (const auto& [pattern, inside] : described.pattern_properties) {
    if (set_.matches(pattern, name)) return inside;
  }
  return described.values;
}

}  // namespace gltfx::edit

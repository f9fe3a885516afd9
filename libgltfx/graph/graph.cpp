// SPDX-License-Identifier: Apache-2.0
#include "graph/graph.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/json_pointer.hpp"
#include "graph/extensions.hpp"

namespace gltfx::graph {
namespace {

// "{name}" and "[name]" are chosen at run time.
bool is_parameter(const std::string& step) {
  return step.find('{') != std::string::npos || step.find('[') != std::string::npos;
}

bool is_varied(const schema::Target& target) {
  return std::find(target.steps.begin(), target.steps.end(), "*") != target.steps.end();
}

// The value that contains all arrays to which a target with "*" may refer.
json::NodeId root_of_targets(const Tree& tree, const schema::Target& target) {
  json::NodeId at = tree.document().root();
  for (const std::string& step : target.steps) {
    const Place place = step == "*" ? Place() : tree.step(at, step);
    if (place.node == json::kNoNode) return at;
    at = place.node;
  }
  return at;
}

/// Values by name; kNoNode if several have it.
using Named = std::unordered_map<std::string, json::NodeId>;

// What a name may refer to: members of objects, and objects with a string member.
Named named_values(const Tree& tree, const schema::Target& target) {
  const json::Document& document = tree.document();
  std::vector<json::NodeId> places{document.root()};
  for (const std::string& step : target.steps) {
    std::vector<json::NodeId> next;
    for (const json::NodeId place : places) {
      if (step != "*") {
        next.push_back(document.is_object(place) ? tree.member(place, step) : json::kNoNode);
      } else if (document.kind(place) == json::Kind::array) {
        for (const json::NodeId element : document.elements(place)) next.push_back(element);
      }
    }
    std::erase(next, json::kNoNode);
    places = std::move(next);
  }
  Named named;
  const auto add = [&](std::string name, json::NodeId value) {
    const auto [known, is_new] = named.emplace(std::move(name), value);
    if (!is_new) known->second = json::kNoNode;
  };
  for (const json::NodeId place : places) {
    if (document.is_string(place)) add(document.string(place), tree.parent(place));
    if (!document.is_object(place)) continue;
    for (const auto member : document.members(place)) {
      add(std::string(document.key(member.key_id)), member.value);
    }
  }
  return named;
}

}  // namespace

/// Fills a graph.
class Graph::Reader {
 public:
  explicit Reader(Graph& graph) : graph_(graph), tree_(graph.tree_), set_(graph.set_) {}

  void run(bool slots) {
    walk(slots);
    for (const List& list : lists_) note_indices(list);
    find_unknown();
    collect_uses();
  }

 private:
  /// A list of numbers that may be indices.
  struct List {
    json::NodeId node;
    json::NodeId object;  ///< that has it
    const schema::Target* target;
  };

  const json::Document& document() const { return tree_.document(); }

  void walk(bool slots) {
    const schema::ReferenceVisitor references = [this](const schema::ReferenceUse& use) {
      note(use);
    };
    schema::CheckOptions options;
    options.references = &references;
    options.slots = slots;
    schema::NoFindings findings;
    graph_.checked_ =
        schema::check(document(), set_, options, findings, findings,
                      [this](const schema::ObjectType& type, json::NodeId object, const Path&) {
                        graph_.types_[object] = set_.shape(type.shape).type;
                        note_defaults(type, object);
                        note_lists(type, object);
                      });
  }

  void note(const schema::ReferenceUse& use) {
    using Kind = schema::ReferenceUse::Kind;
    if (use.kind == Kind::pointer) return note_pointer(use.value);
    if (use.kind == Kind::name) return note_name(use.value, *use.target);
    IndexUse found{
        {use.value, std::nullopt}, use.span, use.array, use.index, use.list, json::kNoNode};
    if (document().kind(use.value) == json::Kind::number_array) {
      found.at.element = tree_.number_at(use.value, use.span.begin);
    }
    if (is_varied(*use.target)) found.ambiguous = root_of_targets(tree_, *use.target);
    graph_.indices_.push_back(found);
  }

  void note_name(json::NodeId value, const schema::Target& target) {
    const auto [named, is_new] = named_.try_emplace(&target);
    if (is_new) named->second = named_values(tree_, target);
    const auto found = named->second.find(document().string(value));
    if (found == named->second.end() || found->second == json::kNoNode) return;
    others_.push_back({found->second, {value, std::nullopt}, UseKind::name});
  }

  void note_defaults(const schema::ObjectType& type, json::NodeId object) {
    for (const schema::Property& property : type.properties) {
      if (property.default_json.empty() || property.shape == schema::kNone) continue;
      const auto& target = set_.shape(property.shape).ref;
      if (!target || target->base == schema::Target::Base::enclosing || is_varied(*target)) {
        continue;
      }
      if (tree_.member(object, property.name) != json::kNoNode) continue;
      const Place list{root_of_targets(tree_, *target), std::nullopt};
      const Place element = tree_.step(list.node, property.default_json);
      if (element.node == json::kNoNode) continue;
      others_.push_back({element.node, {object, std::nullopt}, UseKind::implied});
    }
  }

  // Records lists whose elements may be references.
  void note_lists(const schema::ObjectType& type, json::NodeId object) {
    for (const schema::Property& property : type.properties) {
      if (property.shape == schema::kNone) continue;
      const schema::Shape& shape = set_.shape(property.shape);
      if (!shape.may_refer && !shape.may_point) continue;
      const json::NodeId list = tree_.member(object, property.name);
      if (list == json::kNoNode) continue;
      if (document().kind(list) == json::Kind::number_array && shape.may_refer) {
        lists_.push_back({list, object, &*shape.may_refer});
      }
      if (document().kind(list) != json::Kind::array || !shape.may_point) continue;
      for (const json::NodeId element : document().elements(list)) {
        if (document().raw(element).starts_with("\"/")) note_pointer(element);
      }
    }
  }

  // Called when all types are known.
  void note_indices(const List& list) {
    std::uint64_t position = 0;
    json::NodeId target = list.object;
    if (list.target->base == schema::Target::Base::enclosing) {
      const auto is_meant = [&](json::NodeId at) {
        const schema::TypeId type = graph_.types_[at];
        return type != schema::kNone && set_.type(type).origin == list.target->enclosing;
      };
      while (target != json::kNoNode && !is_meant(target)) target = tree_.parent(target);
    } else {
      target = document().root();
    }
    for (const std::string& step : list.target->steps) {
      if (target != json::kNoNode) target = tree_.step(target, step).node;
    }
    for (json::NumberCursor at(document(), list.node); at.valid(); at.advance()) {
      const json::Number& number = at.number();
      const Place place{list.node, position++};
      if (!number.is_integer() || number.value < 0) continue;
      graph_.indices_.push_back({place,
                                 number.span,
                                 {},
                                 static_cast<std::uint64_t>(number.value),
                                 target,
                                 json::kNoNode});
    }
  }

  void note_pointer(json::NodeId at) {
    auto steps = split_pointer(document().string(at));
    if (!steps) return;
    PointerText pointer;
    pointer.at = at;
    pointer.steps = *std::move(steps);
    json::NodeId place = document().root();
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
    graph_.pointers_.push_back(std::move(pointer));
  }

  void find_unknown() {
    each_extension(document(), [this](const auto& member) {
      const schema::TypeId host = graph_.types_[tree_.parent(tree_.parent(member.value))];
      const schema::ExtensionId known = set_.find_extension(document().key(member.key_id));
      const bool at_home =
          known != schema::kNone && host != schema::kNone &&
          set_.extensions()[known].shape_on(set_.type(host).origin) != schema::kNone;
      if (!at_home) graph_.unknown_.push_back(member.value);
    });
  }

  void collect_uses() {
    std::vector<Use>& uses = graph_.uses_;
    for (const IndexUse& use : graph_.indices_) {
      const bool there = use.list != json::kNoNode && document().is_array(use.list);
      const json::NodeId target = there ? tree_.element(use.list, use.index) : json::kNoNode;
      if (target != json::kNoNode) uses.push_back({target, use.at, UseKind::index});
    }
    for (const PointerText& pointer : graph_.pointers_) {
      if (pointer.way.empty()) continue;
      uses.push_back({pointer.way.back(), {pointer.at, std::nullopt}, UseKind::pointer});
    }
    uses.insert(uses.end(), others_.begin(), others_.end());
    std::stable_sort(uses.begin(), uses.end(),
                     [](const Use& a, const Use& b) { return a.target < b.target; });
    graph_.by_place_.resize(uses.size());
    std::iota(graph_.by_place_.begin(), graph_.by_place_.end(), 0U);
    std::stable_sort(
        graph_.by_place_.begin(), graph_.by_place_.end(),
        [&](std::uint32_t a, std::uint32_t b) { return uses[a].at.node < uses[b].at.node; });
  }

  Graph& graph_;
  const Tree& tree_;
  const schema::Set& set_;
  std::vector<List> lists_;
  std::map<const schema::Target*, Named> named_;
  std::vector<Use> others_;  ///< references by name, and implied ones
};

Graph::Graph(const json::Document& document, const schema::Set& set, bool slots)
    : tree_(document), set_(set), types_(document.node_count(), schema::kNone) {
  Reader(*this).run(slots);
}

std::span<const Use> Graph::users(json::NodeId target) const {
  struct ByTarget {
    bool operator()(const Use& use, json::NodeId wanted) const { return use.target < wanted; }
    bool operator()(json::NodeId wanted, const Use& use) const { return wanted < use.target; }
  };
  const auto [first, last] = std::equal_range(uses_.begin(), uses_.end(), target, ByTarget());
  return {uses_.data() + (first - uses_.begin()), static_cast<std::size_t>(last - first)};
}

std::size_t Graph::first_in(json::NodeId value) const {
  const auto first = std::lower_bound(
      by_place_.begin(), by_place_.end(), value,
      [this](std::uint32_t use, json::NodeId wanted) { return uses_[use].at.node < wanted; });
  return static_cast<std::size_t>(first - by_place_.begin());
}

std::vector<json::NodeId> Graph::closure(std::vector<json::NodeId> roots) const {
  std::unordered_set<json::NodeId> reached(roots.begin(), roots.end());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    each_use_in(roots[i], [&](const Use& use) {
      if (reached.insert(use.target).second) roots.push_back(use.target);
    });
  }
  std::sort(roots.begin(), roots.end());
  return roots;
}

bool Graph::is_list_of_references(json::NodeId array) const {
  const schema::ShapeId id = shape(array);
  if (id == schema::kNone) return false;
  const schema::Shape& described = set_.shape(id);
  if (described.may_refer) return true;
  return described.items != schema::kNone && set_.shape(described.items).ref.has_value();
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

}  // namespace gltfx::graph

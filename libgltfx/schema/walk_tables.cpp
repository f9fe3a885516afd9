// SPDX-License-Identifier: Apache-2.0
#include "schema/walk_tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gltfx::schema {
namespace {

bool is_combined(const Shape& shape) {
  return !shape.all_of.empty() || !shape.any_of.empty() || !shape.one_of.empty() ||
         shape.not_shape != kNone || !shape.conditions.empty();
}

bool is_shallow(const Set& set, const Shape& shape) {
  if (is_combined(shape) || shape.items != kNone || shape.values != kNone ||
      !shape.pattern_properties.empty()) {
    return false;
  }
  if (shape.type == kNone) return true;
  const auto& properties = set.type(shape.type).properties;
  return std::all_of(properties.begin(), properties.end(),
                     [](const Property& property) { return property.shape == kNone; });
}

class Maker {
 public:
  explicit Maker(const Set& set) : set_(set), tables_(std::make_shared<Set::WalkTables>()) {}

  void make_plans() {
    symbol("extensions");
    symbol("extras");
    tables_->shapes.reserve(set_.shapes().size());
    tables_->name_target_of.assign(set_.shapes().size(), kNone);
    for (ShapeId id = 0; id < set_.shapes().size(); ++id) tables_->shapes.push_back(shape(id));
    for (TypeId id = 0; id < set_.types().size(); ++id) {
      const ObjectType& type = set_.type(id);
      tables_->types.push_back(object_type(type));
      if (type.extension != kNone) mark_references(type);
    }
    lookups();
  }

  void take_plans(WalkPlans plans) {
    static_cast<WalkPlans&>(*tables_) = std::move(plans);
    for (const std::string_view name : tables_->names) tables_->symbols.intern(name);
  }

  std::shared_ptr<const Set::WalkTables> run() {
    tables_->root = set_.find_type("glTF");
    for (const Extension& extension : set_.extensions()) {
      tables_->extensions.push_back({relations(extension.excludes), relations(extension.requires_),
                                     relations(extension.overridden_by),
                                     attachment_points(extension)});
      additions(extension);
    }
    return tables_;
  }

 private:
  Symbol symbol(std::string_view name) {
    const Symbol symbol = tables_->symbols.intern(name);
    if (symbol == tables_->names.size()) tables_->names.push_back(name);
    return symbol;
  }

  ShapePlan shape(ShapeId id) {
    const Shape& shape = set_.shape(id);
    ShapePlan plan;
    plan.combined = is_combined(shape);
    plan.shallow = is_shallow(set_, shape);
    plan.slot = shape.slot.has_value();
    plan.type = shape.type;
    plan.items = shape.items;
    plan.values = shape.values;
    plan.members = shape.type != kNone || shape.values != kNone ||
                   !shape.pattern_properties.empty() || shape.property_names != kNone ||
                   plan.combined || shape.min_properties != 0 || shape.max_properties != UINT64_MAX;
    if (shape.ref) plan.target = target(*shape.ref);
    if (shape.ref_name) tables_->name_target_of[id] = target(*shape.ref_name);
    bounds(shape, plan);
    plan.plan = choose(shape, plan);
    if (plan.plan == Plan::number) {
      plan.every_value = std::isinf(plan.low) && std::isinf(plan.high);
      plan.every_fraction = plan.low <= 0 && plan.high >= 1;
      plan.every_negative_fraction = plan.low <= -1 && plan.high >= 0;
    }
    return plan;
  }

  // Limits as closed ones, so that one comparison decides.
  static void bounds(const Shape& shape, ShapePlan& plan) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    plan.low = shape.exclusive_minimum ? std::nextafter(shape.minimum, kInfinity) : shape.minimum;
    plan.high = shape.exclusive_maximum ? std::nextafter(shape.maximum, -kInfinity) : shape.maximum;
  }

  static Plan choose(const Shape& shape, const ShapePlan& plan) {
    const bool asks_more = shape.ref_name || !shape.ref_has.empty() || shape.ref_holds != kNone;
    if (shape.never || shape.multiple_of != 0 || asks_more) return Plan::full;
    if (shape.types == kObject) return Plan::object;
    if (shape.types == kArray) return Plan::array;
    if (plan.combined) return Plan::full;
    if (!shape.literals.empty()) return Plan::choice;
    if (shape.types == kInteger) {
      return plan.target == kNone    ? Plan::integer
             : shape.maximum < 1e300 ? Plan::full
                                     : Plan::index;
    }
    if (shape.types == kNumber) return Plan::number;
    if (shape.types == kBoolean) return Plan::boolean;
    const bool any_text = shape.pattern == kNone && shape.min_length == 0 &&
                          shape.max_length == UINT64_MAX && shape.should_match == kNone &&
                          shape.format != "json-pointer";
    if (shape.types == kString) return any_text ? Plan::text : Plan::full;
    const bool says_something = plan.members || shape.items != kNone || !any_text ||
                                shape.minimum > -1e300 || shape.maximum < 1e300 ||
                                shape.min_items != 0 || shape.max_items != UINT64_MAX ||
                                shape.unique_items;
    return shape.types == 0 && !says_something ? Plan::any : Plan::full;
  }

  std::uint32_t target(const Target& target) {
    auto& all = tables_->targets;
    const auto [known, is_new] =
        target_ids_.emplace(target.text, static_cast<std::uint32_t>(all.size()));
    if (!is_new) return known->second;
    TargetPlan plan;
    plan.target = target;
    plan.steps_over =
        std::find(target.steps.begin(), target.steps.end(), "*") != target.steps.end();
    if (target.base != Target::Base::enclosing) {
      for (const std::string& step : target.steps) plan.pointer += "/" + step;
    }
    all.push_back(std::move(plan));
    return static_cast<std::uint32_t>(all.size() - 1);
  }

  TypePlan object_type(const ObjectType& type) {
    TypePlan plan;
    plan.origin = type.origin;
    plan.is_root = type.name == "glTF";
    plan.extensions_at = extensions_place(type);
    std::size_t names = 0;
    for (const Property& property : type.properties) {
      const bool slot = property.shape != kNone && set_.shape(property.shape).slot;
      plan.properties.push_back({property.shape, property.required, !property.deprecated.empty(),
                                 !property.draft.empty(), slot,
                                 property.should || !property.without.empty(), property.since});
      names += 1 + property.aliases.size();
    }
    plan.constraints_at = static_cast<std::uint32_t>(type.properties.size());
    if (!type.properties.empty() && type.properties.back().name == "name") --plan.constraints_at;
    if (set_.shape(type.shape).not_shape != kNone) plan.constraints_at = 0;
    if (plan.is_root) root_places(type, plan);
    dependencies(type, plan);
    const auto count = static_cast<std::uint16_t>(type.properties.size());
    std::size_t capacity = 4;
    while (capacity < 2 * names + 2) capacity *= 2;
    plan.entries.resize(capacity);
    for (std::uint16_t i = 0; i < count; ++i) {
      insert(plan, symbol(type.properties[i].name), i, false);
    }
    for (std::uint16_t i = 0; i < count; ++i) {
      for (const std::string& alias : type.properties[i].aliases)
        insert(plan, symbol(alias), i, true);
    }
    return plan;
  }

  void mark_references(const ObjectType& type) {
    for (const Property& property : type.properties) {
      if (property.shape == kNone) continue;
      const ShapeId items = set_.shape(property.shape).items;
      for (const ShapeId shape : {property.shape, items}) {
        if (shape != kNone && set_.shape(shape).ref) tables_->shapes[shape].of_extension = true;
      }
    }
  }

  // The order in which the Khronos validator reads these types.
  static std::uint32_t extensions_place(const ObjectType& type) {
    if (type.name.ends_with("extureInfo") || type.name == "animation.channel.target") return 0;
    const bool before_name = type.name == "material" && !type.properties.empty() &&
                             type.properties.back().name == "name";
    return before_name ? static_cast<std::uint32_t>(type.properties.size() - 1) : kNone;
  }

  void dependencies(const ObjectType& type, TypePlan& plan) const {
    const auto place = [&](const std::string& name) {
      const auto is_it = [&](const Property& property) { return property.name == name; };
      const auto found = std::find_if(type.properties.begin(), type.properties.end(), is_it);
      return found == type.properties.end()
                 ? kNone
                 : static_cast<std::uint32_t>(found - type.properties.begin());
    };
    for (const auto& [name, needed] : set_.shape(type.shape).dependent_required) {
      for (const std::string& other : needed)
        plan.dependencies.push_back({name, other, place(name), place(other)});
    }
  }

  // The root has a special order: declarations come before contents.
  static void root_places(const ObjectType& type, TypePlan& plan) {
    plan.constraints_at = 0;
    plan.declarations_at = 0;
    for (std::uint32_t i = 0; i < type.properties.size(); ++i) {
      const std::string& name = type.properties[i].name;
      if (name == "extensionsUsed" || name == "extensionsRequired") plan.declarations_at = i + 1;
      if (name == "asset") plan.asset_at = i;
    }
  }

  static void insert(TypePlan& plan, Symbol symbol, std::uint16_t property, bool alias) {
    if (plan.find(symbol) != nullptr) return;
    const std::size_t mask = plan.entries.size() - 1;
    std::size_t at = symbol & mask;
    while (plan.entries[at].symbol != kNone) at = (at + 1) & mask;
    plan.entries[at] = {symbol, property, alias};
  }

  std::vector<RelationPlan> relations(const std::vector<Relation>& all) const {
    std::vector<RelationPlan> plans;
    plans.reserve(all.size());
    for (const Relation& relation : all)
      plans.push_back({&relation, set_.find_extension(relation.extension)});
    return plans;
  }

  std::vector<std::pair<TypeId, ShapeId>> attachment_points(const Extension& extension) const {
    auto attachment_points = extension.attachment_points;
    for (auto& home : attachment_points) home.first = tables_->types[home.first].origin;
    return attachment_points;
  }

  void lookups() {
    const auto& targets = tables_->targets;
    auto& all = tables_->lookups;
    for (std::uint32_t id = 0; id < targets.size(); ++id) {
      if (targets[id].target.base != Target::Base::enclosing) all.push_back({id, 0});
    }
    const auto steps = [&](const TargetLookup& lookup) -> const auto& {
      return targets[lookup.target].target.steps;
    };
    std::sort(all.begin(), all.end(),
              [&](const auto& a, const auto& b) { return steps(a) < steps(b); });
    for (std::size_t i = 1; i < all.size(); ++i) {
      const std::vector<std::string>& before = steps(all[i - 1]);
      const std::vector<std::string>& now = steps(all[i]);
      const auto apart = std::mismatch(before.begin(), before.end(), now.begin(), now.end()).first;
      all[i].shared = static_cast<std::uint32_t>(apart - before.begin());
    }
  }

  // A value in the form of the list that it is added to: numbers are kept as text.
  static Literal literal_of(const Shape& list, const std::string& text) {
    Literal literal;
    const bool number =
        !list.literals.empty() && list.literals.front().kind == Literal::Kind::number;
    literal.kind = number ? Literal::Kind::number : Literal::Kind::string;
    if (number) literal.number = std::strtod(text.c_str(), nullptr);
    literal.string = text;
    return literal;
  }

  // "TYPE/property" to its shape.
  void additions(const Extension& extension) {
    const ExtensionId id = set_.find_extension(extension.name);
    const auto add = [&](std::string_view place, const std::vector<std::string>& values) {
      const std::size_t slash = std::min(place.find('/'), place.size() - 1);
      const TypeId type = set_.find_type(place.substr(0, slash));
      const Property* property = set_.find_property(type, place.substr(slash + 1));
      if (property == nullptr) return;
      std::vector<Literal> literals;
      literals.reserve(values.size());
      for (const std::string& value : values) {
        literals.push_back(literal_of(set_.shape(property->shape), value));
      }
      tables_->additions.push_back({property->shape, id, std::move(literals)});
    };
    for (const auto& [place, values] : extension.enum_additions) add(place, values);
    if (!extension.image_mime_types.empty()) add("image/mimeType", extension.image_mime_types);
  }

  const Set& set_;
  std::shared_ptr<Set::WalkTables> tables_;
  std::unordered_map<std::string_view, std::uint32_t> target_ids_;
};

}  // namespace

const Slot* slot_of_generation(const Set& set, const ObjectType& type,
                               const json::Document& document, json::NodeId object,
                               std::string_view property) {
  const Property* described = nullptr;
  for (const Property& candidate : type.properties) {
    if (candidate.name == property) described = &candidate;
  }
  const auto has = [&](const std::string& name) {
    return document.find(object, name) != json::kNoNode;
  };
  const Extension& extension = set.extensions()[type.extension];
  for (const Generation& generation : extension.generations) {
    const bool with =
        generation.with.empty() || std::any_of(generation.with.begin(), generation.with.end(), has);
    if (!with || std::any_of(generation.without.begin(), generation.without.end(), has)) continue;
    for (const auto& [name, slot] : generation.slots) {
      if (name == property) return &slot;
    }
    break;  // the first match counts
  }
  if (described == nullptr || described->shape == kNone) return nullptr;
  const auto& slot = set.shape(described->shape).slot;
  return slot ? &*slot : nullptr;
}

std::shared_ptr<const Set::WalkTables> make_walk_tables(const Set& set) {
  Maker maker(set);
  maker.make_plans();
  return maker.run();
}

std::shared_ptr<const Set::WalkTables> make_walk_tables(const Set& set, WalkPlans plans) {
  Maker maker(set);
  maker.take_plans(std::move(plans));
  return maker.run();
}

}  // namespace gltfx::schema

// SPDX-License-Identifier: Apache-2.0
// Objects: their members in the order of the type's properties.
#include <algorithm>
#include <utility>

#include "base/codes.hpp"
#include "base/fork.hpp"
#include "base/text.hpp"
#include "schema/phrases.hpp"
#include "schema/walker.hpp"

namespace gltfx::schema {
namespace {

const TypePlan& no_type() {
  static constinit MadeOnce<TypePlan> plan;
  return plan.get([] {
    TypePlan empty;
    empty.entries.resize(1);
    return empty;
  });
}

bool lists(const Shape& names, std::string_view name) {
  const auto equal = [&](const Literal& literal) {
    return literal.kind == Literal::Kind::string && literal.string == name;
  };
  return names.literals.empty() || std::any_of(names.literals.begin(), names.literals.end(), equal);
}

}  // namespace

void Walker::object_step(Frame& frame) {
  switch (frame.stage) {
    case Stage::enter:
      enter_object(frame);
      frame.stage = Stage::properties;
      [[fallthrough]];
    case Stage::properties:
      if (properties(frame)) return;
      frame.stage = Stage::others;
      [[fallthrough]];
    case Stage::others:
      if (others(frame)) return;
      frame.stage = Stage::extensions;
      [[fallthrough]];
    case Stage::extensions:
      frame.stage = Stage::leave;
      if (push_extensions(frame)) return;
      [[fallthrough]];
    case Stage::leave:
      leave(frame);
  }
}

void Walker::enter_object(Frame& frame) {
  const Shape& shape = set_.shape(frame.shape);
  if (shape.min_properties != 0 || shape.max_properties != UINT64_MAX) {
    if (!count_members(frame) && !frame.further) discard(frame);
  }
  frame.calls = {};
  if (options_.members != nullptr && frame.type != kNone) {
    frame.calls = options_.members->calls(set_.type(frame.type));
    if (frame.further) frame.calls.behind = 0;
  }
  gather(frame);
  if (shape.property_names != kNone) member_names(frame);
  const bool has_others = shape.values != kNone || !shape.pattern_properties.empty();
  if (!has_others) frame.at = document_.next(frame.node);  // nothing to do in that stage
}

// Sorts the members by property. Unknown names are reported at once.
void Walker::gather(Frame& frame) {
  const bool typed = frame.type != kNone;
  const TypePlan& plan = typed ? tables_.types[frame.type] : no_type();
  members_.resize(frame.scratch + plan.properties.size(), json::kNoNode);
  if (!typed || document_.node(frame.node).hidden) return;
  json::NodeId* const slots = members_.data() + frame.scratch;
  const json::NodeId end = document_.next(frame.node);
  for (json::NodeId at = frame.node + 1; at < end;) {
    const json::KeyId key = document_.node(at).next;
    const json::NodeId value = at + 1;
    at = document_.next(value);
    if (is_hidden(value)) continue;
    const Symbol symbol = names_.symbol(key);
    const TypePlan::Entry* entry = symbol == kNone ? nullptr : plan.find(symbol);
    if (symbol == Set::WalkTables::kExtensions) frame.extensions = value;
    if (symbol == Set::WalkTables::kExtras) frame.extras = value;
    if (entry == nullptr) {
      if (symbol > Set::WalkTables::kExtras) other_name(frame, key, value);
    } else if (!entry->alias) {
      if (is_known(plan.properties[entry->property], value)) {
        slots[entry->property] = value;
      } else {
        unexpected(frame, key, value);
      }
    } else {
      renamed(frame, set_.type(frame.type).properties[entry->property], value);
      if (slots[entry->property] == json::kNoNode) slots[entry->property] = value;
    }
  }
}

// Whether the version of the asset has a property, which is then checked without a word.
bool Walker::is_in_force(const PropertyPlan& plan) const {
  return plan.since == Version() ? !plan.draft : plan.since <= version_;
}

// Of a draft, also earlier versions have a property that says so. To a version before the one that
// has the property, it is a name like any other if the value is none that the draft allows.
bool Walker::is_known(const PropertyPlan& plan, json::NodeId value) const {
  if (!plan.draft) return plan.since <= version_;
  if (deviations().draft_names_are_unexpected) return false;
  return is_in_force(plan) || plan.since == Version() || is_allowed(plan.shape, value);
}

// Whether a value has the type of a shape, and refers to an element of the root where it is an
// index.
bool Walker::is_allowed(ShapeId id, json::NodeId value) const {
  if (id == kNone) return true;
  const Shape& shape = set_.shape(id);
  if (!values_.has_type({value}, shape.types)) return false;
  if (!shape.ref || shape.ref->base != Target::Base::root_array) return true;
  const json::NodeId list = document_.find(document_.root(), shape.ref->steps.back());
  const auto index = document_.unsigned_integer(value);
  if (!index || list == json::kNoNode || document_.kind(list) != json::Kind::array) return false;
  return *index < document_.array_size(list);
}

bool Walker::properties(Frame& frame) {
  const TypePlan& plan = frame.type == kNone ? no_type() : tables_.types[frame.type];
  const auto count = static_cast<std::uint32_t>(plan.properties.size());
  if (frame.constrained && pending_shapes(frame)) return true;
  while (true) {
    const std::uint32_t stop = frame.constrained ? count : plan.constraints_at;
    while (frame.index < stop) {
      behind(frame);
      if (frame.index == plan.extensions_at && push_extensions(frame)) return true;
      if (plan.is_root && !frame.further && root_property(frame)) return true;
      const std::uint32_t index = frame.index++;
      const json::NodeId node = members_[frame.scratch + index];
      if (node != json::kNoNode) {
        if (property(frame, index, node)) return true;
      } else if (plan.properties[index].required && is_in_force(plan.properties[index])) {
        missing(frame, index);
      }
    }
    behind(frame);
    if (frame.constrained) return false;
    frame.constrained = true;
    constraints(frame);
    if (pending_shapes(frame)) return true;
  }
}

// Steps of the root before a property; true when the walk ends.
bool Walker::root_property(Frame& frame) {
  const TypePlan& plan = tables_.types[frame.type];
  if (frame.index == plan.declarations_at) declarations();
  return frame.index == plan.asset_at + 1 && stops_at_asset(frame);
}

// Shapes that conditions add to this object.
bool Walker::pending_shapes(Frame& frame) {
  while (pending_.size() > frame.pending) {
    const ShapeId shape = pending_.back();
    pending_.pop_back();
    if (value(shape, frame.node, {Step::Kind::same})) return true;
  }
  return false;
}

bool Walker::property(Frame& frame, std::uint32_t index, json::NodeId node) {
  const PropertyPlan& plan = tables_.types[frame.type].properties[index];
  if (plan.deprecated) {
    const Property& property = set_.type(frame.type).properties[index];
    report({frame.path, key_of(node)}, Code::PROPERTY_DEPRECATED, document_.span(node - 1),
           quoted(property.name) + " is deprecated: " + property.deprecated + ".");
  }
  if (plan.draft && !is_in_force(plan)) {
    const Property& property = set_.type(frame.type).properties[index];
    report({frame.path, key_of(node)}, Code::PROPERTY_DRAFT, document_.span(node - 1),
           quoted(property.name) + " is from the draft of " + property.draft +
               ", which can still change.");
  }
  if (plan.advised) advise(frame, index, node);
  if (plan.shape == kNone) return false;
  if (plan.slot) record_slot(frame, index, node);
  if (frame.calls.before) {
    const ObjectType& type = set_.type(frame.type);
    const Reading reading =
        options_.members->before(type, type.properties[index].name, frame.node, node, frame.path);
    if (reading == Reading::drop) drop(node);
    // Kept numbers are bounds, which are not references.
    if (reading == Reading::keep && document_.kind(node) != json::Kind::number_array)
      result_.has_open_references = true;
    if (reading != Reading::check) return false;
  }
  unset_ = false;
  const bool pushed = value(plan.shape, node, {Step::Kind::member});
  if (deviations().null_counts_as_missing && plan.required &&
      document_.kind(node) == json::Kind::null) {
    missing(frame, index);
  }
  if (std::exchange(unset_, false)) drop(node);
  return pushed;
}

void Walker::behind(Frame& frame) {
  if (frame.calls.behind == 0) return;
  const ObjectType& type = set_.type(frame.type);
  for (; frame.reported < frame.index; ++frame.reported) {
    const std::uint32_t bit = std::min(frame.reported, MemberVisitor::Calls::kLast);
    if ((frame.calls.behind >> bit & 1) == 0) continue;
    options_.members->behind(type, type.properties[frame.reported].name, frame.node, frame.path);
  }
}

bool Walker::follows_earlier_draft(const Frame& frame) const {
  const auto& properties = set_.type(frame.type).properties;
  return std::none_of(properties.begin(), properties.end(), [&](const Property& property) {
    return property.added_late && document_.find(frame.node, property.name) != json::kNoNode;
  });
}

void Walker::missing(Frame& frame, std::uint32_t index) {
  if (!schema_sink_.is_enabled()) return;
  const ObjectType& type = set_.type(frame.type);
  const Property& property = type.properties[index];
  // For a further shape, the object's own type may describe the property.
  const Property* described = &property;
  // For the Khronos validator, null counts as missing; another broken value has been reported.
  const json::NodeId hidden = document_.find_in_text(frame.node, property.name);
  if (frame.further && hidden != json::kNoNode && document_.kind(hidden) != json::Kind::null)
    return;
  if (property.shape == kNone && frame.further && frame.parent != nullptr) {
    const Property* own = set_.find_property(frame.parent->type, property.name);
    if (own != nullptr) described = own;
  }
  Finding finding(Code::UNDEFINED_PROPERTY);
  finding.message = quoted(property.name) + " is required, but missing.";
  finding.help = missing_help(set_, *described);
  finding.span = opening(frame.node);
  if (described->added_late) {
    // An asset of an earlier draft has none of these members: it is outdated, not broken.
    finding.severity = follows_earlier_draft(frame) ? Severity::info : Severity::warning;
  } else {
    finding.about = property.name;
  }
  schema_sink_.report(frame.path, std::move(finding));
}

// Checks members described by pattern or by additionalProperties.
bool Walker::others(Frame& frame) {
  const json::NodeId end = document_.next(frame.node);
  while (frame.at < end) {
    const json::KeyId key = document_.node(frame.at).next;
    const json::NodeId node = frame.at + 1;
    frame.at = document_.next(node);
    if (is_hidden(node)) continue;
    const Symbol symbol = names_.symbol(key);
    if (frame.type != kNone) {
      if (symbol <= Set::WalkTables::kExtras) continue;
      if (symbol != kNone && tables_.types[frame.type].find(symbol) != nullptr) continue;
    }
    const ShapeId shape = other_shape(frame, document_.key(key));
    if (deviations().invalid_indices_stay_in_maps && frame.type == kNone) {
      if (entry(frame, shape, key, node)) return true;
    } else if (value(shape, node, {Step::Kind::member})) {
      return true;
    }
  }
  return false;
}

// A member of a map, in which an invalid index stays.
bool Walker::entry(const Frame& frame, ShapeId shape, json::KeyId key, json::NodeId node) {
  const std::string_view name = document_.key(key);
  if (options_.members != nullptr) options_.members->entry(name, node, frame.path);
  if (bad_index(shape, {node}, {frame.path, name})) return false;
  return value(shape, node, {Step::Kind::member});
}

ShapeId Walker::other_shape(const Frame& frame, std::string_view name) const {
  const Shape& shape = set_.shape(frame.shape);
  for (const auto& [pattern, inside] : shape.pattern_properties) {
    if (set_.matches(pattern, name)) return inside;
  }
  return shape.values;
}

bool Walker::count_members(const Frame& frame) {
  const Shape& shape = set_.shape(frame.shape);
  const std::size_t count = document_.object_size(frame.node);
  if (count >= shape.min_properties && count <= shape.max_properties) return true;
  if (count == 0) {
    report(frame.path, Code::EMPTY_ENTITY, document_.span(frame.node),
           name_of(frame.path) + " is an empty object; it must not be empty.");
    return false;
  }
  report(frame.path, Code::PROPERTY_COUNT_NOT_IN_RANGE, opening(frame.node),
         name_of(frame.path) + " has " + std::to_string(count) + " members; it must have " +
             count_phrase(shape.min_properties, shape.max_properties, "member", "members") + ".");
  return false;
}

void Walker::member_names(const Frame& frame) {
  const Shape& names = set_.shape(set_.shape(frame.shape).property_names);
  for (const auto& member : document_.members(frame.node)) member_name(frame, names, member.value);
}

void Walker::member_name(const Frame& frame, const Shape& shape, json::NodeId value) {
  const std::string_view name = key_of(value);
  const Path path(frame.path, name);
  const Span span = document_.span(value - 1);
  const auto matches = [&](const Shape& names) {
    return names.pattern == kNone || set_.matches(names.pattern, name);
  };
  if (!matches(shape)) {
    report(path, Code::PATTERN_MISMATCH, span,
           "The name " + quoted(name) + " is not allowed; it must match " +
               std::string(set_.pattern_text(shape.pattern)) + ".");
  } else if (!lists(shape, name)) {
    report_unlisted(
        path, span,
        "The name " + quoted(name) + " is not allowed; it must be " + list_phrase(shape) + ".", {});
  } else if (shape.not_shape != kNone && matches(set_.shape(shape.not_shape)) &&
             lists(set_.shape(shape.not_shape), name)) {
    report(path, Code::CONDITION_MISMATCH, span,
           "The name " + quoted(name) + " is not allowed here.");
  }
  const std::size_t length = count_code_points(name);
  if (length >= shape.min_length && length <= shape.max_length) return;
  report(path, Code::STRING_LENGTH_NOT_IN_RANGE, span,
         "The name " + quoted(name) + " must have " +
             count_phrase(shape.min_length, shape.max_length, "character", "characters") + ".");
}

void Walker::leave(Frame& frame) {
  const bool has_extras =
      frame.extras != json::kNoNode && !frame.further &&
      !(deviations().null_extras_are_allowed && document_.kind(frame.extras) == json::Kind::null);
  if (has_extras && !document_.is_object(frame.extras)) {
    report({frame.path, "extras"}, Code::NON_OBJECT_EXTRAS, document_.span(frame.extras),
           "'extras' is " + shown(values_, {frame.extras}) + "; it should be an object.",
           "move the value to a member of an object");
  }
  if (frame.type != kNone && !frame.further && visitor_) {
    visitor_(set_.type(frame.type), frame.node, frame.path);
  }
  pop();
}

// A texture slot that is filled, with the channels that this generation of the extension reads.
void Walker::record_slot(const Frame& frame, std::uint32_t index, json::NodeId node) {
  if (!options_.slots || !document_.is_object(node)) return;
  const ObjectType& type = set_.type(frame.type);
  const ShapeId shape = type.properties[index].shape;
  SlotUse use{node,
              frame.node,
              frame.type,
              shape,
              &*set_.shape(shape).slot,
              Path(frame.path, key_of(node)).pointer()};
  if (type.extension != kNone && !set_.extensions()[type.extension].generations.empty()) {
    use.slot = slot_of_generation(set_, type, document_, frame.node, type.properties[index].name);
  }
  result_.slots.push_back(std::move(use));
}

// The rest of an asset of another version is not checked by the rules of this one.
bool Walker::stops_at_asset(const Frame& frame) {
  if (!deviations().other_versions_end_the_walk) return false;
  const std::uint32_t asset = tables_.types[frame.type].asset_at;
  const json::NodeId node = members_[frame.scratch + asset];
  const json::NodeId version = document_.find(node, "version");
  if (version != json::kNoNode && document_.is_string(version)) {
    const std::string text = document_.string(version);
    const std::size_t dot = text.find('.');
    const bool digits = text.find_first_not_of("0123456789.") == text.npos;
    if (digits && dot == 1 && text[0] == '2' && text.size() > 2 && text.find('.', 2) == text.npos)
      return false;
  }
  result_.stopped_at_asset = true;
  top_ = nullptr;
  return true;
}

}  // namespace gltfx::schema

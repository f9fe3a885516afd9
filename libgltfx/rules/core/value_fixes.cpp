// SPDX-License-Identifier: Apache-2.0
// Fixes of invalid values found by the schema walk: null, numbers in quotes, numbers slightly out
// of range, members in the wrong object.
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "json/writer.hpp"
#include "rules/context.hpp"
#include "rules/core/fix_data.hpp"
#include "rules/fix_users.hpp"
#include "schema/home.hpp"
#include "schema/meant.hpp"

namespace gltfx::validate {
namespace {

struct TypedValues {
  explicit TypedValues(const Fixing& fixing) : values(fixing.document()) {}
  const schema::Values values;
};

const schema::Shape* shape_of(Fixing& fixing, json::NodeId value) {
  const schema::ShapeId id = fixing.graph().shape(value);
  return id == schema::kNone ? nullptr : &fixing.schemas().shape(id);
}

bool is_required_member(Fixing& fixing, json::NodeId value) {
  const schema::TypeId type = fixing.graph().type(fixing.parent(value));
  const schema::Property* property =
      type == schema::kNone ? nullptr
                            : fixing.schemas().find_property(type, fixing.member_name(value));
  return property != nullptr && property->required;
}

// Programs write null for absent values.
bool remove_null(Fixing& fixing, json::NodeId value) {
  const std::string_view name = fixing.member_name(value);
  if (name.empty() || is_required_member(fixing, value)) return false;
  if (name != "extensions" && shape_of(fixing, value) == nullptr) return false;
  return fixing.remove_member(value);
}

bool write_meant(Fixing& fixing, json::NodeId value) {
  const schema::Shape* shape = shape_of(fixing, value);
  if (shape == nullptr) return false;
  const std::string meant =
      schema::meant_value(fixing.schemas(), fixing.table<TypedValues>().values, *shape, {value});
  return !meant.empty() && fixing.replace(value, meant);
}

bool correct_value_type(Fixing& fixing, const Subject& subject) {
  const json::NodeId value = subject.value;
  if (value == json::kNoNode) return false;
  if (write_bound(fixing, value)) return true;
  if (fixing.document().kind(value) == json::Kind::null) return remove_null(fixing, value);
  const schema::Shape* shape = shape_of(fixing, value);
  const bool text = shape != nullptr && shape->types == schema::kString;
  return (text || fixing.document().is_string(value)) && write_meant(fixing, value);
}

// Readers may have ignored a number in place of a flag or a texture: then the picture changes.
bool write_any_type(Fixing& fixing, const Subject& subject) {
  return subject.value != json::kNoNode && write_meant(fixing, subject.value);
}

bool correct_list(Fixing& fixing, json::NodeId list) {
  const schema::Shape* shape = shape_of(fixing, list);
  if (shape == nullptr || shape->items == schema::kNone) return false;
  const schema::Shape& items = fixing.schemas().shape(shape->items);
  const schema::Values& values = fixing.table<TypedValues>().values;
  std::vector<std::pair<json::NodeId, std::string>> meant;
  for (const json::NodeId element : fixing.document().elements(list)) {
    if (values.has_type({element}, items.types)) continue;
    if (!fixing.document().is_string(element)) return false;
    meant.emplace_back(element, schema::meant_value(fixing.schemas(), values, items, {element}));
    if (meant.back().second.empty()) return false;
  }
  for (const auto& [element, text] : meant) {
    if (!fixing.is_claimed(element)) fixing.replace(element, text);
  }
  return !meant.empty();
}

struct CorrectedLists {
  explicit CorrectedLists(const Fixing& /*fixing*/) {}
  std::map<json::NodeId, bool> done;
};

// Corrects all elements of a list that are of the wrong type, or none: one of them may have been
// reported.
bool correct_elements(Fixing& fixing, const Subject& element) {
  if (write_bound(fixing, element.node())) return true;
  const json::NodeId list = element.owner;
  if (list == json::kNoNode || fixing.document().kind(list) != json::Kind::array) return false;
  fixing.share(list);
  auto& done = fixing.table<CorrectedLists>().done;
  const auto known = done.find(list);
  return known != done.end() ? known->second
                             : done.emplace(list, correct_list(fixing, list)).first->second;
}

bool correct_length(Fixing& fixing, const Subject& subject) {
  const json::NodeId array = subject.value;
  if (array == json::kNoNode) return false;
  if (write_bound(fixing, array)) return true;
  const schema::Shape* shape = shape_of(fixing, array);
  if (shape == nullptr) return false;
  const std::string meant = schema::with_decimal_points(fixing.document(), array, *shape);
  if (meant.empty() || !fixing.claim(array)) return false;
  fixing.replace_text(fixing.document().span(array), meant);  // spaces stay
  return true;
}

// The error of single precision for a number at the limit.
std::optional<double> nearly_at_limit(const schema::Shape& shape, double number) {
  constexpr double kRounding = 4 * FLT_EPSILON;
  if ((shape.types & schema::kNumber) == 0) return std::nullopt;
  double scale = 0;
  for (const double limit : {shape.minimum, shape.maximum}) {
    if (std::isfinite(limit)) scale = std::max(scale, std::abs(limit));
  }
  const auto is_near = [&](double limit, bool excluded) {
    return !excluded && number != limit && std::abs(number - limit) <= kRounding * scale;
  };
  if (is_near(shape.minimum, shape.exclusive_minimum)) return shape.minimum;
  if (is_near(shape.maximum, shape.exclusive_maximum)) return shape.maximum;
  return std::nullopt;
}

bool clamp_rounding(Fixing& fixing, const Subject& subject) {
  const json::Document& document = fixing.document();
  const json::NodeId node = subject.node();
  const schema::Shape* shape = shape_of(fixing, node);
  if (shape == nullptr || fixing.is_claimed(node)) return false;
  if (document.is_number(node)) {
    const auto limit = nearly_at_limit(*shape, document.number(node).value);
    return limit && fixing.replace_scalar(node, number_text(*limit));
  }
  if (document.kind(node) != json::Kind::number_array || shape->items == schema::kNone) {
    return false;
  }
  for (json::NumberCursor at(document, node); at.valid(); at.advance()) {
    if (at.number().span.begin != subject.begin) continue;
    const auto limit = nearly_at_limit(fixing.schemas().shape(shape->items), at.number().value);
    if (limit) fixing.replace_text(at.number().span, number_text(*limit));
    return limit.has_value();
  }
  return false;
}

bool correct_range(Fixing& fixing, const Subject& subject) {
  if (write_bound(fixing, subject.node())) return true;
  const auto view = fixing.index(model::RootArray::buffer_views, subject.owner);
  return view && subject.name == "byteStride" ? fix_stride(fixing, *view)
                                              : clamp_rounding(fixing, subject);
}

/// Members that were moved, by their new object, and objects that were made for them.
struct Moves {
  explicit Moves(const Fixing&) {}
  std::set<std::pair<json::NodeId, std::string>> members, made;
};

bool move_member(Fixing& fixing, const Subject& member, const schema::Home& home) {
  auto& moves = fixing.table<Moves>();
  const std::string name(member.name);
  const std::string text(fixing.document().raw(member.value));
  if (home.object == json::kNoNode) {
    // Further members are added to the object once it exists.
    const std::string through(home.through);
    if (fixing.document().holds(member.owner, through)) return false;
    if (!moves.made.emplace(member.owner, through).second || !fixing.remove_member(member.value)) {
      return false;
    }
    std::string object = "{";
    json::append_string(object, name);
    return fixing.append_member(member.owner, through, object + ": " + text + "}");
  }
  if (fixing.document().holds(home.object, name)) return false;
  if (!moves.members.emplace(home.object, name).second || !fixing.remove_member(member.value)) {
    return false;
  }
  return fixing.append_member(home.object, name, text);
}

bool is_misspelt(Fixing& fixing, schema::TypeId type, std::string_view name) {
  if (type == schema::kNone) return false;
  const schema::Version version = schema::judged_version(fixing.document(), fixing.schemas());
  std::vector<std::string_view> known;
  for (const schema::Property& property : fixing.schemas().type(type).properties) {
    if (property.since <= version || !property.draft.empty()) known.push_back(property.name);
  }
  return !nearest(name, known).empty();
}

schema::Home home_of(Fixing& fixing, const Subject& member) {
  const graph::Graph& graph = fixing.graph();
  const json::NodeId object = member.owner;
  schema::Neighbourhood around{graph.type(object), object};
  around.version = schema::judged_version(fixing.document(), fixing.schemas());
  json::NodeId above = fixing.parent(object);
  for (; above != json::kNoNode && graph.type(above) == schema::kNone;
       above = fixing.parent(above)) {
    const bool list = fixing.document().is_array(above);
    around.among_others |= list && fixing.document().array_size(above) > 1;
  }
  if (above != json::kNoNode) {
    around.type_above = graph.type(above);
    around.object_above = above;
  }
  return is_misspelt(fixing, around.type, member.name)
             ? schema::Home()
             : schema::find_home(fixing.schemas(), fixing.document(), around, member.name);
}

// A member that moves into the asset object has no effect on the picture.
bool move(Fixing& fixing, const Subject& member, bool only_asset) {
  if (member.name.empty()) return false;
  const schema::Home home = home_of(fixing, member);
  if (!home.is_certain) return false;
  if (only_asset && home.type != fixing.schemas().find_type("asset")) return false;
  return move_member(fixing, member, home);
}

bool move_into_asset(Fixing& fixing, const Subject& member) { return move(fixing, member, true); }
bool move_anywhere(Fixing& fixing, const Subject& member) { return move(fixing, member, false); }

constexpr FixEntry kValueFixes[] = {
    {Code::TYPE_MISMATCH, correct_value_type, FixStage::document, write_any_type},
    {Code::ARRAY_TYPE_MISMATCH, correct_elements},
    {Code::INVALID_INDEX, correct_elements},
    {Code::ARRAY_LENGTH_NOT_IN_LIST, correct_length},
    {Code::VALUE_NOT_IN_RANGE, correct_range},
    {Code::UNEXPECTED_PROPERTY, move_into_asset, FixStage::document, move_anywhere},
};

}  // namespace

const RuleGroup& value_fix_rules() {
  static constexpr RuleGroup group{.fixes = kValueFixes};
  return group;
}

}  // namespace gltfx::validate

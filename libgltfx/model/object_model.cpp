// SPDX-License-Identifier: Apache-2.0
#include "model/object_model.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "base/json_pointer.hpp"
#include "base/text.hpp"
#include "model/mesh.hpp"

namespace gltfx::model {
namespace {

using Status = PropertyTarget::Status;

constexpr std::array<std::string_view, 11> kTypeNames{"",         "bool",     "int",     "float",
                                                      "float[]",  "float2",   "float3",  "float4",
                                                      "float2x2", "float3x3", "float4x4"};

// Read-only runtime state of a node in the object model.
constexpr std::array<std::string_view, 2> kNodeState{"globalMatrix", "parent"};
constexpr std::string_view kLength = ".length";
// Maximum number of extension names that are compared for a suggestion.
constexpr std::size_t kCandidates = 24;

// An array index of RFC 6901: decimal without leading zeros.
std::optional<std::uint64_t> array_index(std::string_view step) {
  std::uint64_t index = 0;
  const auto result = std::from_chars(step.data(), step.data() + step.size(), index);
  if (step.empty() || result.ec != std::errc() || result.ptr != step.data() + step.size()) {
    return std::nullopt;
  }
  return step.size() > 1 && step.front() == '0' ? std::nullopt : std::optional(index);
}

std::string plural(std::uint64_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace

std::string_view property_type_name(PropertyType type) {
  return kTypeNames[static_cast<std::size_t>(type)];
}

PropertyType property_type_from_name(std::string_view name) {
  const auto* const found = std::find(kTypeNames.begin(), kTypeNames.end(), name);
  return found == kTypeNames.end() ? PropertyType::none
                                   : static_cast<PropertyType>(found - kTypeNames.begin());
}

// State of one pointer during its walk through document and types.
struct ObjectModel::Walk {
  enum class Place : std::uint8_t { value, extensions, unknown };

  std::vector<std::string> steps;
  std::size_t at = 0;  ///< next step
  Place place = Place::value;
  json::NodeId node = json::kNoNode;  ///< kNoNode: not written
  schema::ShapeId shape = schema::kNone;
  schema::TypeId owner = schema::kNone;  ///< type of the object that holds `property`
  json::NodeId owner_node = json::kNoNode;
  const schema::Property* property = nullptr;  ///< of the last step, if it was one
  bool element = false;                        ///< one of the elements of `property` follows
  PropertyTarget target;

  const std::string& step() const { return steps[at]; }
  std::string pointer(std::size_t count) const {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) append_pointer_step(text, steps[i]);
    return text;
  }
  /// The current place, for messages.
  std::string here() const { return at == 0 ? "the root object" : printable(pointer(at)); }

  bool fail(Status status, std::string reason) {
    target.status = status;
    target.reason = std::move(reason);
    return false;
  }
  void suggest(std::string_view word) {
    if (word.empty() || word == step()) return;
    std::string fixed = pointer(at);
    append_pointer_step(fixed, word);
    for (std::size_t i = at + 1; i < steps.size(); ++i) append_pointer_step(fixed, steps[i]);
    target.nearest = printable(fixed);
  }
};

ObjectModel::ObjectModel(const Asset& asset, const schema::Set& schemas)
    : asset_(asset), schemas_(schemas), arrays_(asset.document()) {
  const schema::TypeId root = schemas.find_type("glTF");
  if (root != schema::kNone) root_shape_ = schemas.type(root).shape;
}

PropertyTarget ObjectModel::resolve(std::string_view pointer) {
  Walk walk;
  auto steps = split_pointer(pointer);
  if (!steps) {
    walk.fail(Status::malformed, pointer.starts_with('/') || pointer.empty()
                                     ? "'~' is neither \"~0\" nor \"~1\""
                                     : "it does not start with '/'");
    return walk.target;
  }
  walk.steps = std::move(*steps);
  walk.node = asset_.document().root();
  walk.shape = root_shape_;
  for (; walk.at < walk.steps.size(); ++walk.at) {
    if (!step(walk)) return walk.target;
  }
  arrive(walk);
  return walk.target;
}

bool ObjectModel::step(Walk& walk) {
  if (walk.place == Walk::Place::unknown) return into_unknown(walk);
  if (walk.place == Walk::Place::extensions) return into_extension(walk);
  if (walk.property != nullptr && !walk.property->mutable_type.empty()) {
    if (walk.element ||
        walk.property->mutable_type != property_type_name(PropertyType::number_array)) {
      return walk.fail(
          Status::unresolved,
          fmt::format("components of {} cannot be targeted, only the whole value", walk.here()));
    }
    return into_array(walk);
  }
  if (walk.node == json::kNoNode) {
    return walk.fail(Status::unresolved, fmt::format("{} is not present", walk.here()));
  }
  const json::Document& document = asset_.document();
  if (document.is_array(walk.node)) return into_array(walk);
  if (document.is_object(walk.node)) return into_object(walk);
  return walk.fail(Status::unresolved, fmt::format("{} has no members", walk.here()));
}

bool ObjectModel::into_object(Walk& walk) {
  const std::string& name = walk.step();
  const schema::TypeId id = type_of(walk.shape);
  const schema::ShapeId values =
      walk.shape == schema::kNone ? schema::kNone : schemas_.shape(walk.shape).values;
  if (name != "extras" && id == schema::kNone && values != schema::kNone) {
    // A map from names, such as the attributes of a primitive.
    if (!into_unknown(walk)) return false;
    walk.place = Walk::Place::value;
    walk.shape = values;
    return true;
  }
  if (name == "extras" || id == schema::kNone) {
    walk.place = Walk::Place::unknown;
    return into_unknown(walk);
  }
  walk.owner = id;
  walk.owner_node = walk.node;
  const schema::Property* property = schemas_.find_property(id, name);
  if (property != nullptr && name != "extensions") return into_member(walk, *property);
  if (name == "extensions") {
    walk.node = asset_.document().find(walk.node, name);
    walk.place = Walk::Place::extensions;
    walk.property = nullptr;
    return true;
  }
  return missing_member(walk, schemas_.type(id));
}

bool ObjectModel::into_member(Walk& walk, const schema::Property& property) {
  walk.node = asset_.document().find(walk.node, walk.step());
  walk.shape = property.shape;
  walk.property = &property;
  walk.element = false;
  return true;
}

bool ObjectModel::missing_member(Walk& walk, const schema::ObjectType& type) {
  const std::string& name = walk.step();
  const bool last = walk.at + 1 == walk.steps.size();
  const bool state = type.name == "node" &&
                     std::find(kNodeState.begin(), kNodeState.end(), name) != kNodeState.end();
  const bool length =
      name.ends_with(kLength) &&
      schemas_.find_property(
          walk.owner, std::string_view(name).substr(0, name.size() - kLength.size())) != nullptr;
  if (last && (state || length)) {
    return walk.fail(Status::immutable,
                     fmt::format("{} is read-only at run time", gltfx::quoted(name)));
  }
  if (asset_.document().find(walk.node, name) != json::kNoNode) {
    if (type.open) return into_unknown(walk);
    return walk.fail(Status::immutable, fmt::format("{} is not a known property of {}",
                                                    gltfx::quoted(name), walk.here()));
  }
  if (guess_.type != &type || guess_.word != name) {
    std::vector<std::string_view> candidates{"extensions", "extras"};
    for (const schema::Property& each : type.properties) candidates.push_back(each.name);
    guess_ = {&type, name, nearest(name, candidates)};
  }
  walk.suggest(guess_.nearest);
  return walk.fail(Status::unresolved,
                   fmt::format("{} has no property {}", walk.here(), gltfx::quoted(name)));
}

bool ObjectModel::into_array(Walk& walk) {
  const auto index = array_index(walk.step());
  const bool runtime = walk.property != nullptr && !walk.property->mutable_type.empty();
  const json::Document& document = asset_.document();
  if (!index) {
    return walk.fail(Status::unresolved, fmt::format("{} is an array, but {} is not an index",
                                                     walk.here(), gltfx::quoted(walk.step())));
  }
  if (runtime) {
    walk.element = true;
    walk.target.element = index;
    return true;
  }
  const std::uint64_t size = arrays_.size(walk.node);
  if (*index >= size) {
    return walk.fail(Status::unresolved,
                     fmt::format("{} has {}", walk.here(), plural(size, "element")));
  }
  walk.shape = items_of(walk.shape);
  walk.element = true;
  const bool numbers = document.kind(walk.node) == json::Kind::number_array;
  if (!numbers) walk.node = arrays_.elements(walk.node)[*index];
  // The elements of a number array have no members: further steps are invalid.
  if (numbers && walk.at + 1 < walk.steps.size()) {
    ++walk.at;
    return walk.fail(Status::unresolved, fmt::format("{} has no members", walk.here()));
  }
  return true;
}

bool ObjectModel::into_extension(Walk& walk) {
  const std::string& name = walk.step();
  const json::NodeId object =
      walk.node == json::kNoNode ? json::kNoNode : asset_.document().find(walk.node, name);
  if (object == json::kNoNode) {
    std::vector<std::string_view> written;
    const json::Document& document = asset_.document();
    if (walk.node != json::kNoNode && document.is_object(walk.node)) {
      for (const auto each : document.members(walk.node)) {
        if (written.size() < kCandidates) written.push_back(document.key(each.key_id));
      }
    }
    walk.suggest(nearest(name, written));
    return walk.fail(Status::unresolved,
                     fmt::format("{} has no extension {}", printable(walk.pointer(walk.at - 1)),
                                 gltfx::quoted(name)));
  }
  const schema::ExtensionId id = schemas_.find_extension(name);
  schema::ShapeId home = schema::kNone;
  if (id != schema::kNone) {
    home = schemas_.extensions()[id].shape_on(walk.owner);
    const schema::TypeId origin = schemas_.type(walk.owner).origin;
    if (home == schema::kNone && origin != schema::kNone) {
      home = schemas_.extensions()[id].shape_on(origin);
    }
  }
  walk.node = object;
  walk.shape = home;
  walk.place = home == schema::kNone ? Walk::Place::unknown : Walk::Place::value;
  walk.property = nullptr;
  return true;
}

// Without a schema, the content of the document decides.
bool ObjectModel::into_unknown(Walk& walk) {
  walk.place = Walk::Place::unknown;
  walk.property = nullptr;
  const json::Document& document = asset_.document();
  if (document.is_object(walk.node)) {
    const json::NodeId next = asset_.document().find(walk.node, walk.step());
    if (next != json::kNoNode) {
      walk.node = next;
      return true;
    }
  } else if (document.is_array(walk.node)) {
    const auto index = array_index(walk.step());
    if (index && *index < arrays_.size(walk.node)) {
      if (document.kind(walk.node) == json::Kind::array)
        walk.node = arrays_.elements(walk.node)[*index];
      return true;
    }
  }
  return walk.fail(Status::unresolved,
                   fmt::format("{} has no {}", walk.here(), gltfx::quoted(walk.step())));
}

void ObjectModel::arrive(Walk& walk) {
  PropertyTarget& target = walk.target;
  if (walk.place == Walk::Place::unknown) {
    target.status = Status::outside;
    target.property = walk.pointer(walk.steps.size());
    target.value = walk.node;
    return;
  }
  if (walk.property == nullptr || walk.property->mutable_type.empty()) {
    const bool known = walk.property != nullptr && !walk.element;
    walk.fail(Status::immutable,
              known ? fmt::format("{} is not mutable in the object model",
                                  gltfx::quoted(walk.property->name))
                    : fmt::format("{} is not a property with a value", walk.here()));
    return;
  }
  target.status = Status::mutable_property;
  target.type = property_type_from_name(walk.property->mutable_type);
  target.property = walk.pointer(walk.steps.size() - (walk.element ? 1 : 0));
  target.value = walk.element ? json::kNoNode : walk.node;
  const schema::ShapeId shape = walk.property->shape;
  target.animated_minimum = walk.property->animated_minimum;
  target.numbers = items_of(shape) == schema::kNone ? shape : items_of(shape);
  if (schemas_.type(walk.owner).name == "node") arrive_at_node(walk);
  const bool runtime = target.type == PropertyType::number_array;
  if (walk.element) target.type = PropertyType::number;
  if (target.status == Status::mutable_property && walk.node == json::kNoNode && !runtime &&
      walk.property->default_json.empty()) {
    walk.fail(Status::unresolved, fmt::format("{} is not present and has no default", walk.here()));
  }
}

// The properties of a node depend on its kind, not on the members in the text (object model,
// section 4).
void ObjectModel::arrive_at_node(Walk& walk) {
  PropertyTarget& target = walk.target;
  const std::string_view name = walk.property->name;
  if (name != "translation" && target.type != PropertyType::number_array &&
      asset_.document().find(walk.owner_node, "matrix") != json::kNoNode) {
    walk.fail(Status::unresolved, fmt::format("a node with a matrix has no {}", name));
    return;
  }
  if (target.type != PropertyType::number_array) return;
  target.length = morph_target_count(walk.owner_node);
  if (target.length == 0) {
    walk.fail(Status::unresolved, "the node has no mesh with morph targets");
  } else if (target.element && *target.element >= target.length) {
    walk.fail(Status::unresolved,
              fmt::format("the mesh of the node has {}", plural(target.length, "morph target")));
  }
}

schema::TypeId ObjectModel::type_of(schema::ShapeId shape) const {
  if (shape == schema::kNone) return schema::kNone;
  const schema::Shape& known = schemas_.shape(shape);
  if (known.type != schema::kNone) return known.type;
  for (const auto* const branches : {&known.all_of, &known.one_of, &known.any_of}) {
    for (const schema::ShapeId branch : *branches) {
      if (schemas_.shape(branch).type != schema::kNone) return schemas_.shape(branch).type;
    }
  }
  return schema::kNone;
}

schema::ShapeId ObjectModel::items_of(schema::ShapeId shape) const {
  return shape == schema::kNone ? schema::kNone : schemas_.shape(shape).items;
}

std::uint64_t ObjectModel::morph_target_count(json::NodeId node) {
  const auto mesh = asset_.index(node, "mesh", RootArray::meshes);
  if (!mesh) return 0;
  const json::NodeId object = asset_.elements(RootArray::meshes)[*mesh];
  const auto [known, fresh] = morph_targets_.try_emplace(object);
  if (fresh) {
    const auto all = primitives(asset_.document(), object);
    known->second = all.empty() ? 0 : morph_targets(asset_.document(), all.front()).size();
  }
  return known->second;
}

}  // namespace gltfx::model

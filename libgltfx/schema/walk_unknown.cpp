// SPDX-License-Identifier: Apache-2.0
// Members that are not in the type of an object: misspelt, misplaced, or of an earlier draft.
#include <algorithm>
#include <optional>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "schema/walker.hpp"

namespace gltfx::schema {
namespace {

std::string move_help(const Home& home) {
  const std::string through(home.through);
  switch (home.way) {
    case Home::Way::member:
      return "move it into \"" + through + "\": { … }";
    case Home::Way::element:
      return "move it into an element of \"" + through + "\"";
    case Home::Way::extension:
      return "move it into \"extensions\": { \"" + through + "\": { … } }";
    default:
      return "move it one level up";
  }
}

}  // namespace

void Walker::other_name(Frame& frame, json::KeyId key, json::NodeId value) {
  const ObjectType& type = set_.type(frame.type);
  if (type.open || other_shape(frame, document_.key(key)) != kNone) return;
  if (!frame.further) return unexpected(frame, key, value);
  if (!type.strict) return;
  report({frame.path, document_.key(key)}, Code::CONDITION_MISMATCH, document_.span(value - 1),
         quoted(document_.key(key)) + " is not allowed with the other members.");
}

void Walker::unexpected(Frame& frame, json::KeyId key, json::NodeId value) {
  const ObjectType& type = set_.type(frame.type);
  const std::string_view name = document_.key(key);
  std::string message = quoted(name) + " is not a known member of " + quoted(type.name);
  std::string help = version_help(set_.find_property(frame.type, name), name);
  if (help.empty()) help = did_you_mean(name, known_names(type));
  if (help.empty() && set_.find_extension(name) != kNone) {
    help = "move it into \"extensions\": { … }";
  }
  const Home home = help.empty() ? home_of(frame, name) : Home();
  if (home.way != Home::Way::none) {
    message += "; it belongs in " + home_name(set_, home);
    help = move_help(home);
  }
  report({frame.path, name}, Code::UNEXPECTED_PROPERTY, document_.span(value - 1), message + ".",
         std::move(help), is_explained(name) ? std::optional(Severity::info) : std::nullopt);
}

// The names that the version of the asset has.
std::vector<std::string_view> Walker::known_names(const ObjectType& type) const {
  std::vector<std::string_view> known{"extensions", "extras"};
  if (type.properties.size() >= comparisons_left_) return known;
  for (const Property& property : type.properties) {
    if (property.since <= version_ || !property.draft.empty()) known.push_back(property.name);
  }
  return known;
}

// A name of a later version, or one that a draft may get.
std::string Walker::version_help(const Property* property, std::string_view name) const {
  if (deviations().draft_names_are_unexpected) return {};
  if (property != nullptr && version_ < property->since) {
    return "remove the member, or use the version that has it: it is of glTF " +
           version_text(property->since);
  }
  if (!is_explained(name)) return {};
  return "it is proposed for glTF " + version_text(version_) + ", but not in its text";
}

bool Walker::is_explained(std::string_view name) const {
  if (set_.versions().empty() || version_ != set_.newest_version()) return false;
  const auto& names = set_.versions().back().explained;
  return std::find(names.begin(), names.end(), name) != names.end();
}

// Limited like suggestions: the search visits all extensions.
Home Walker::home_of(const Frame& frame, std::string_view name) {
  const std::size_t comparisons = set_.extensions().size();
  if (comparisons > comparisons_left_) return {};
  comparisons_left_ -= comparisons;
  Neighbourhood around{frame.type, frame.node};
  around.version = version_;
  const Frame* above = frame.parent;
  for (; above != nullptr && above->mode != Mode::object; above = above->parent) {
    if (above->mode == Mode::array) around.among_others |= document_.array_size(above->node) > 1;
  }
  if (above != nullptr) {
    around.type_above = above->type;
    around.object_above = above->node;
  }
  return find_home(set_, document_, around, name);
}

void Walker::renamed(const Frame& frame, const Property& property, json::NodeId value) {
  const std::string_view name = key_of(value);
  if (deviations().draft_names_are_unexpected) {
    report({frame.path, name}, Code::UNEXPECTED_PROPERTY, document_.span(value - 1),
           quoted(name) + " is not a known member of " + quoted(set_.type(frame.type).name) + ".");
    return;
  }
  report({frame.path, name}, Code::PROPERTY_RENAMED, document_.span(value - 1),
         quoted(name) + " is the name of " + quoted(property.name) + " in an earlier draft.",
         "rename it to " + quoted(property.name));
}

}  // namespace gltfx::schema

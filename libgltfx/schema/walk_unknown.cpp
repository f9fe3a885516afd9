// SPDX-License-Identifier: Apache-2.0
// Members that are not in the type of an object: misspelt, misplaced, or of an earlier draft.
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
  std::vector<std::string_view> known{"extensions", "extras"};
  if (type.properties.size() < comparisons_left_) {
    for (const Property& property : type.properties) known.push_back(property.name);
  }
  std::string message = quoted(name) + " is not a known member of " + quoted(type.name);
  std::string help = did_you_mean(name, known);
  if (help.empty() && set_.find_extension(name) != kNone) {
    help = "move it into \"extensions\": { … }";
  }
  const Home home = help.empty() ? home_of(frame, name) : Home();
  if (home.way != Home::Way::none) {
    message += "; it belongs in " + home_name(set_, home);
    help = move_help(home);
  }
  report({frame.path, name}, Code::UNEXPECTED_PROPERTY, document_.span(value - 1), message + ".",
         std::move(help));
}

// Limited like suggestions: the search visits all extensions.
Home Walker::home_of(const Frame& frame, std::string_view name) {
  const std::size_t comparisons = set_.extensions().size();
  if (comparisons > comparisons_left_) return {};
  comparisons_left_ -= comparisons;
  Neighbourhood around{frame.type, frame.node};
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

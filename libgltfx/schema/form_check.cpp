// SPDX-License-Identifier: Apache-2.0
#include "schema/form_check.hpp"

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "base/suggestion.hpp"
#include "base/text.hpp"
#include "schema/pattern.hpp"
#include "schema/source.hpp"
#include "schema/version.hpp"

namespace gltfx::schema {
namespace {

constexpr std::string_view kDialect = "https://json-schema.org/draft/2020-12/schema";

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '.';
}

bool is_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_name_character);
}

bool is_file_id(std::string_view id) {
  for (const std::string_view prefix : {"gltfx:core/", "gltfx:ext/"}) {
    if (id.substr(0, prefix.size()) == prefix) return is_name(id.substr(prefix.size()));
  }
  return false;
}

bool is_reference(std::string_view reference) {
  const std::size_t hash = std::min(reference.find('#'), reference.size());
  const std::string_view file = reference.substr(0, hash);
  const std::string_view place = reference.substr(hash);
  constexpr std::string_view kDefs = "#/$defs/";
  const bool place_ok = place.empty() || (place.substr(0, kDefs.size()) == kDefs &&
                                          is_name(place.substr(kDefs.size())));
  return place_ok && (file.empty() ? !place.empty() : is_file_id(file));
}

// Steps between slashes, each a name or '*'.
bool is_target(std::string_view target) {
  if (!target.empty() && target.front() == '/') target.remove_prefix(1);
  while (true) {
    const std::size_t end = std::min(target.find('/'), target.size());
    const std::string_view step = target.substr(0, end);
    if (step != "*" && !is_name(step)) return false;
    if (end == target.size()) return true;
    target.remove_prefix(end + 1);
  }
}

// Names of members between slashes.
bool is_member_path(std::string_view path) {
  return is_target(path) && path.front() != '/' && path.find('*') == std::string_view::npos;
}

// "2025-09-15 b102d2d": a year, month or day, optionally with the commit.
bool is_revision(std::string_view text) {
  const std::size_t space = std::min(text.find(' '), text.size());
  const std::string_view date = text.substr(0, space);
  if (date.size() != 4 && date.size() != 7 && date.size() != 10) return false;
  for (std::size_t i = 0; i < date.size(); ++i) {
    const bool digit = date[i] >= '0' && date[i] <= '9';
    if (i == 4 || i == 7 ? date[i] != '-' : !digit) return false;
  }
  if (space == text.size()) return true;
  const std::string_view commit = text.substr(space + 1);
  return commit.size() >= 7 && commit.find_first_not_of("0123456789abcdef") == commit.npos;
}

// The name of an early extension is only a prefix.
bool is_name_of_extension(std::string_view name) {
  return is_extension_name(name) || is_extension_name(std::string(name) + "_x");
}

// A subset of "rgba", not empty, in that order.
bool is_channels(std::string_view channels) {
  std::size_t last = 0;
  for (const char c : channels) {
    const std::size_t place = std::string_view("rgba").find(c, last);
    if (place == std::string_view::npos) return false;
    last = place + 1;
  }
  return !channels.empty();
}

// "r>a": the source and the target of a channel.
bool is_swizzle(std::string_view text) {
  constexpr std::string_view kChannels = "rgba";
  return text.size() == 3 && text[1] == '>' && kChannels.find(text[0]) != kChannels.npos &&
         kChannels.find(text[2]) != kChannels.npos;
}

bool is_media_type(std::string_view type) {
  const std::size_t slash = type.find('/');
  return slash != std::string_view::npos && slash != 0 && slash + 1 != type.size() &&
         type.find('/', slash + 1) == std::string_view::npos;
}

// The check of texts of a form; null if any text is allowed.
struct TextRule {
  bool (*holds)(std::string_view);
  std::string_view expected;
};

TextRule text_rule(Form form) {
  switch (form) {
    case Form::nonempty_text:
      return {[](std::string_view t) { return !t.empty(); }, "must not be empty"};
    case Form::dialect:
      return {[](std::string_view t) { return t == kDialect; },
              "must be \"https://json-schema.org/draft/2020-12/schema\""};
    case Form::file_id:
      return {is_file_id, "must be \"gltfx:core/TYPE\" or \"gltfx:ext/NAME\""};
    case Form::reference:
      return {is_reference, "must be the $id of a file, \"#/$defs/NAME\", or both joined"};
    case Form::target:
      return {is_target, "must be an array of the root, \"/path/from/root\" or \"TYPE/member\""};
    case Form::name_target:
      return {[](std::string_view t) { return t.substr(0, 1) == "/" && is_target(t); },
              "must be a path from the root: \"/extensions/NAME/member/*/name\""};
    case Form::member_path:
      return {is_member_path, "must be members with '/' between them"};
    case Form::revision:
      return {is_revision, "must be a date and maybe a commit: \"2025-09-15 b102d2d\""};
    case Form::version:
      return {[](std::string_view t) { return parse_version(t).has_value(); },
              "must be a version such as 2.1"};
    case Form::channels:
      return {is_channels, "must be letters of \"rgba\" in this order"};
    case Form::swizzle:
      return {is_swizzle, "must name two channels of rgba such as \"r>a\""};
    case Form::extension_name:
      return {is_name_of_extension, "must be an extension name such as KHR_x"};
    case Form::url:
      return {[](std::string_view t) { return t.substr(0, 8) == "https://" && t.size() > 8; },
              "must start with https://"};
    case Form::media_types:
      return {is_media_type, "must contain media types such as image/png"};
    default:
      return {nullptr, {}};
  }
}

}  // namespace

std::optional<std::string> pattern_flaw(std::string_view expression) {
  const auto pattern = Pattern::compile(expression);
  if (pattern) return std::nullopt;
  return "is not a supported regular expression: " + pattern.error().message;
}

bool is_extension_name(std::string_view name) {
  const std::size_t bar = name.find('_');
  if (bar == std::string_view::npos || bar == 0 || bar + 1 == name.size()) return false;
  const auto is_prefix = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9'); };
  const auto is_rest = [](char c) { return is_name_character(c) && c != '.'; };
  return std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(bar), is_prefix) &&
         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(bar), name.end(), is_rest);
}

std::optional<Flaw> FormCheck::flaw(Form form, json::NodeId node) const {
  switch (form) {
    case Form::any:
      return std::nullopt;
    case Form::list:
      if (document_.is_array(node)) return std::nullopt;
      return Flaw{node, "must be a list"};
    case Form::names:
      return list_of(Form::text, node, true);
    case Form::media_types:
      return document_.is_string(node) ? scalar(form, node) : list_of(form, node, false);
    case Form::element_types:
    case Form::component_types:
      return list_of(form, node, false);
    case Form::type:
      return document_.is_string(node) ? one_of(form, node) : list_of(form, node, false);
    case Form::literals:
      return literals(node);
    case Form::names_map:
      return map_of(Form::names, node);
    case Form::channel_factors:
      return channel_factors(node);
    case Form::enum_additions:
      return map_of(Form::literals, node);
    case Form::enum_names:
      return enum_names(node);
    case Form::attachment_points:
      return attachment_points(node);
    default:
      return scalar(form, node);
  }
}

std::optional<Flaw> FormCheck::scalar(Form form, json::NodeId node) const {
  switch (form) {
    case Form::flag:
      if (document_.is_boolean(node)) return std::nullopt;
      return Flaw{node, "must be true or false"};
    case Form::number:
    case Form::positive:
    case Form::count:
      return number_form(form, node);
    case Form::literal:
      if (!document_.is_object(node) && !document_.is_array(node)) return std::nullopt;
      return Flaw{node, "must be a number, a string, true, false or null"};
    default:
      return text_form(form, node);
  }
}

std::optional<Flaw> FormCheck::number_form(Form form, json::NodeId node) const {
  if (form == Form::count) {
    if (document_.unsigned_integer(node)) return std::nullopt;
    return Flaw{node, "must be an integer of at least 0"};
  }
  if (!document_.is_number(node)) return Flaw{node, "must be a number"};
  if (form == Form::positive && !(document_.number(node).value > 0))
    return Flaw{node, "must be above 0"};
  return std::nullopt;
}

std::optional<Flaw> FormCheck::text_form(Form form, json::NodeId node) const {
  if (!document_.is_string(node)) return Flaw{node, "must be a string"};
  if (!listed_values(form).empty()) return one_of(form, node);
  const std::string text = document_.string(node);
  if (form == Form::pattern) {
    if (const auto flaw = pattern_flaw(text)) return Flaw{node, *flaw};
    return std::nullopt;
  }
  const TextRule rule = text_rule(form);
  if (rule.holds == nullptr || rule.holds(text)) return std::nullopt;
  return Flaw{node, std::string(rule.expected) + ", not " + quoted(text)};
}

std::optional<Flaw> FormCheck::one_of(Form form, json::NodeId node) const {
  const auto known = listed_values(form);
  if (!document_.is_string(node)) return Flaw{node, "must be a string"};
  const std::string text = document_.string(node);
  if (std::find(known.begin(), known.end(), text) != known.end()) return std::nullopt;
  const std::vector<std::string> list(known.begin(), known.end());
  return Flaw{node,
              "must be " + join_or(list, 12) + ", not " + quoted(text) + did_you_mean(text, known)};
}

std::optional<Flaw> FormCheck::list_of(Form element, json::NodeId node, bool may_be_empty) const {
  if (document_.kind(node) != json::Kind::array) return Flaw{node, "must be a list of strings"};
  std::unordered_set<std::string> seen;
  for (const json::NodeId item : document_.elements(node)) {
    auto flaw = listed_values(element).empty() ? scalar(element, item) : one_of(element, item);
    if (flaw) return flaw;
    if (!seen.insert(document_.string(item)).second) return Flaw{item, "has a duplicate entry"};
  }
  if (seen.empty() && !may_be_empty) return Flaw{node, "must not be empty"};
  return std::nullopt;
}

std::optional<Flaw> FormCheck::literals(json::NodeId node) const {
  if (document_.kind(node) == json::Kind::number_array) return std::nullopt;
  if (document_.kind(node) != json::Kind::array || document_.array_size(node) == 0) {
    return Flaw{node, "must be a list with at least one element"};
  }
  for (const json::NodeId item : document_.elements(node)) {
    if (auto flaw = scalar(Form::literal, item)) return flaw;
  }
  return std::nullopt;
}

std::optional<Flaw> FormCheck::map_of(Form value, json::NodeId node) const {
  if (!document_.is_object(node)) return Flaw{node, "must be an object"};
  for (const auto& member : document_.members(node)) {
    if (auto found = flaw(value, member.value)) return found;
  }
  return std::nullopt;
}

std::optional<Flaw> FormCheck::enum_names(json::NodeId node) const {
  if (auto flaw = map_of(Form::nonempty_text, node)) return flaw;
  for (const auto& member : document_.members(node)) {
    const std::string_view key = document_.key(member.key_id);
    const std::string_view digits = key.substr(key.substr(0, 1) == "-" ? 1 : 0);
    if (digits.empty() || digits.size() > 15 ||
        digits.find_first_not_of("0123456789") != digits.npos) {
      return Flaw{member.key, "must have integers as keys"};
    }
  }
  return std::nullopt;
}

std::optional<Flaw> FormCheck::channel_factors(json::NodeId node) const {
  if (auto flaw = map_of(Form::nonempty_text, node)) return flaw;
  for (const auto& member : document_.members(node)) {
    if (!is_channels(document_.key(member.key_id))) {
      return Flaw{member.key, "must have channels as keys: letters of rgba, in this order"};
    }
  }
  return std::nullopt;
}

std::optional<Flaw> FormCheck::attachment_points(json::NodeId node) const {
  if (document_.is_array(node)) return list_of(Form::text, node, true);
  if (!document_.is_object(node))
    return Flaw{node, "must be a list of types, or an object of types"};
  for (const auto& member : document_.members(node)) {
    const bool fits =
        document_.is_string(member.value) && (document_.string(member.value) == "#" ||
                                              (document_.raw(member.value).substr(0, 2) == "\"#" &&
                                               is_reference(document_.string(member.value))));
    if (!fits) return Flaw{member.value, "must map each type to a \"#/$defs/NAME\" of this file"};
  }
  return std::nullopt;
}

}  // namespace gltfx::schema

// SPDX-License-Identifier: Apache-2.0
#include "schema_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"

namespace gltfx::tool {
namespace {

using schema::Set;
using schema::Shape;
using schema::ShapeId;

constexpr std::array<std::pair<std::uint8_t, std::string_view>, 7> kTypeNames{{
    {schema::kNull, "null"},
    {schema::kBoolean, "boolean"},
    {schema::kInteger, "integer"},
    {schema::kNumber, "number"},
    {schema::kString, "string"},
    {schema::kArray, "array"},
    {schema::kObject, "object"},
}};

std::string plain_type(std::uint8_t types) {
  std::vector<std::string> names;
  for (const auto& [bit, name] : kTypeNames) {
    if ((types & bit) != 0) names.emplace_back(name);
  }
  return names.empty() ? std::string("any value") : join_or(names);
}

std::string count_words(std::uint64_t least, std::uint64_t most, std::uint64_t open_end) {
  if (least == most) return fmt::format("{}", least);
  if (most == open_end) return least == 0 ? std::string() : fmt::format("at least {}", least);
  return least == 0 ? fmt::format("at most {}", most) : fmt::format("{} to {}", least, most);
}

std::string plural(const std::string& noun) {
  if (noun == "any value") return "values";
  return noun + "s";
}

// The object type of a shape, also searched in the shapes that it combines.
std::string object_name(const Set& set, const Shape& shape) {
  if (shape.type != schema::kNone) return set.type(shape.type).name;
  for (const ShapeId part : shape.all_of) {
    if (set.shape(part).type != schema::kNone) return set.type(set.shape(part).type).name;
  }
  return {};
}

std::string array_words(const Set& set, const Shape& shape) {
  const std::string count = count_words(shape.min_items, shape.max_items, UINT64_MAX);
  if (shape.items == schema::kNone) {
    return count.empty() ? std::string("array") : fmt::format("array of {} values", count);
  }
  const Shape& item = set.shape(shape.items);
  if (const std::string name = object_name(set, item); !name.empty()) {
    return count.empty() ? fmt::format("array of {}", name)
                         : fmt::format("array of {} ({})", name, count);
  }
  if (item.ref) return fmt::format("array of indices into {}", printable(item.ref->text));
  const std::string items = plural(plain_type(item.types));
  return count.empty() ? fmt::format("array of {}", items)
                       : fmt::format("array of {} {}", count, items);
}

std::string range_words(const Shape& shape) {
  const bool low = std::isfinite(shape.minimum);
  const bool high = std::isfinite(shape.maximum);
  std::string words;
  if (low && high && !shape.exclusive_minimum && !shape.exclusive_maximum) {
    words = fmt::format("{} to {}", number_text(shape.minimum), number_text(shape.maximum));
  } else {
    if (low) {
      words = fmt::format("{} {}", shape.exclusive_minimum ? "above" : "at least",
                          number_text(shape.minimum));
    }
    if (high) {
      words +=
          fmt::format("{}{} {}", words.empty() ? "" : ", ",
                      shape.exclusive_maximum ? "below" : "at most", number_text(shape.maximum));
    }
  }
  if (shape.multiple_of > 0) {
    words +=
        fmt::format("{}multiple of {}", words.empty() ? "" : ", ", number_text(shape.multiple_of));
  }
  return words;
}

std::string literal_words(const schema::Literal& literal) {
  switch (literal.kind) {
    case schema::Literal::Kind::null:
      return "null";
    case schema::Literal::Kind::boolean:
      return literal.number != 0 ? "true" : "false";
    case schema::Literal::Kind::string:
      return '"' + printable(literal.string) + '"';
    case schema::Literal::Kind::number:
      break;
  }
  const std::string number = number_text(literal.number);
  return literal.name.empty() ? number : fmt::format("{} ({})", number, printable(literal.name));
}

std::string text_words(const Set& set, const Shape& shape) {
  std::string words;
  const std::string length = count_words(shape.min_length, shape.max_length, UINT64_MAX);
  if (!length.empty()) words = fmt::format("{} characters", length);
  if (shape.pattern != schema::kNone) {
    words += fmt::format("{}like /{}/", words.empty() ? "" : ", ",
                         printable(set.pattern_text(shape.pattern)));
  }
  if (!shape.format.empty()) {
    words += fmt::format("{}{}", words.empty() ? "" : ", ", printable(shape.format));
  }
  return words;
}

std::string own_limits(const Set& set, const Shape& shape) {
  if (!shape.literals.empty()) {
    std::vector<std::string> values;
    for (const schema::Literal& literal : shape.literals) values.push_back(literal_words(literal));
    return values.size() == 1 ? values.front() : join_or(values, 24);
  }
  std::string words = range_words(shape);
  const std::string text = text_words(set, shape);
  if (!words.empty() && !text.empty()) words += ", ";
  return words + text;
}

}  // namespace

std::string type_words(const Set& set, ShapeId id) {
  if (id == schema::kNone) return "any value";
  const Shape& shape = set.shape(id);
  if (std::string name = object_name(set, shape); !name.empty()) return name;
  if (shape.ref) return fmt::format("index into {}", printable(shape.ref->text));
  if ((shape.types & schema::kArray) != 0) return array_words(set, shape);
  if (shape.types == 0 && !shape.literals.empty()) return "value";
  return plain_type(shape.types);
}

std::string limit_words(const Set& set, ShapeId id) {
  if (id == schema::kNone) return {};
  const Shape& shape = set.shape(id);
  if (shape.ref) return {};
  std::string words = own_limits(set, shape);
  if (shape.items != schema::kNone) {
    const std::string of_items = own_limits(set, set.shape(shape.items));
    if (!of_items.empty()) words += fmt::format("{}each {}", words.empty() ? "" : ", ", of_items);
  }
  for (const auto* alternatives : {&shape.any_of, &shape.one_of}) {
    std::vector<std::string> values;
    for (const ShapeId part : *alternatives) {
      const std::string of_part = own_limits(set, set.shape(part));
      if (!of_part.empty()) values.push_back(of_part);
    }
    if (!values.empty()) words += (words.empty() ? "" : ", ") + join_or(values, 24);
  }
  return words;
}

std::string slot_words(const schema::Slot& slot) {
  const auto capital = [](std::string channels) {
    for (char& c : channels) c = static_cast<char>(c - 'a' + 'A');
    return channels;
  };
  const bool only_alpha = slot.channels == "a";
  std::string words = fmt::format("reads {} ({})", capital(slot.channels),
                                  slot.srgb && !only_alpha ? "RGB is sRGB" : "linear");
  if (!slot.scaled_by.empty()) words += fmt::format(", scaled by {}", printable(slot.scaled_by));
  for (const auto& [channels, factor] : slot.factors) {
    words += fmt::format(", {} scaled by {}", capital(channels), printable(factor));
  }
  return words;
}

std::vector<std::string> home_names(const Set& set, const schema::Extension& extension) {
  std::vector<std::string> names;
  for (const auto& home : extension.attachment_points) {
    const std::string& name = set.type(set.type(home.first).origin).name;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::vector<schema::TypeId> types_of(const Set& set, schema::ExtensionId extension) {
  std::vector<schema::TypeId> ids;
  for (schema::TypeId id = 0; id < set.types().size(); ++id) {
    const schema::ObjectType& type = set.type(id);
    const bool original = type.origin == id || type.origin == schema::kNone;
    // The shape of an `if` or `then` has the name of the type that it is about.
    const bool named = set.find_type(type.name) == id;
    if (type.extension == extension && original && named) ids.push_back(id);
  }
  // Objects on core types come before their parts.
  std::stable_partition(ids.begin(), ids.end(), [&](schema::TypeId id) {
    return extension != schema::kNone &&
           set.type(id).name.ends_with("." + set.extensions()[extension].name);
  });
  return ids;
}

std::vector<std::string_view> core_type_names(const Set& set) {
  std::vector<std::string_view> names;
  for (const schema::TypeId id : types_of(set, schema::kNone)) names.push_back(set.type(id).name);
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<const schema::Extension*> sorted_extensions(
    const Set& set, const std::vector<schema::Status>& statuses) {
  std::vector<const schema::Extension*> sorted;
  for (const schema::Extension& extension : set.extensions()) {
    const bool wanted =
        std::find(statuses.begin(), statuses.end(), extension.status) != statuses.end();
    if (wanted || statuses.empty()) sorted.push_back(&extension);
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const auto* a, const auto* b) { return a->name < b->name; });
  return sorted;
}

std::vector<std::string> generation_names(const Set& set) {
  std::vector<std::string> names{"auto"};
  for (const schema::Extension& extension : set.extensions()) {
    if (extension.upgrade.to.empty()) continue;
    for (const schema::Generation& generation : extension.generations) {
      std::string_view rest = generation.name;
      while (!rest.empty()) {
        const std::size_t end = std::min(rest.find('/'), rest.size());
        names.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
      }
    }
  }
  return names;
}

std::string_view must_be_required_name(schema::MustBeRequired must) {
  switch (must) {
    case schema::MustBeRequired::optional:
      return "";
    case schema::MustBeRequired::recommended:
      return "recommended";
    case schema::MustBeRequired::without_fallback:
      return "without-fallback";
    case schema::MustBeRequired::always:
      break;
  }
  return "always";
}

}  // namespace gltfx::tool

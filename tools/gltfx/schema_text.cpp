// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/number.hpp"
#include "base/text.hpp"
#include "schema_print.hpp"
#include "schema_words.hpp"

namespace gltfx::tool {
namespace {

// The embedded files are minified: adds a space after each comma.
std::string spaced(std::string_view json) {
  std::string text;
  for (const char c : json) {
    if (!text.empty() && text.back() == ',' && c != ' ') text += ' ';
    text += c;
  }
  return text;
}

using schema::Set;

// "key:     value" lines, wrapped and aligned.
class Facts {
 public:
  void add(std::string_view key, std::string_view value) {
    if (value.empty()) return;
    std::string lines = wrapped(printable(value), kColumn);
    lines.replace(0, kColumn, padded("  " + std::string(key), kColumn));
    text_ += lines;
  }
  const std::string& text() const { return text_; }

 private:
  static constexpr std::size_t kColumn = 16;
  std::string text_;
};

void append(std::string& words, std::string_view more) {
  if (more.empty()) return;
  if (!words.empty()) words += "; ";
  words += more;
}

std::string property_facts(const Set& set, const schema::Property& property) {
  std::string words = type_words(set, property.shape);
  append(words, limit_words(set, property.shape));
  if (property.required) append(words, "required");
  if (!property.default_json.empty()) append(words, "default " + spaced(property.default_json));
  if (!property.unit.empty()) append(words, "in " + property.unit);
  if (property.shape != schema::kNone) {
    const auto& slot = set.shape(property.shape).slot;
    if (slot) append(words, slot_words(*slot));
  }
  if (!property.mutable_type.empty()) append(words, "animatable as " + property.mutable_type);
  if (std::isfinite(property.animated_minimum)) {
    append(words, fmt::format("at least {} when animated", number_text(property.animated_minimum)));
  }
  if (!property.aliases.empty()) {
    append(words, fmt::format("once called {}", fmt::join(property.aliases, ", ")));
  }
  if (!property.deprecated.empty()) append(words, "deprecated: " + property.deprecated);
  return words;
}

std::string relation_text(const schema::Relation& relation) {
  return fmt::format("{}: {}", relation.extension, relation.because);
}

std::string must_text(const schema::Extension& extension) {
  switch (extension.must_be_required) {
    case schema::MustBeRequired::optional:
      return {};
    case schema::MustBeRequired::recommended:
      return "recommended";
    case schema::MustBeRequired::without_fallback:
      return fmt::format("where '{}' gives no fallback", extension.fallback);
    case schema::MustBeRequired::always:
      break;
  }
  return "always";
}

void add_attributes(Facts& facts, std::string_view key,
                    const std::vector<schema::AttributeFormat>& attributes) {
  for (const schema::AttributeFormat& attribute : attributes) {
    facts.add(
        key,
        fmt::format("{}: {} of {}{}", attribute.semantic, fmt::join(attribute.types, "/"),
                    fmt::join(attribute.components, "/"), attribute.required ? ", required" : ""));
  }
}

std::string extension_facts(const Set& set, const schema::Extension& extension) {
  Facts facts;
  facts.add("status", schema::status_name(extension.status));
  facts.add("revision", extension.revision);
  const std::vector<std::string> attachment_points = home_names(set, extension);
  facts.add("sits on", attachment_points.empty()
                           ? "nothing: it is only declared"
                           : fmt::format("{}", fmt::join(attachment_points, ", ")));
  facts.add("to be required", must_text(extension));
  facts.add("successor", extension.successor);
  for (const auto& relation : extension.excludes) facts.add("excludes", relation_text(relation));
  for (const auto& relation : extension.requires_) facts.add("needs", relation_text(relation));
  for (const auto& relation : extension.overridden_by) {
    facts.add("overridden by", relation_text(relation));
  }
  if (extension.standalone) facts.add("excludes", "every other extension of the same object");
  facts.add("images", fmt::format("{}", fmt::join(extension.image_mime_types, ", ")));
  add_attributes(facts, "attribute", extension.vertex_attributes);
  add_attributes(facts, "morph target", extension.morph_attributes);
  add_attributes(facts, "instance", extension.instance_attributes);
  for (const schema::Generation& generation : extension.generations) {
    facts.add("generation", generation.name + ": " + generation.description);
  }
  const schema::Upgrade& upgrade = extension.upgrade;
  if (upgrade.does_something()) {
    std::string text =
        fmt::format("gltfx upgrade brings it to {}", upgrade.to.empty() ? "core glTF" : upgrade.to);
    if (!upgrade.alternatives.empty()) {
      text += fmt::format(" or {}", fmt::join(upgrade.alternatives, ", "));
    }
    if (!upgrade.opt_in.empty()) text += fmt::format(", on request: {}", upgrade.opt_in);
    facts.add("upgrade", text);
  }
  for (const schema::UpgradeStay& stay : upgrade.stays) {
    const std::string which = fmt::format("{}", fmt::join(stay.generations, ", "));
    facts.add("stays", which.empty() ? stay.because : which + ": " + stay.because);
  }
  facts.add("specification", extension.spec);
  return facts.text();
}

}  // namespace

std::string type_text(const Set& set, schema::TypeId id, const Style& style) {
  const schema::ObjectType& type = set.type(id);
  std::string text = style.bold(printable(type.name)) + '\n';
  const std::string& about = set.shape(type.shape).description;
  if (!about.empty()) text += wrapped(printable(about), 2);
  std::size_t width = 0;
  for (const schema::Property& property : type.properties) {
    width = std::max(width, count_code_points(property.name));
  }
  const std::size_t column = std::min<std::size_t>(width, 32) + 4;
  for (const schema::Property& property : type.properties) {
    const std::string lines = wrapped(printable(property_facts(set, property)), column);
    const std::string name = "  " + printable(property.name);
    if (count_code_points(name) + 2 <= column) {
      text.append(padded(name, column)).append(lines, std::min(column, lines.size()));
    } else {
      text.append(name).append(1, '\n').append(lines);
    }
    if (!property.description.empty()) {
      text += style.dim(wrapped(printable(property.description), column));
    }
  }
  if (type.open) text += "  further members are allowed\n";
  return text;
}

std::string extension_text(const Set& set, schema::ExtensionId id, const Style& style) {
  const schema::Extension& extension = set.extensions()[id];
  std::string text = style.bold(printable(extension.name)) + '\n';
  if (!extension.description.empty()) text += wrapped(printable(extension.description), 2);
  text += '\n' + extension_facts(set, extension);
  for (const schema::TypeId type : types_of(set, id)) text += '\n' + type_text(set, type, style);
  return text;
}

std::string schema_list_text(const Set& set, const std::vector<schema::Status>& statuses,
                             const Style& style) {
  const std::vector<const schema::Extension*> extensions = sorted_extensions(set, statuses);
  std::size_t width = 0;
  for (const schema::Extension* extension : extensions) {
    width = std::max(width, extension->name.size());
  }
  std::string text = style.bold("Extensions") + '\n';
  for (const schema::Extension* extension : extensions) {
    const std::vector<std::string> attachment_points = home_names(set, *extension);
    fmt::format_to(std::back_inserter(text), "  {}  {}  {}\n",
                   padded(printable(extension->name), width),
                   padded(schema::status_name(extension->status), 17),
                   attachment_points.empty()
                       ? "(declared only)"
                       : printable(fmt::format("{}", fmt::join(attachment_points, ", "))));
  }
  if (statuses.empty()) {
    text += '\n' + style.bold("Core types") + '\n';
    text += wrapped(fmt::format("{}", fmt::join(core_type_names(set), ", ")), 2);
  }
  text += fmt::format("\n{} extensions. 'gltfx schema NAME' shows one of them, or a core type.\n",
                      extensions.size());
  return text;
}

}  // namespace gltfx::tool

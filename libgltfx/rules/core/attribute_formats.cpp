// SPDX-License-Identifier: Apache-2.0
#include "rules/core/attribute_formats.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/fork.hpp"
#include "base/text.hpp"
#include "rules/extension_walk.hpp"

namespace gltfx::validate {
namespace {

using model::ElementType;
using model::FormatSet;
using model::SemanticKind;

// In the order of SemanticKind.
CoreFormats core_vertex_formats() {
  const FormatSet fractions2 =
      FormatSet::of({ElementType::vec2}, {"FLOAT", "UBYTE_NORM", "USHORT_NORM"});
  const FormatSet colors =
      FormatSet::of({ElementType::vec3, ElementType::vec4}, {"FLOAT", "UBYTE_NORM", "USHORT_NORM"});
  return {{{FormatSet::of({ElementType::vec3}, {"FLOAT"})},
           {FormatSet::of({ElementType::vec3}, {"FLOAT"})},
           {FormatSet::of({ElementType::vec4}, {"FLOAT"})},
           {fractions2},
           {colors},
           {FormatSet::of({ElementType::vec4}, {"UBYTE", "USHORT"})},
           {FormatSet::of({ElementType::vec4}, {"FLOAT", "UBYTE_NORM", "USHORT_NORM"})}}};
}

// Offsets may be negative, so signed fractions are also allowed. Skinning cannot be morphed.
CoreFormats core_morph_formats() {
  const std::initializer_list<std::string_view> signed_fractions{"FLOAT", "BYTE_NORM", "UBYTE_NORM",
                                                                 "SHORT_NORM", "USHORT_NORM"};
  return {{{FormatSet::of({ElementType::vec3}, {"FLOAT"})},
           {FormatSet::of({ElementType::vec3}, {"FLOAT"})},
           {FormatSet::of({ElementType::vec3}, {"FLOAT"})},
           {FormatSet::of({ElementType::vec2}, signed_fractions)},
           {FormatSet::of({ElementType::vec3, ElementType::vec4}, signed_fractions)},
           {},
           {}}};
}

// The core semantic for a name of a schema file.
SemanticKind kind_of(std::string_view semantic) {
  if (!semantic.ends_with("_n")) return model::parse_semantic(semantic).kind;
  semantic.remove_suffix(2);
  for (const SemanticKind kind :
       {SemanticKind::texcoord, SemanticKind::color, SemanticKind::joints, SemanticKind::weights}) {
    if (model::semantic_prefix(kind) == semantic) return kind;
  }
  return SemanticKind::extension;
}

SemanticKind kind_before_underscore(std::string_view name) {
  const std::string_view prefix = name.substr(0, name.find('_'));
  for (std::size_t i = 0; i < model::kCoreSemanticCount; ++i) {
    const auto kind = static_cast<SemanticKind>(i);
    if (model::semantic_prefix(kind) == prefix) return kind;
  }
  return SemanticKind::invalid;
}

bool is_core(SemanticKind kind) {
  return static_cast<std::size_t>(kind) < model::kCoreSemanticCount;
}

}  // namespace

bool allows(const FormatList& list, const model::Format& format) {
  return std::any_of(list.begin(), list.end(),
                     [&](const FormatSet& set) { return set.allows(format); });
}

std::string formats_text(const FormatList& list) {
  std::vector<std::string> alternatives;
  for (const FormatSet& set : list) {
    std::vector<std::string> types, components;
    for (unsigned i = 1; i <= static_cast<unsigned>(ElementType::mat4); ++i) {
      const auto type = static_cast<ElementType>(i);
      if (set.has_type(type)) types.emplace_back(model::element_type_name(type));
    }
    for (const auto& component : model::kComponentNames) {
      const std::string_view name = model::component_type_name(component.type);
      if (set.has_component(component.type, false)) components.emplace_back(name);
      if (set.has_component(component.type, true))
        components.push_back(fmt::format("normalized {}", name));
    }
    alternatives.push_back(fmt::format("{} of {}", join_or(types), join_or(components)));
  }
  return fmt::format("{}", fmt::join(alternatives, "; "));
}

void AttributeFormats::Table::add(const schema::AttributeFormat& format) {
  const SemanticKind kind = kind_of(format.semantic);
  if (is_core(kind)) {
    if (!extended) extended = *base;
    (*extended)[static_cast<std::size_t>(kind)].push_back(FormatSet::of(format));
  } else {
    others.emplace_back(format.semantic, FormatList{FormatSet::of(format)});
  }
}

void AttributeFormats::Table::sort() {
  std::stable_sort(others.begin(), others.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
}

AttributeFormats::AttributeFormats(const Context& context) {
  static constinit MadeOnce<CoreFormats> vertex_formats;
  static constinit MadeOnce<CoreFormats> morph_formats;
  vertex_.base = &vertex_formats.get(core_vertex_formats);
  morph_.base = &morph_formats.get(core_morph_formats);
  for (const schema::Extension* extension : declared_extensions(context)) {
    for (const auto& format : extension->vertex_attributes) vertex_.add(format);
    for (const auto& format : extension->morph_attributes) morph_.add(format);
  }
  vertex_.sort();
  morph_.sort();
}

const FormatList* AttributeFormats::find(const model::Attribute& attribute, bool target) const {
  const Table& table = target ? morph_ : vertex_;
  SemanticKind kind = attribute.semantic.kind;
  // The Khronos validator derives the format from the text before the first underscore.
  if (kind == SemanticKind::invalid) kind = kind_before_underscore(attribute.name);
  if (is_core(kind)) {
    const FormatList& formats = table.core()[static_cast<std::size_t>(kind)];
    return formats.empty() ? nullptr : &formats;
  }
  if (kind != SemanticKind::extension) return nullptr;
  const auto lookup = [&](std::string_view name) -> const FormatList* {
    const auto at = std::lower_bound(
        table.others.begin(), table.others.end(), name,
        [](const auto& entry, std::string_view wanted) { return entry.first < wanted; });
    return at != table.others.end() && at->first == name ? &at->second : nullptr;
  };
  const FormatList* exact = lookup(attribute.name);
  if (exact != nullptr) return exact;
  const std::size_t digits = attribute.name.find_last_not_of("0123456789") + 1;
  return lookup(std::string(attribute.name.substr(0, digits)) + "n");
}

std::string_view extension_that_allows(const schema::Set& schemas,
                                       const model::Attribute& attribute, bool target,
                                       const model::Format& format) {
  for (const schema::Extension& extension : schemas.extensions()) {
    if (model::adds_format(extension, attribute, target, format)) return extension.name;
  }
  return {};
}

}  // namespace gltfx::validate

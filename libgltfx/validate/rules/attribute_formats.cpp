// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/attribute_formats.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "validate/rules/extension_walk.hpp"

namespace gltfx::validate {
namespace {

using model::ComponentType;
using model::ElementType;
using model::SemanticKind;

constexpr std::array<ComponentType, 9> kComponents{
    ComponentType::int8,    ComponentType::uint8,   ComponentType::int16,
    ComponentType::uint16,  ComponentType::int32,   ComponentType::uint32,
    ComponentType::float32, ComponentType::float64, ComponentType::float16};

// Names as schema files have them, in the order of kComponents.
constexpr std::array<std::string_view, 9> kNames{"BYTE", "UBYTE", "SHORT",  "USHORT", "INT",
                                                 "UINT", "FLOAT", "DOUBLE", "HALF"};

constexpr std::uint32_t bit(std::size_t component, bool normalized) {
  return 1U << (component * 2 + (normalized ? 1 : 0));
}

std::uint32_t component_bit(const model::Format& format) {
  const auto at = std::find(kComponents.begin(), kComponents.end(), format.component);
  if (at == kComponents.end()) return 0;
  return bit(static_cast<std::size_t>(at - kComponents.begin()), format.normalized);
}

std::uint32_t component_bit(std::string_view name) {
  const bool normalized = name.ends_with("_NORM");
  if (normalized) name.remove_suffix(5);
  const auto at = std::find(kNames.begin(), kNames.end(), name);
  if (at == kNames.end()) return 0;
  return bit(static_cast<std::size_t>(at - kNames.begin()), normalized);
}

std::uint16_t type_bit(ElementType type) {
  return static_cast<std::uint16_t>(1U << static_cast<unsigned>(type));
}

FormatSet from_names(std::initializer_list<ElementType> types,
                     std::initializer_list<std::string_view> components) {
  FormatSet set;
  for (const ElementType type : types) set.types = set.types | type_bit(type);
  for (const std::string_view name : components) set.components |= component_bit(name);
  return set;
}

FormatSet from_schema(const schema::AttributeFormat& format) {
  FormatSet set;
  for (const std::string& name : format.types) {
    set.types =
        set.types | type_bit(model::element_type_from_name(name).value_or(ElementType::none));
  }
  for (const std::string& name : format.components) set.components |= component_bit(name);
  return set;
}

// In the order of SemanticKind.
CoreFormats core_vertex_formats() {
  const FormatSet fractions2 =
      from_names({ElementType::vec2}, {"FLOAT", "UBYTE_NORM", "USHORT_NORM"});
  const FormatSet colors =
      from_names({ElementType::vec3, ElementType::vec4}, {"FLOAT", "UBYTE_NORM", "USHORT_NORM"});
  return {{{from_names({ElementType::vec3}, {"FLOAT"})},
           {from_names({ElementType::vec3}, {"FLOAT"})},
           {from_names({ElementType::vec4}, {"FLOAT"})},
           {fractions2},
           {colors},
           {from_names({ElementType::vec4}, {"UBYTE", "USHORT"})},
           {from_names({ElementType::vec4}, {"FLOAT", "UBYTE_NORM", "USHORT_NORM"})}}};
}

// Offsets may be negative, so signed fractions are allowed too. Skinning cannot be morphed.
CoreFormats core_morph_formats() {
  const std::initializer_list<std::string_view> signed_fractions{"FLOAT", "BYTE_NORM", "UBYTE_NORM",
                                                                 "SHORT_NORM", "USHORT_NORM"};
  return {{{from_names({ElementType::vec3}, {"FLOAT"})},
           {from_names({ElementType::vec3}, {"FLOAT"})},
           {from_names({ElementType::vec3}, {"FLOAT"})},
           {from_names({ElementType::vec2}, signed_fractions)},
           {from_names({ElementType::vec3, ElementType::vec4}, signed_fractions)},
           {},
           {}}};
}

// The core semantic that a name of a schema file stands for.
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

bool FormatSet::allows(const model::Format& format) const {
  return (types & type_bit(format.type)) != 0 && (components & component_bit(format)) != 0;
}

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
      if ((set.types & type_bit(type)) != 0) types.emplace_back(model::element_type_name(type));
    }
    for (std::size_t i = 0; i < kComponents.size(); ++i) {
      const std::string_view name = model::component_type_name(kComponents[i]);
      if ((set.components & bit(i, false)) != 0) components.emplace_back(name);
      if ((set.components & bit(i, true)) != 0)
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
    (*extended)[static_cast<std::size_t>(kind)].push_back(from_schema(format));
  } else {
    others.emplace_back(format.semantic, FormatList{from_schema(format)});
  }
}

void AttributeFormats::Table::sort() {
  std::stable_sort(others.begin(), others.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
}

AttributeFormats::AttributeFormats(const Context& context) {
  static const CoreFormats vertex_formats = core_vertex_formats();
  static const CoreFormats morph_formats = core_morph_formats();
  vertex_.base = &vertex_formats;
  morph_.base = &morph_formats;
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
  // The Khronos validator takes the format from what stands before the first underscore.
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

namespace {

bool brings(const schema::Extension& extension, const model::Attribute& attribute, bool target,
            const model::Format& format) {
  const auto& all = target ? extension.morph_attributes : extension.vertex_attributes;
  return std::any_of(all.begin(), all.end(), [&](const schema::AttributeFormat& each) {
    return model::matches_semantic(each.semantic, attribute.name) &&
           from_schema(each).allows(format);
  });
}

}  // namespace

std::string_view extension_that_allows(const schema::Set& schemas,
                                       const model::Attribute& attribute, bool target,
                                       const model::Format& format) {
  for (const schema::Extension& extension : schemas.extensions()) {
    if (brings(extension, attribute, target, format)) return extension.name;
  }
  return {};
}

bool uses_formats_of(const Context& context, const schema::Extension& extension) {
  const auto any = [&](const std::vector<model::Attribute>& attributes, bool target) {
    return std::any_of(attributes.begin(), attributes.end(), [&](const model::Attribute& each) {
      return each.accessor &&
             brings(extension, each, target, context.views.accessors[*each.accessor].format);
    });
  };
  for (const model::Mesh& mesh : context.views.meshes) {
    for (const model::Primitive& primitive : mesh.primitives) {
      if (any(primitive.attributes, false)) return true;
      for (const json::NodeId morph : primitive.targets) {
        if (any(model::read_attributes(context.asset, morph), true)) return true;
      }
    }
  }
  return false;
}

}  // namespace gltfx::validate

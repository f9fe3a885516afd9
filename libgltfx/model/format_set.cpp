// SPDX-License-Identifier: Apache-2.0
#include "model/format_set.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace gltfx::model {
namespace {

std::uint16_t type_bit(ElementType type) {
  return static_cast<std::uint16_t>(1U << static_cast<unsigned>(type));
}

template <class Matches>
std::uint32_t component_bit(bool normalized, const Matches& matches) {
  const auto* const end = std::end(kComponentNames);
  const auto* const at = std::find_if(std::begin(kComponentNames), end, matches);
  if (at == end) return 0;
  return 1U << ((at - std::begin(kComponentNames)) * 2 + (normalized ? 1 : 0));
}

std::uint32_t component_bit(std::string_view name) {
  const bool normalized = name.ends_with("_NORM");
  if (normalized) name.remove_suffix(5);
  return component_bit(normalized, [&](const ComponentName& each) { return each.name == name; });
}

}  // namespace

FormatSet FormatSet::of(std::initializer_list<ElementType> types,
                        std::initializer_list<std::string_view> components) {
  FormatSet set;
  for (const ElementType type : types) set.types = set.types | type_bit(type);
  for (const std::string_view name : components) set.components |= component_bit(name);
  return set;
}

FormatSet FormatSet::of(const schema::AttributeFormat& format) {
  FormatSet set;
  for (const std::string& name : format.types) {
    set.types = set.types | type_bit(element_type_from_name(name).value_or(ElementType::none));
  }
  for (const std::string& name : format.components) set.components |= component_bit(name);
  return set;
}

bool FormatSet::has_type(ElementType type) const { return (types & type_bit(type)) != 0; }

bool FormatSet::has_component(ComponentType type, bool normalized) const {
  return (components & component_bit(normalized, [&](const ComponentName& each) {
            return each.type == type;
          })) != 0;
}

bool adds_format(const schema::Extension& extension, const Attribute& attribute, bool target,
                 const Format& format) {
  const auto& all = target ? extension.morph_attributes : extension.vertex_attributes;
  return std::any_of(all.begin(), all.end(), [&](const schema::AttributeFormat& each) {
    return matches_semantic(each.semantic, attribute.name) && FormatSet::of(each).allows(format);
  });
}

std::uint64_t count_with_added_format(const Asset& asset, const Views& views,
                                      const schema::Extension& extension) {
  std::vector<bool> counted(views.accessors.size());
  const auto count = [&](const std::vector<Attribute>& attributes, bool target) {
    for (const Attribute& each : attributes) {
      if (!each.accessor || counted[*each.accessor]) continue;
      const Format& format = views.accessors[*each.accessor].format;
      counted[*each.accessor] = adds_format(extension, each, target, format);
    }
  };
  for (const Mesh& mesh : views.meshes) {
    for (const Primitive& primitive : mesh.primitives) {
      count(primitive.attributes, false);
      for (const json::NodeId morph : primitive.targets) count(read_attributes(asset, morph), true);
    }
  }
  return static_cast<std::uint64_t>(std::count(counted.begin(), counted.end(), true));
}

}  // namespace gltfx::model

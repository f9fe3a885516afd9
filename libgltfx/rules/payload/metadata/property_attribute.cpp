// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/payload/metadata/value_scan.hpp"

namespace gltfx::validate {
namespace {

using model::ComponentType;
using model::ElementType;
using model::MetadataComponent;
using model::MetadataProperty;
using model::MetadataType;

// The component types supported by accessors of vertex attributes; none for the others.
ComponentType component_type(MetadataComponent component) {
  switch (component) {
    case MetadataComponent::int8:
      return ComponentType::int8;
    case MetadataComponent::uint8:
      return ComponentType::uint8;
    case MetadataComponent::int16:
      return ComponentType::int16;
    case MetadataComponent::uint16:
      return ComponentType::uint16;
    case MetadataComponent::float32:
      return ComponentType::float32;
    default:
      return ComponentType::none;
  }
}

// The reason why a property cannot be a vertex attribute, as the end of a sentence; empty: it can.
std::string attribute_refusal(const MetadataProperty& property) {
  if (property.array) return "it is an array";
  if (property.type == MetadataType::string || property.type == MetadataType::boolean) {
    return fmt::format("its type is {}", metadata_type_name(property.type));
  }
  if (component_type(property.component) != ComponentType::none) return {};
  return fmt::format("its components are {}", metadata_component_name(property.component));
}

model::Format format_of(const MetadataProperty& property) {
  model::Format format;
  const bool listed = property.type == MetadataType::enumeration;
  format.type = listed ? ElementType::scalar
                       : model::element_type_from_name(metadata_type_name(property.type))
                             .value_or(ElementType::none);
  format.component = component_type(property.component);
  format.normalized = property.normalized;
  return format;
}

// A property of a property attribute, and the values of its vertices so far.
struct VertexColumn {
  const MetadataProperty* property = nullptr;
  json::NodeId node = json::kNoNode;
  std::string attribute;
  ValueLimits limits;
  std::unique_ptr<ValueScan> scan;    // null: nothing to check
  std::set<std::uint32_t> accessors;  // accessors that were read
};

class PropertyAttributeCheck {
 public:
  explicit PropertyAttributeCheck(MetadataPhase& phase) : phase_(phase) {}

  void run() {
    columns_.resize(object_list(phase_.document(), phase_.root, "propertyAttributes").size());
    for_each_listed(
        phase_, "propertyAttributes",
        [&](std::size_t index, json::NodeId, const PropertyUse& use) { add(index, use); });
    for_each_primitive_extension(
        phase_.context(), kMetadataExtension, [&](const ExtensionPlace& place, const Path& path) {
          const auto attributes = attributes_of(place.host);
          for_each_index(phase_, place.object, path, "propertyAttributes", columns_.size(),
                         [&](std::size_t index, json::NodeId list, const Path& at) {
                           check_primitive(columns_[index], attributes, list, at);
                         });
        });
    for (std::size_t i = 0; i < columns_.size(); ++i) report(i);
  }

 private:
  using Attributes = std::map<std::string_view, std::optional<std::uint32_t>>;

  void add(std::size_t index, const PropertyUse& use) {
    if (!use.property.is_sound()) return;
    const std::string why = attribute_refusal(use.property);
    if (!why.empty()) return report_unstorable(phase_, use, "a vertex attribute", why);
    VertexColumn column;
    column.property = &use.property;
    column.node = use.value;
    column.attribute = model::string_member(phase_.document(), use.value, "attribute");
    column.limits = value_limits(phase_, use);
    column.scan = make_value_scan(use.property, column.limits, use.property.width());
    if (!column.attribute.empty()) columns_[index].push_back(std::move(column));
  }

  Attributes attributes_of(json::NodeId primitive) const {
    const json::NodeId node = model::object_member(phase_.document(), primitive, "attributes");
    Attributes found;
    if (node == json::kNoNode) return found;
    for (const auto& each : model::read_attributes(phase_.context().asset, node)) {
      found[each.name] = each.accessor;
    }
    return found;
  }

  void check_primitive(std::vector<VertexColumn>& columns, const Attributes& attributes,
                       json::NodeId list, const Path& path) {
    if (!phase_.data.budget.take(columns.size(), kCostOfName)) return;
    for (VertexColumn& column : columns) {
      const auto found = attributes.find(column.attribute);
      if (found == attributes.end()) {
        phase_.sink().report(path,
                             finding_on(phase_.context(), list, Code::PROPERTY_ATTRIBUTE_MISSING,
                                        fmt::format("The primitive has no attribute {}.",
                                                    gltfx::quoted(column.attribute))));
        return;
      }
      if (found->second) check_accessor(column, *found->second, list, path);
    }
  }

  void check_accessor(VertexColumn& column, std::uint32_t accessor, json::NodeId list,
                      const Path& path) {
    if (!column.accessors.insert(accessor).second) return;
    const model::Format& format = phase_.context().views.accessors[accessor].format;
    const model::Format wanted = format_of(*column.property);
    if (!format.known()) return;
    if (!(format == wanted)) {
      phase_.sink().report(
          path, finding_on(phase_.context(), list, Code::PROPERTY_ATTRIBUTE_INVALID_FORMAT,
                           fmt::format("The attribute {} is {}; property {} must be {}.",
                                       gltfx::quoted(column.attribute), format_text(format),
                                       gltfx::quoted(column.property->id), format_text(wanted))));
      return;
    }
    if (column.scan == nullptr) return;
    const auto data = phase_.data.open(accessor);
    if (!data || !phase_.data.budget.take(data->count(), data->components())) return;
    model::with_component_type(format.component, [&](auto zero) {
      using T = decltype(zero);
      data->visit<T>([&](const T* values, std::size_t elements, std::uint64_t) {
        const std::span<const T> some(values, elements * data->components());
        column.scan->add(std::as_bytes(some), elements);
      });
    });
  }

  void report(std::size_t index) {
    for (const VertexColumn& column : columns_[index]) {
      if (column.scan == nullptr || column.accessors.empty()) continue;
      auto findings =
          describe_values(*column.property, column.limits, column.scan->finish(), "vertex");
      if (findings.empty()) continue;
      with_metadata_path([&](const Path& path) {
        const Path list(path, "propertyAttributes");
        const Path attribute(list, index);
        const Path properties(attribute, "properties");
        report_stored(phase_, Path(properties, column.property->id), column.node,
                      std::move(findings));
      });
    }
  }

  MetadataPhase& phase_;
  std::vector<std::vector<VertexColumn>> columns_;  // by property attribute
};

}  // namespace

void check_property_attributes(MetadataPhase& phase) { PropertyAttributeCheck(phase).run(); }

}  // namespace gltfx::validate

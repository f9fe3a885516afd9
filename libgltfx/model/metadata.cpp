// SPDX-License-Identifier: Apache-2.0
#include "model/metadata.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <string>

#include "base/checked.hpp"
#include "model/fields.hpp"

namespace gltfx::model {
namespace {

constexpr std::array<std::string_view, 11> kMetadataTypes{
    "", "SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4", "STRING", "BOOLEAN", "ENUM"};
constexpr std::array<std::string_view, 11> kMetadataComponents{
    "",       "INT8",  "UINT8",  "INT16",   "UINT16", "INT32",
    "UINT32", "INT64", "UINT64", "FLOAT32", "FLOAT64"};

template <std::size_t N>
std::size_t position_of(const std::array<std::string_view, N>& names, std::string_view name) {
  const auto found = std::find(names.begin() + 1, names.end(), name);
  return found == names.end() ? 0 : static_cast<std::size_t>(found - names.begin());
}

template <typename T>
std::optional<std::uint64_t> bits_of(std::string_view text) {
  T value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
}

// The members of an object with their names.
template <typename Use>
void for_each_member(const json::Document& document, json::NodeId object, Use use) {
  if (object == json::kNoNode) return;
  for (const auto member : document.members(object)) {
    use(document.key(member.key_id), member.value);
  }
}

}  // namespace

std::string_view metadata_type_name(MetadataType type) {
  return kMetadataTypes[static_cast<std::size_t>(type)];
}

unsigned metadata_components(MetadataType type) {
  constexpr unsigned kCounts[] = {0, 1, 2, 3, 4, 4, 9, 16, 0, 0, 0};
  return kCounts[static_cast<std::size_t>(type)];
}

std::string_view metadata_component_name(MetadataComponent component) {
  return kMetadataComponents[static_cast<std::size_t>(component)];
}

MetadataComponent metadata_component_from_name(std::string_view name) {
  return static_cast<MetadataComponent>(position_of(kMetadataComponents, name));
}

unsigned metadata_component_size(MetadataComponent component) {
  constexpr unsigned kSizes[] = {0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(component)];
}

bool is_integer(MetadataComponent component) {
  return component != MetadataComponent::none && component < MetadataComponent::float32;
}

MetadataRange metadata_range(MetadataComponent component) {
  constexpr double kFloat = std::numeric_limits<float>::max();
  constexpr double kDouble = std::numeric_limits<double>::max();
  constexpr MetadataRange kRanges[] = {{-kDouble, kDouble},
                                       {-128, 127},
                                       {0, 255},
                                       {-32768, 32767},
                                       {0, 65535},
                                       {-2147483648.0, 2147483647.0},
                                       {0, 4294967295.0},
                                       {-9223372036854775808.0, 9223372036854775807.0},
                                       {0, 18446744073709551615.0},
                                       {-kFloat, kFloat},
                                       {-kDouble, kDouble}};
  return kRanges[static_cast<std::size_t>(component)];
}

std::optional<std::uint64_t> integer_bits(std::string_view text, MetadataComponent component) {
  switch (component) {
    case MetadataComponent::int8:
      return bits_of<std::int8_t>(text);
    case MetadataComponent::uint8:
      return bits_of<std::uint8_t>(text);
    case MetadataComponent::int16:
      return bits_of<std::int16_t>(text);
    case MetadataComponent::uint16:
      return bits_of<std::uint16_t>(text);
    case MetadataComponent::int32:
      return bits_of<std::int32_t>(text);
    case MetadataComponent::uint32:
      return bits_of<std::uint32_t>(text);
    case MetadataComponent::int64:
      return bits_of<std::int64_t>(text);
    case MetadataComponent::uint64:
      return bits_of<std::uint64_t>(text);
    default:
      return std::nullopt;
  }
}

bool MetadataEnum::has_value(std::uint64_t bits) const {
  return std::binary_search(values.begin(), values.end(), bits);
}

bool MetadataProperty::is_sound() const {
  if (type == MetadataType::none) return false;
  const bool stored = is_numeric() || type == MetadataType::enumeration;
  return !stored || component != MetadataComponent::none;
}

std::uint64_t MetadataProperty::width() const {
  const std::uint64_t elements = array ? count : 1;
  return checked_mul(elements, std::max(metadata_components(type), 1U)).value_or(UINT64_MAX);
}

const MetadataProperty* MetadataClass::find(std::string_view name) const {
  const json::KeyId key = ids_.find(name);
  return key == json::kNoKey ? nullptr : &properties[positions_[key]];
}

MetadataSchema::MetadataSchema(const json::Document& document, json::NodeId schema)
    : document_(&document), node_(schema) {
  if (schema == json::kNoNode) return;
  read_enums();
  read_classes();
}

const MetadataClass* MetadataSchema::find_class(std::string_view id) const {
  const json::KeyId key = class_ids_.find(id);
  return key == json::kNoKey ? nullptr : &classes_[key];
}

const MetadataEnum* MetadataSchema::find_enum(std::string_view id) const {
  const json::KeyId key = enum_ids_.find(id);
  return key == json::kNoKey ? nullptr : &enums_[key];
}

void MetadataSchema::read_enums() {
  const json::Document& document = *document_;
  for_each_member(document, object_member(document, node_, "enums"),
                  [&](std::string_view id, json::NodeId node) {
                    const json::KeyId key = enum_ids_.intern(id);
                    if (key == enums_.size()) enums_.emplace_back();
                    MetadataEnum& each = enums_[key];  // the last of repeated ids counts
                    each = {};
                    each.id = id;
                    each.node = node;
                    const json::NodeId type = document.find(node, "valueType");
                    if (type != json::kNoNode) {
                      each.component = document.is_string(type)
                                           ? metadata_component_from_name(document.string(type))
                                           : MetadataComponent::none;
                      if (!is_integer(each.component)) each.component = MetadataComponent::none;
                    }
                    const json::NodeId values = document.find(node, "values");
                    each.sound =
                        values != json::kNoNode && document.kind(values) == json::Kind::array;
                    if (!each.sound) return;
                    for (const json::NodeId value : document.elements(values)) {
                      const json::NodeId name = document.find(value, "name");
                      const json::NodeId number = document.find(value, "value");
                      if (name != json::kNoNode && document.is_string(name))
                        document.insert_string(name, each.names);
                      const auto bits = number == json::kNoNode
                                            ? std::nullopt
                                            : integer_bits(document.raw(number), each.component);
                      each.sound &= bits.has_value();
                      if (bits) each.values.push_back(*bits);
                    }
                    std::sort(each.values.begin(), each.values.end());
                  });
}

void MetadataSchema::read_classes() {
  const json::Document& document = *document_;
  for_each_member(document, object_member(document, node_, "classes"),
                  [&](std::string_view id, json::NodeId node) {
                    const json::KeyId key = class_ids_.intern(id);
                    if (key == classes_.size()) classes_.emplace_back();
                    MetadataClass& each = classes_[key];
                    each = {};
                    each.id = id;
                    each.node = node;
                    each.derived = document.find(node, "parent") != json::kNoNode;
                    for_each_member(document, object_member(document, node, "properties"),
                                    [&](std::string_view name, json::NodeId property) {
                                      const json::KeyId at = each.ids_.intern(name);
                                      if (at == each.positions_.size())
                                        each.positions_.push_back(0);
                                      each.positions_[at] = each.properties.size();
                                      each.properties.push_back(read_property(property));
                                      each.properties.back().id = name;
                                    });
                  });
}

MetadataProperty MetadataSchema::read_property(json::NodeId node) const {
  const json::Document& document = *document_;
  MetadataProperty property;
  property.node = node;
  property.type =
      static_cast<MetadataType>(position_of(kMetadataTypes, string_member(document, node, "type")));
  property.array = true_member(document, node, "array");
  property.count = unsigned_member(document, node, "count").value_or(0);
  property.normalized = true_member(document, node, "normalized");
  property.required = true_member(document, node, "required");
  if (property.is_numeric()) {
    property.component =
        metadata_component_from_name(string_member(document, node, "componentType"));
  } else if (property.type == MetadataType::enumeration) {
    property.enumeration = find_enum(string_member(document, node, "enumType"));
    if (property.enumeration != nullptr) property.component = property.enumeration->component;
  }
  property.normalized = property.normalized && is_integer(property.component);
  // Without the length of arrays, the positions of values are unknown.
  const bool miscounted = document.find(node, "count") != json::kNoNode && property.count < 2;
  if (miscounted) property.type = MetadataType::none;
  return property;
}

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
/// Schemas of structural metadata as types instead of JSON: classes, their properties, enums (3D
/// Metadata Specification; EXT_structural_metadata).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "json/document.hpp"
#include "json/keys.hpp"

namespace gltfx::model {

enum class MetadataType : std::uint8_t {
  none,
  scalar,
  vec2,
  vec3,
  vec4,
  mat2,
  mat3,
  mat4,
  string,
  boolean,
  enumeration,
};
/// "VEC3"; empty for none.
std::string_view metadata_type_name(MetadataType type);
/// Number of components: 9 for MAT3, 0 for types without components.
unsigned metadata_components(MetadataType type);

enum class MetadataComponent : std::uint8_t {
  none,
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
};
/// "UINT16"; empty for none.
std::string_view metadata_component_name(MetadataComponent component);
/// The component with that name, or none.
MetadataComponent metadata_component_from_name(std::string_view name);
/// Bytes, 0 for none.
unsigned metadata_component_size(MetadataComponent component);
bool is_integer(MetadataComponent component);
/// Smallest and greatest value; the nearest doubles for 64 bits.
struct MetadataRange {
  double least, most;
};
MetadataRange metadata_range(MetadataComponent component);

/// The integer in a text as the bits that the component stores, sign-extended to 64; nothing when
/// it is not an integer in the component's range.
std::optional<std::uint64_t> integer_bits(std::string_view text, MetadataComponent component);

struct MetadataEnum {
  std::string_view id;
  json::NodeId node = json::kNoNode;
  MetadataComponent component = MetadataComponent::uint16;  ///< none: unknown
  json::KeyTable names;
  std::vector<std::uint64_t> values;  ///< integer_bits() of all values, sorted
  bool sound = true;                  ///< every value was read

  bool has_value(std::uint64_t bits) const;
};

struct MetadataProperty {
  std::string_view id;
  json::NodeId node = json::kNoNode;
  MetadataType type = MetadataType::none;
  MetadataComponent component = MetadataComponent::none;  ///< for an ENUM, that of its values
  const MetadataEnum* enumeration = nullptr;              ///< for an ENUM, if it exists
  bool array = false;
  std::uint64_t count = 0;  ///< elements of an array, at least 2; 0: they vary
  bool normalized = false;
  bool required = false;

  bool is_numeric() const { return metadata_components(type) != 0; }
  bool is_variable() const { return array && count == 0; }
  /// Whether type and component type are known, so that values can be read.
  bool is_sound() const;
  /// Numbers, bits or strings of a value that does not vary in length; saturates.
  std::uint64_t width() const;
};

struct MetadataClass {
  std::string_view id;
  json::NodeId node = json::kNoNode;
  std::vector<MetadataProperty> properties;  ///< in the order of the text
  bool derived = false;                      ///< has a parent: there are further properties

  /// The property with that id, or null.
  const MetadataProperty* find(std::string_view id) const;

 private:
  friend class MetadataSchema;
  json::KeyTable ids_;
  std::vector<std::size_t> positions_;  // in properties, by KeyId
};

/// The schema of a document; malformed parts count as absent. The document must outlive it. Linear
/// in the document.
class MetadataSchema {
 public:
  MetadataSchema() = default;
  /// `schema` is an object or json::kNoNode.
  MetadataSchema(const json::Document& document, json::NodeId schema);
  MetadataSchema(MetadataSchema&&) = default;  // properties point to enums, which do not move
  MetadataSchema& operator=(MetadataSchema&&) = default;
  MetadataSchema(const MetadataSchema&) = delete;
  MetadataSchema& operator=(const MetadataSchema&) = delete;

  const json::Document& document() const { return *document_; }
  json::NodeId node() const { return node_; }
  bool exists() const { return node_ != json::kNoNode; }
  const std::vector<MetadataClass>& classes() const { return classes_; }
  const std::vector<MetadataEnum>& enums() const { return enums_; }
  /// The class with that id, or null.
  const MetadataClass* find_class(std::string_view id) const;
  const MetadataEnum* find_enum(std::string_view id) const;

 private:
  void read_enums();
  void read_classes();
  MetadataProperty read_property(json::NodeId node) const;

  const json::Document* document_ = nullptr;
  json::NodeId node_ = json::kNoNode;
  std::vector<MetadataEnum> enums_;
  std::vector<MetadataClass> classes_;
  json::KeyTable enum_ids_, class_ids_;
};

}  // namespace gltfx::model

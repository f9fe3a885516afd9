// SPDX-License-Identifier: Apache-2.0
/// The glTF 2.0 Asset Object Model: which properties of an asset can be changed at run time, named
/// by JSON pointers. The schema files define which are mutable, and their types.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "model/asset.hpp"
#include "model/fields.hpp"
#include "schema/set.hpp"

namespace gltfx::model {

/// Data types of the object model (its section 2).
enum class PropertyType : std::uint8_t {
  none,
  boolean,
  integer,
  number,
  number_array,  ///< float[]: as many numbers as the asset has, each a separate target
  float2,
  float3,
  float4,
  float2x2,
  float3x3,
  float4x4,
};
/// "float3"; empty for none.
std::string_view property_type_name(PropertyType type);
PropertyType property_type_from_name(std::string_view name);

/// The target of a pointer.
struct PropertyTarget {
  enum class Status : std::uint8_t {
    mutable_property,  ///< a property that may be changed, of type `type`
    outside,           ///< exists, but in extras or in an unknown extension
    malformed,         ///< not a JSON pointer (RFC 6901)
    unresolved,        ///< nothing has that name
    immutable,         ///< exists, but may not be changed
  };
  Status status = Status::unresolved;
  PropertyType type = PropertyType::none;
  /// The canonical pointer to the property. For an element of a float[], that of the array.
  std::string property;
  std::optional<std::uint64_t> element;  ///< of a float[]: a pointer to this element alone
  /// The value in the text; json::kNoNode for a default, and for elements.
  json::NodeId value = json::kNoNode;
  std::uint64_t length = 1;  ///< for a float[]: number of elements
  /// The shape of its numbers, with their limits; schema::kNone for other values.
  schema::ShapeId numbers = schema::kNone;
  double animated_minimum =
      -std::numeric_limits<double>::infinity();  ///< minimum of animated values
  /// Why the pointer was not resolved, as a clause: "/materials/0 has no property
  /// 'roughnessFactor'". Empty when found.
  std::string reason;
  std::string nearest;  ///< the pointer with its wrong step fixed, or empty
};

/// Resolves pointers against one asset. Caches look-ups in large arrays and objects, so that many
/// pointers take time linear in their number and in the document. The asset and the Set must
/// outlive it. Not thread-safe.
class ObjectModel {
 public:
  ObjectModel(const Asset& asset, const schema::Set& schemas);

  /// Never fails: the result has the error of a pointer.
  PropertyTarget resolve(std::string_view pointer);

 private:
  struct Walk;
  /// The last member of a type that was not found, and the suggestion for it. Many pointers have
  /// the same error.
  struct Guess {
    const schema::ObjectType* type = nullptr;
    std::string word;
    std::string_view nearest;
  };

  bool step(Walk& walk);
  bool into_object(Walk& walk);
  bool into_member(Walk& walk, const schema::Property& property);
  bool into_array(Walk& walk);
  bool into_extension(Walk& walk);
  bool into_unknown(Walk& walk);
  bool missing_member(Walk& walk, const schema::ObjectType& type);
  void arrive(Walk& walk);
  void arrive_at_node(Walk& walk);

  schema::TypeId type_of(schema::ShapeId shape) const;
  schema::ShapeId items_of(schema::ShapeId shape) const;
  std::uint64_t morph_target_count(json::NodeId node);

  const Asset& asset_;
  const schema::Set& schemas_;
  schema::ShapeId root_shape_ = schema::kNone;
  ArrayLookup arrays_;
  std::unordered_map<json::NodeId, std::uint64_t> morph_targets_;  ///< by mesh
  Guess guess_;
};

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
/// The glTF 2.0 Asset Object Model: which properties of an asset can be changed while it is shown,
/// named by JSON pointers. What is mutable, and of what type, is read from the schema files.
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
  number_array,  ///< float[]: as many numbers as the asset has, each a target of its own
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

/// Where a pointer leads.
struct PropertyTarget {
  enum class Status : std::uint8_t {
    mutable_property,  ///< a property that may be changed; `type` says to what
    outside,    ///< there, but in extras or in an extension nothing is known of: anybody's business
    malformed,  ///< no JSON pointer (RFC 6901)
    unresolved,  ///< there is nothing of that name
    immutable,   ///< there, but no property that may be changed
  };
  Status status = Status::unresolved;
  PropertyType type = PropertyType::none;
  /// The pointer to the property, canonical. For an element of a float[] that of the array.
  std::string property;
  std::optional<std::uint64_t> element;  ///< of a float[]: a pointer to this element alone
  /// The value in the text; json::kNoNode when the default is meant, and for elements.
  json::NodeId value = json::kNoNode;
  std::uint64_t length = 1;  ///< of a float[]: its elements
  /// The shape of its numbers, with their limits; schema::kNone for other values.
  schema::ShapeId numbers = schema::kNone;
  double animated_minimum = -std::numeric_limits<double>::infinity();  ///< of what is written
  /// Why not, as a clause: "/materials/0 has no property 'roughnessFactor'". Empty when found.
  std::string reason;
  std::string nearest;  ///< the pointer with its wrong step fixed, or empty
};

/// Resolves pointers against one asset. Keeps what it learned of large arrays and objects, so that
/// many pointers cost time linear in them and in the document. The asset and the Set must outlive
/// it. Not thread-safe.
class ObjectModel {
 public:
  ObjectModel(const Asset& asset, const schema::Set& schemas);

  /// Never fails: the answer says what is wrong with a pointer.
  PropertyTarget resolve(std::string_view pointer);

 private:
  struct Walk;
  /// The member of a type that was looked for in vain last, and what may be meant. Many pointers
  /// miss the same one.
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

// SPDX-License-Identifier: Apache-2.0
/// A JSON Schema (2020-12) of a user, compiled, and whether a value fits it. The files of `schema/`
/// have more words and are compiled together: see schema/compile.hpp.
///
/// A schema is data: it cannot run or read anything. Patterns match in linear time, and a check
/// stops after a number of steps that the caller gives.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/span.hpp"
#include "json/document.hpp"
#include "schema/pattern.hpp"

namespace gltfx::schema {

/// One keyword of a schema object. Which members have a meaning depends on `kind`.
struct Assertion {
  enum class Kind : std::uint8_t {
    type,
    equals,  ///< `enum` and `const`
    minimum,
    exclusive_minimum,
    maximum,
    exclusive_maximum,
    multiple_of,
    min_length,
    max_length,
    pattern,
    min_items,
    max_items,
    unique_items,
    prefix_items,
    items,
    contains,
    min_properties,
    max_properties,
    required,
    properties,
    pattern_properties,
    additional_properties,
    property_names,
    dependent_required,
    dependent_schemas,
    reference,
    all_of,
    any_of,
    one_of,
    not_,
    condition,
  };
  static constexpr std::uint64_t kNoLimit = UINT64_MAX;

  Kind kind = Kind::type;
  std::uint8_t types = 0;                       ///< TypeBits
  double number = 0;                            ///< limit of numbers
  std::uint64_t least = 0, most = kNoLimit;     ///< limits of counts; contains: of matches
  std::vector<json::NodeId> literals;           ///< of the schema's document
  std::vector<std::uint32_t> schemas;           ///< condition: if, then, else
  std::vector<std::string> names;               ///< with `schemas` or `lists` in the same order
  std::vector<std::vector<std::string>> lists;  ///< dependent_required
  std::vector<Pattern> patterns;
};

/// A schema object, or true or false.
struct Subschema {
  bool never = false;  ///< false: nothing fits
  std::vector<Assertion> assertions;
};

inline constexpr std::uint32_t kNoSchema = UINT32_MAX;

/// The value that is checked: an object with one more member, which other checks than those of its
/// name do not see: `properties`, `required` and the like do, `additionalProperties` does not.
struct CheckedObject {
  const json::Document& document;
  json::NodeId object;
  std::string_view more_name = {};
  /// The value of the member, made when a schema asks for it.
  std::function<const json::Document&()> more = nullptr;
};

/// The first keyword that does not hold.
struct SchemaFailure {
  std::string pointer;  ///< from the checked object
  std::string reason;   ///< "'Cube' does not match '^SM_'"
  /// The value; of a number in an array the array. kNoNode: it is in the one more member.
  json::NodeId node = json::kNoNode;
};

enum class SchemaVerdict : std::uint8_t { fits, fails, undecided };

/// Immutable, so any number of threads may check with it.
class JsonSchema {
 public:
  static constexpr std::uint32_t kDeepestText = 64;

  /// A mistake in the text of a schema.
  struct Mistake {
    Span span;
    std::string message;
  };
  /// Nothing when there are mistakes. Every keyword must be known, so that no requirement passes
  /// unseen.
  static std::optional<JsonSchema> compile(std::string_view text, std::vector<Mistake>& mistakes);

  /// `work`: steps that are left, reduced by those that were made. Undecided when they do not
  /// suffice, or values are nested too deeply. `failure` is set when the object does not fit.
  SchemaVerdict check(const CheckedObject& object, std::uint64_t& work,
                      SchemaFailure& failure) const;

  const std::vector<Subschema>& subschemas() const { return subschemas_; }
  const json::Document& document() const { return document_; }

 private:
  friend class JsonSchemaCompiler;
  json::Document document_;
  std::vector<Subschema> subschemas_;  ///< the first is the whole schema
};

}  // namespace gltfx::schema

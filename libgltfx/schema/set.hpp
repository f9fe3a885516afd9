// SPDX-License-Identifier: Apache-2.0
/// The compiled schema files: object types, their properties, extensions.
///
/// A Set is built once (`schema/compile.hpp`) and then only read, by any number of threads. The
/// library gets properties, ranges and hosts of extensions from the Set only.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/hash.hpp"
#include "schema/lazy.hpp"
#include "schema/text_index.hpp"
#include "schema/version.hpp"

namespace gltfx::schema {

using ShapeId = std::uint32_t;
using TypeId = std::uint32_t;       ///< index into Set::types()
using ExtensionId = std::uint32_t;  ///< index into Set::extensions()
inline constexpr std::uint32_t kNone = UINT32_MAX;

/// Bits of the JSON types a shape accepts; 0 accepts all.
enum TypeBit : std::uint8_t {
  kNull = 1,
  kBoolean = 2,
  kInteger = 4,
  kNumber = 8,
  kString = 16,
  kArray = 32,
  kObject = 64,
};

enum class Status : std::uint8_t {
  ratified,
  release_candidate,
  draft,
  legacy,
  archived,
  registered_vendor,  ///< a vendor's, in the Khronos registry
  vendor
};
std::string_view status_name(Status status);  ///< as in the files: "release-candidate"

/// Which channels of an image a texture slot reads, and how RGB is coded (alpha is always linear).
struct Slot {
  std::string channels;  ///< subset of "rgba", in that order
  bool srgb = false;
  std::string scaled_by;  ///< property of the same object that multiplies the texel; may be empty
  /// Channels with a separate property that multiplies them: {"g", "roughnessFactor"}.
  std::vector<std::pair<std::string, std::string>> factors;
};

/// The target of an index or a name.
struct Target {
  enum class Base : std::uint8_t { root_array, root_path, enclosing };
  Base base = Base::root_array;
  TypeId enclosing = kNone;        ///< Base::enclosing: nearest enclosing object of this type
  std::vector<std::string> steps;  ///< members from there; "*" steps over all elements
  std::string text;                ///< as written in the schema file
};

/// A scalar of an `enum` or `const`.
struct Literal {
  enum class Kind : std::uint8_t { null, boolean, number, string };
  Kind kind = Kind::null;
  double number = 0;
  std::string string;
  std::string name;  ///< enumNames: "UNSIGNED_BYTE"; may be empty
};

/// Advice on the values of a property.
struct Advice {
  ShapeId shape = kNone;  ///< that values should fit
  Version since;          ///< first version of glTF that gives the advice
  std::string because;    ///< a sentence
};

struct Property {
  std::string name;
  ShapeId shape = kNone;
  bool required = false;
  std::string parameter;     ///< of the shader: "base_color"; empty: the shader does not read it
  std::string mutable_type;  ///< object-model type for animation pointers; empty: not mutable
  /// Minimum of animated values, if stricter than that of values in the file.
  double animated_minimum = -std::numeric_limits<double>::infinity();
  std::vector<std::string> aliases;  ///< names of earlier drafts
  std::string default_json;          ///< JSON text of the default; empty: none
  std::string deprecated;            ///< what to use instead; empty: current
  /// The text that defines it ("glTF 2.1"), for assets of earlier versions too.
  std::string draft;
  Version since;                     ///< first version of glTF that has it; 0.0: all
  std::vector<std::string> without;  ///< members that an object with the property must not have
  std::optional<Advice> should;
  bool added_late = false;  ///< required, but missing in drafts that assets still follow
  std::string unit;
  std::string description;
};

/// If the shape `if` holds, another shape must hold.
struct Condition {
  ShapeId if_shape = kNone;
  ShapeId then_shape = kNone;
  ShapeId else_shape = kNone;
};

/// Whether the numbers of an array are a vector of unit length, and the severity of another length.
enum class UnitLength : std::uint8_t { free, warning, error };

/// One schema or subschema. Limits that are absent hold their neutral value.
struct Shape {
  std::string label;  ///< its place: "material.KHR_x", "KHR_x.light/color"
  std::uint8_t types = 0;
  bool never = false;  ///< the schema `false`
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  bool exclusive_minimum = false;
  bool exclusive_maximum = false;
  double multiple_of = 0;
  std::uint64_t min_length = 0, max_length = UINT64_MAX;
  std::uint64_t min_items = 0, max_items = UINT64_MAX;
  std::uint64_t min_properties = 0, max_properties = UINT64_MAX;
  bool unique_items = false;
  std::uint32_t pattern = kNone;  ///< index into Set::patterns()
  std::string format;
  std::vector<Literal> literals;  ///< enum, or the one of const; empty: any
  Version open_since;             ///< first version of glTF that allows other values; 0.0: none
  bool is_const = false;
  ShapeId items = kNone;
  TypeId type = kNone;     ///< the object type, when the shape describes members
  ShapeId values = kNone;  ///< shape of members not listed (additionalProperties)
  std::vector<std::pair<std::uint32_t, ShapeId>> pattern_properties;  ///< pattern, shape
  ShapeId property_names = kNone;
  std::vector<ShapeId> all_of, any_of, one_of;
  ShapeId not_shape = kNone;
  std::vector<Condition> conditions;
  std::vector<std::pair<std::string, std::vector<std::string>>> dependent_required;
  std::optional<Target> ref;
  std::vector<std::string> ref_has;  ///< path of members that the element of `ref` must have
  ShapeId ref_holds = kNone;         ///< that the element of `ref` must fit
  std::optional<Target> ref_name;
  UnitLength unit_length = UnitLength::free;
  std::uint32_t should_match = kNone;  ///< index into Set::patterns(): else a warning
  std::optional<Target> may_refer;     ///< of a list: the array that integers in it may index
  bool may_point = false;  ///< of a list: strings in it that begin with '/' are JSON pointers
  bool essential = false;  ///< without it, an object that no extension completes is useless
  std::string
      by_position;  ///< why no element of an array may be removed: the use of their positions
  std::optional<Slot> slot;
  std::string title, description, hint;
  std::string zero_hint;  ///< help for a 0 that is out of range
};

/// An object with known members.
struct ObjectType {
  std::string name;  ///< "material", "mesh.primitive", "KHR_lights_punctual.light"; of an
                     ///< extension's own object: "material.KHR_materials_ior"
  ShapeId shape = kNone;
  std::vector<Property> properties;  ///< in checking order
  bool open = false;                 ///< unknown members are allowed
  bool strict = false;  ///< unknown members break the schema (`additionalProperties: false`)
  ExtensionId extension = kNone;  ///< the extension it belongs to
  TypeId origin = kNone;          ///< the type this is a copy of (one definition at several
                                  ///< attachment points), otherwise its own id
};

/// A relation to another extension on the same object.
struct Relation {
  std::string extension;
  std::string because;
  bool error = false;  ///< `requires` only: breaks a MUST
};

enum class MustBeRequired : std::uint8_t { optional, recommended, without_fallback, always };

/// Formats an attribute semantic may have, e.g. {"VEC3"} with {"FLOAT", "BYTE_NORM"}.
struct AttributeFormat {
  std::string semantic;  ///< "POSITION", "TEXCOORD_n", "KHR_x:NAME"
  std::vector<std::string> types;
  std::vector<std::string> components;
  bool required = false;
};

/// One generation of a name whose meaning changed over time.
struct Generation {
  std::string name, description;
  std::vector<std::string> with, without;  ///< members that identify it
  std::vector<std::pair<std::string, Slot>> slots;
};

/// How one member is moved to the successor of an extension.
struct UpgradeStep {
  enum class Kind : std::uint8_t {
    move,   ///< within the extension's own object
    copy,   ///< from the object that carries the extension
    place,  ///< to the object that carries the extension
  };
  Kind kind = Kind::move;
  std::string from;       ///< member; of a copy a path of members, "pbrMetallicRoughness/x"
  std::string to;         ///< member of the successor's object; of a place a path from the host
  std::string otherwise;  ///< JSON text to write if there is no `from`; empty: none
  std::uint64_t take =
      0;                ///< number of elements to take from the start of a list; 0: the whole value
  std::string swizzle;  ///< "r>a": the texture needs an image whose A is the old R
  bool accept_index = false;             ///< a bare index means {"index": n}
  std::vector<std::string> generations;  ///< that have the step; empty: all
};

/// What an upgrade cannot carry over.
struct UpgradeLoss {
  /// Attribute that the old extension read and the new one does not; empty: lost in any case.
  std::string vertex_attribute;
  std::vector<std::string> generations;  ///< that lose it; empty: all
  std::string because;
};

/// Why objects of some generations cannot be upgraded.
struct UpgradeStay {
  std::vector<std::string> generations;  ///< empty: all
  std::string because;
};

/// The upgrade of an extension to its successor.
struct Upgrade {
  std::string to;                         ///< empty: none; core glTF replaces it
  std::vector<std::string> alternatives;  ///< other successors, which may be requested
  std::string opt_in;                ///< why it is done only on request by name; empty: always done
  bool together = false;             ///< all objects of a document, or none
  std::string conversion;            ///< code for what steps cannot express; empty: none
  std::vector<Relation> blocked_by;  ///< extensions that prevent the upgrade of an object
  std::vector<UpgradeStay> stays;
  std::vector<Relation> hidden_by;  ///< extensions that hide the effect
  std::vector<UpgradeStep> steps;
  std::vector<UpgradeLoss> losses;
  /// Whether there is a successor, or code that needs none.
  bool does_something() const { return !to.empty() || !conversion.empty(); }
};

struct Extension {
  std::string name, title, description, spec;
  std::string revision;  ///< of a draft: date, and commit where it is known: "2025-09-15 b102d2d"
  Status status = Status::vendor;
  std::vector<std::pair<TypeId, ShapeId>> attachment_points;  ///< host type, shape of its object
  std::vector<Relation> excludes, requires_, overridden_by;
  std::string strength;  ///< member that turns the effect off when it is 0; empty: none
  bool standalone = false;
  bool undrawn = false;            ///< it never changes a picture
  bool khronos_validator = false;  ///< the Khronos validator checks it
  MustBeRequired must_be_required = MustBeRequired::optional;
  std::string fallback;  ///< without_fallback: member of the host that is the fallback
  /// Extensions on the same object that are a fallback for readers without it.
  std::vector<std::string> fallback_extensions;
  bool optional_with_fallback = false;  ///< must not be required if every host has that member
  std::vector<std::string> image_mime_types;
  std::vector<AttributeFormat> vertex_attributes, morph_attributes, instance_attributes;
  std::string successor;
  std::vector<Generation> generations;
  Upgrade upgrade;
  /// Values it adds to an `enum` of core: "animation.channel.target/path", {"pointer"}.
  std::vector<std::pair<std::string, std::vector<std::string>>> enum_additions;
  bool from_user = false;  ///< given at run time

  /// The shape of its object on a type, or kNone when it does not belong there.
  ShapeId shape_on(TypeId type) const;
};

class Pattern;

// Read a part of a stored Set (schema/stored_set.hpp).
void read_part(std::string_view bytes, Texts texts, Shape& shape);
void read_part(std::string_view bytes, Texts texts, ObjectType& type);

/// A version of glTF, as its text stands.
struct VersionText {
  Version version;
  Status status = Status::ratified;
  std::string revision;                ///< of a draft: date and commit
  std::vector<std::string> explained;  ///< members that proposals name and the text does not
};

/// Immutable after compilation. Built-in shapes and types are read at first use, and their
/// addresses do not change.
class Set {
 public:
  Set() = default;
  const Lazy<Shape>& shapes() const { return *shapes_; }
  const Shape& shape(ShapeId id) const { return (*shapes_)[id]; }
  const Lazy<ObjectType>& types() const { return *types_; }
  const ObjectType& type(TypeId id) const { return (*types_)[id]; }
  const std::vector<Extension>& extensions() const { return extensions_; }
  /// The versions of glTF that it describes, oldest first. Empty without the root object of glTF.
  const std::vector<VersionText>& versions() const { return versions_; }
  Version newest_version() const {
    return versions_.empty() ? kVersion2 : versions_.back().version;
  }

  TypeId find_type(std::string_view name) const;            ///< or kNone
  ExtensionId find_extension(std::string_view name) const;  ///< or kNone
  /// The property with that name, or null. Aliases are ignored.
  const Property* find_property(TypeId type, std::string_view name) const;
  /// Whether a string matches a compiled pattern.
  bool matches(std::uint32_t pattern, std::string_view text) const;
  std::string_view pattern_text(std::uint32_t pattern) const;

  /// Hash of the texts it was compiled from; zeros for the built-in Set.
  const Hash128& sources() const { return sources_; }

  /// Tables made for the walk (`schema/check.hpp`): opaque to others.
  struct WalkTables;
  const WalkTables& walk_tables() const { return *walk_tables_; }

 private:
  friend class SetWriter;
  std::shared_ptr<const Lazy<Shape>> shapes_;
  std::shared_ptr<const Lazy<ObjectType>> types_;
  std::vector<Extension> extensions_;
  std::vector<VersionText> versions_;
  std::unordered_map<std::string, TypeId> type_ids_;
  std::unordered_map<std::string, ExtensionId> extension_ids_;
  std::shared_ptr<const std::vector<Pattern>> patterns_;
  std::shared_ptr<const WalkTables> walk_tables_;
  Hash128 sources_;
};

}  // namespace gltfx::schema

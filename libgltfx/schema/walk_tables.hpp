// SPDX-License-Identifier: Apache-2.0
/// A Set as tables for the walk: small and plain, without names and options.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "json/document.hpp"
#include "schema/set.hpp"

namespace gltfx::schema {

/// The name of a member of any type.
using Symbol = std::uint32_t;

/// The quick check of a shape, enough for most values. A value that fails it, or a shape that needs
/// more, gets the full check.
enum class Plan : std::uint8_t {
  any,      ///< everything is allowed
  number,   ///< a number within [low, high]
  integer,  ///< an integer within [low, high]
  index,    ///< an integer that indexes a target array
  boolean,
  text,    ///< any string
  choice,  ///< one of some strings or numbers
  object,
  array,
  full,  ///< no quick check
};

struct ShapePlan {
  Plan plan = Plan::any;
  bool combined = false;                 ///< has combinators or conditions
  bool members = false;                  ///< objects must be entered
  bool shallow = false;                  ///< does not check the parts of a container
  bool slot = false;                     ///< a texture slot
  bool every_value = false;              ///< a number without limits: nothing to check
  bool every_fraction = false;           ///< a number, and all of [0, 1] is allowed
  bool every_negative_fraction = false;  ///< all of [-1, 0] is
  bool of_extension = false;             ///< an index in the object of an extension
  std::uint32_t target = kNone;
  TypeId type = kNone;
  ShapeId items = kNone;
  ShapeId values = kNone;
  double low = 0, high = 0;
};

struct PropertyPlan {
  ShapeId shape = kNone;
  bool required = false;
  bool deprecated = false;
  bool draft = false;
  bool slot = false;
  bool advised = false;  ///< has advice on its value or excludes other members
  Version since;
};

/// `dependentRequired`: when the member `name` is present, `other` must be too. The indices are
/// those of the type's properties, kNone if it does not list the member.
struct DependencyPlan {
  std::string name;
  std::string other;
  std::uint32_t property = kNone;
  std::uint32_t needed = kNone;
};

/// Symbol to property of one type: open addressing in a power of two of entries.
struct TypePlan {
  struct Entry {
    Symbol symbol = kNone;
    std::uint16_t property = 0;
    bool alias = false;
  };
  std::vector<Entry> entries;
  std::vector<PropertyPlan> properties;
  std::vector<DependencyPlan> dependencies;
  std::uint32_t constraints_at =
      0;  ///< rules about several members are checked before this property
  /// Extensions are checked before this property, or after all of them.
  std::uint32_t extensions_at = kNone;
  TypeId origin = kNone;  ///< that of the type
  bool is_root = false;
  std::uint32_t declarations_at =
      kNone;  ///< root: declarations of extensions are checked before this property
  std::uint32_t asset_at = kNone - 1;  ///< root: the property `asset`

  const Entry* find(Symbol symbol) const {
    const std::size_t mask = entries.size() - 1;
    for (std::size_t at = symbol & mask;; at = (at + 1) & mask) {
      if (entries[at].symbol == symbol) return &entries[at];
      if (entries[at].symbol == kNone) return nullptr;
    }
  }
};

/// A relation with the other extension's id, kNone when the Set does not have it.
struct RelationPlan {
  const Relation* relation = nullptr;
  ExtensionId other = kNone;
};

struct ExtensionPlan {
  std::vector<RelationPlan> excludes, requires_, overridden_by;
  std::vector<std::pair<TypeId, ShapeId>>
      attachment_points;  ///< origin of the host type, shape of the object
};

/// Arrays that references may point into.
struct TargetPlan {
  Target target;
  std::string pointer;      ///< from the root; empty for Base::enclosing
  bool steps_over = false;  ///< has a '*'
};

/// A target from the root, and the number of its first steps that the previous lookup shares.
struct TargetLookup {
  std::uint32_t target = kNone;
  std::uint32_t shared = 0;
};

/// Plans that depend on shapes and types only: an image has them.
struct WalkPlans {
  std::vector<std::string_view> names;  ///< by Symbol; they live in the Set or in its image
  std::vector<ShapePlan> shapes;
  std::vector<TypePlan> types;
  std::vector<TargetPlan> targets;
  std::vector<std::uint32_t>
      name_target_of;                 ///< by ShapeId: index into targets for refName, or kNone
  std::vector<TargetLookup> lookups;  ///< in the order of their steps
};

struct Set::WalkTables : WalkPlans {
  static constexpr Symbol kExtensions = 0;
  static constexpr Symbol kExtras = 1;
  json::KeyTable symbols;  ///< its numbers are Symbols
  std::vector<ExtensionPlan> extensions;
  /// Shapes of core whose enum an extension widens.
  struct Addition {
    ShapeId shape;
    ExtensionId extension;
    std::vector<Literal> values;
  };
  std::vector<Addition> additions;
  TypeId root = kNone;
};

std::shared_ptr<const Set::WalkTables> make_walk_tables(const Set& set);
/// The same for a Set whose plans are available.
std::shared_ptr<const Set::WalkTables> make_walk_tables(const Set& set, WalkPlans plans);

/// The slot of a property of an extension's object, in the generation of the object. Lives in the
/// Set; null when the property is not a slot.
const Slot* slot_of_generation(const Set& set, const ObjectType& type,
                               const json::Document& document, json::NodeId object,
                               std::string_view property);

}  // namespace gltfx::schema

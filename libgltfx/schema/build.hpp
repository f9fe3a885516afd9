// SPDX-License-Identifier: Apache-2.0
/// State that the stages of compilation share, and construction of the Set.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "schema/pattern.hpp"
#include "schema/set.hpp"
#include "schema/source.hpp"

namespace gltfx::schema {

/// The contents of a Set, accessible to the compiler.
struct SetParts {
  std::vector<Shape> shapes;
  std::vector<ObjectType> types;
  std::vector<Extension> extensions;
  std::vector<VersionText> versions;
  std::unordered_map<std::string, TypeId> type_ids;
  std::unordered_map<std::string, ExtensionId> extension_ids;
  std::vector<Pattern> patterns;

  TypeId find_type(const std::string& name) const;
  ExtensionId find_extension(const std::string& name) const;
  const Property* find_property(TypeId type, std::string_view name) const;
};

struct LazyParts {
  std::shared_ptr<const Lazy<Shape>> shapes;
  std::shared_ptr<const Lazy<ObjectType>> types;
};

struct WalkPlans;

/// The only access to the contents of a Set.
class SetWriter {
 public:
  /// Makes the walk's tables and closes the Set.
  static std::shared_ptr<const Set> close(SetParts parts, const Hash128& sources = {});
  /// The same with shapes and types that are read later, of which `parts` has none, and the walk's
  /// plans for them.
  static std::shared_ptr<const Set> close(SetParts parts, LazyParts lazy, WalkPlans plans);
  /// A copy of the contents of a Set.
  static SetParts open(const Set& set);

 private:
  static std::shared_ptr<Set> make(SetParts parts, LazyParts lazy);
};

/// State of one compilation. Stages run in the order: vocabulary, shapes, extensions, references.
struct Build {
  Build(const std::vector<Source>& files, ErrorList& list) : sources(files), errors(list) {}

  const std::vector<Source>& sources;
  ErrorList& errors;
  SetParts set;
  std::unordered_map<std::string_view, SourceId> by_id;
  std::vector<std::unordered_map<std::string_view, json::NodeId>> defs;  ///< `$defs` by SourceId
  std::vector<ExtensionId> extension_of;                ///< by SourceId; kNone for core
  std::vector<Site> shape_sites;                        ///< by ShapeId
  std::unordered_map<std::uint64_t, ShapeId> shape_at;  ///< by site key

  const json::Document& document(Site at) const { return sources[at.source].document; }
  Site member(Site object, std::string_view name) const {
    if (!object.exists()) return {};
    return {object.source, sources[object.source].find(object.node, name)};
  }
  std::string text(Site at) const { return document(at).string(at.node); }
  static std::uint64_t key(Site at) { return (std::uint64_t{at.source} << 32) | at.node; }

  /// The shape of a node, with its $refs followed; kNone when it accepts everything.
  ShapeId shape_of(Site at) const;
  /// The target of a `$ref`, or a site that does not exist, with an error.
  Site resolve(Site reference);
  /// Whether so many more bytes may be copied; an error at `at` when all copies together are too
  /// large.
  bool may_copy(std::uint64_t bytes, Site at);

 private:
  std::uint64_t copied_ = 0;
  template <class Map>
  Site unresolved(Site reference, std::string message, std::string_view word, const Map& known);
};

/// Maximum length of a chain of `$ref`s to `$ref`s.
inline constexpr int kLongestChain = 40;

/// Sets up `by_id` and the extensions' ids; errors for `$id`s that occur twice.
void register_sources(Build& build);
/// Makes shapes and types of all files.
void build_shapes(Build& build);
/// Makes extensions from the annotations of extension files, and their objects' types for each
/// host.
void build_extensions(Build& build);
/// Removes `extensions` and `extras` from types that list them without a description.
void drop_common_members(SetParts& set);
/// Resolves what needs all files: targets, slots' factors, loops.
void check_references(Build& build);

}  // namespace gltfx::schema

// SPDX-License-Identifier: Apache-2.0
/// A Set under construction.
#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "schema/pattern.hpp"
#include "schema/set.hpp"

namespace gltfx::schema {

/// What a Set consists of, open to the compiler.
struct SetParts {
  std::vector<Shape> shapes;
  std::vector<ObjectType> types;
  std::vector<Extension> extensions;
  std::unordered_map<std::string, TypeId> type_ids;
  std::unordered_map<std::string, ExtensionId> extension_ids;
  std::vector<Pattern> patterns;

  TypeId find_type(const std::string& name) const;
  ExtensionId find_extension(const std::string& name) const;
  const Property* find_property(TypeId type, std::string_view name) const;
};

/// The one way into a Set, and out of it.
class SetWriter {
 public:
  /// Makes the walk's tables and closes the Set.
  static std::shared_ptr<const Set> close(SetParts parts, const Hash128& sources = {});
  /// A copy of what a Set consists of.
  static SetParts open(const Set& set);
};

}  // namespace gltfx::schema

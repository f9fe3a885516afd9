// SPDX-License-Identifier: Apache-2.0
/// @file
/// The schemas of extensions, with schema files of your own.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace gltfx {

namespace schema {
class Set;
}

/// A schema file: JSON Schema 2020-12 with the keyword `x-gltfx`, as `gltfx validate --schema`
/// takes it.
struct SchemaSource {
  std::string name;  ///< as problems name it
  std::string text;  ///< its bytes
};

/// The built-in set with `sources` added; a source replaces the file with the same `$id`. For
/// ValidateOptions::schemas and the like. Any number of threads may share it. Null when there are
/// mistakes: `problems` gets a sentence for each, with name, line and column. Never throws.
std::shared_ptr<const schema::Set> make_schema_set(const std::vector<SchemaSource>& sources,
                                                   std::vector<std::string>& problems);

}  // namespace gltfx

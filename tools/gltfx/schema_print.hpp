// SPDX-License-Identifier: Apache-2.0
/// `gltfx schema`, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "schema/set.hpp"
#include "terminal.hpp"

namespace gltfx::tool {

// The list of extensions and core types; of extensions with these statuses only, unless the list is
// empty.
std::string schema_list_text(const schema::Set& set, const std::vector<schema::Status>& statuses,
                             const Style& style);
std::string schema_list_json(const schema::Set& set, const std::vector<schema::Status>& statuses);

// Everything about one extension.
std::string extension_text(const schema::Set& set, schema::ExtensionId id, const Style& style);
std::string extension_json(const schema::Set& set, schema::ExtensionId id);

// One object type with its properties.
std::string type_text(const schema::Set& set, schema::TypeId id, const Style& style);
std::string type_json(const schema::Set& set, schema::TypeId id);

}  // namespace gltfx::tool

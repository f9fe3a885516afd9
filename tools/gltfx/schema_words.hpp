// SPDX-License-Identifier: Apache-2.0
/// The constraints of schemas as text, and the hosts of objects.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "schema/set.hpp"

namespace gltfx::tool {

/// "number", "array of 3 numbers", "textureInfo", "any value".
std::string type_words(const schema::Set& set, schema::ShapeId shape);

/// "0 to 1", "above 0", "1 to 9 items", "one of "MASK", "BLEND""; empty when all values of the type
/// are allowed.
std::string limit_words(const schema::Set& set, schema::ShapeId shape);

/// "RGB, sRGB, scaled by baseColorFactor".
std::string slot_words(const schema::Slot& slot);

/// Names of the object types that host an extension, each once.
std::vector<std::string> home_names(const schema::Set& set, const schema::Extension& extension);

/// Object types that an extension adds, each definition once, in the order of the set.
std::vector<schema::TypeId> types_of(const schema::Set& set, schema::ExtensionId extension);

/// Names of the object types of the core specification, sorted.
std::vector<std::string_view> core_type_names(const schema::Set& set);

/// Extensions sorted by name; only those with these statuses, unless `statuses` is empty.
std::vector<const schema::Extension*> sorted_extensions(
    const schema::Set& set, const std::vector<schema::Status>& statuses);

/// All values of `upgrade --generation`, "auto" first.
std::vector<std::string> generation_names(const schema::Set& set);

/// As in the schema files: "always", "without-fallback", "recommended"; empty when optional.
std::string_view must_be_required_name(schema::MustBeRequired must);

}  // namespace gltfx::tool

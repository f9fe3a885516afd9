// SPDX-License-Identifier: Apache-2.0
/// Names of extensions that are in use, with a schema here or without one.
#pragma once

#include <string_view>

#include "schema/set.hpp"

namespace gltfx::schema {

/// A registered or widespread name, or that of a draft, without a schema here.
bool is_known_without_schema(std::string_view name);

/// Whether an extension may add values to lists of the core: it has no schema, is not known to add
/// none, and is not misspelt.
bool may_add_values(const Set& set, std::string_view name);

/// The known name that the unknown `name` misspells: at most two edits away, or different in case
/// and '_' only. Empty: none. Lives as long as the Set.
std::string_view misspelt_extension(const Set& set, std::string_view name);

}  // namespace gltfx::schema

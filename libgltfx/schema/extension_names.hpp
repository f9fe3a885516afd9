// SPDX-License-Identifier: Apache-2.0
/// Names of extensions that are in use, with a schema here or without one.
#pragma once

#include <string_view>

#include "schema/set.hpp"

namespace gltfx::schema {

/// A registered or widespread name, or that of a draft, of which no schema here tells more.
bool is_known_without_schema(std::string_view name);

/// Whether an extension may add values to lists of the core for all that is known here: it has no
/// schema, and is neither known to add none nor misspelt.
bool may_add_values(const Set& set, std::string_view name);

/// The known name of which `name`, itself unknown, is a typing slip: at most two edits away, or
/// another spelling of case and '_'. Empty: of none. Lives as long as the Set.
std::string_view misspelt_extension(const Set& set, std::string_view name);

}  // namespace gltfx::schema

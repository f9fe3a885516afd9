// SPDX-License-Identifier: Apache-2.0
/// The table of material parameters as C++ source.
#pragma once

#include <string>

#include "schema/set.hpp"

namespace gltfx::schema {

/// The header base/material_table.hpp: rows of base/material_row.hpp for the core, for extensions
/// that have a successor, and for the others, each in the order of the set. Where several texts
/// name one parameter, what comes later is the later text.
std::string material_table(const Set& set);

}  // namespace gltfx::schema

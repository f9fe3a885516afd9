// SPDX-License-Identifier: Apache-2.0
/// The schema files inside the library, written by the build.
#pragma once

#include <string_view>

#include "schema/text_index.hpp"

namespace gltfx::schema {

/// The files, relative to schema/.
Texts embedded_names();
/// Their contents, in the same order.
Texts embedded_texts();
/// The Set they make, as `schema/stored_set.hpp` reads it with these texts.
std::string_view embedded_set();

}  // namespace gltfx::schema

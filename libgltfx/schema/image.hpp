// SPDX-License-Identifier: Apache-2.0
/// A Set as bytes: the built-in one is compiled by the build and only read at start, which takes a
/// quarter of the time.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "schema/set.hpp"

namespace gltfx::schema {

/// All of a Set but the tables that are made from it. Equal Sets give equal bytes.
std::string write_image(const Set& set);

/// The Set behind an image of the same version of the library. Null when the bytes are no image.
/// Shapes and types are read when they are asked for: the bytes stay where they are while the Set
/// lives.
std::shared_ptr<const Set> read_image(std::string_view bytes);

}  // namespace gltfx::schema

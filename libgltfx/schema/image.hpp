// SPDX-License-Identifier: Apache-2.0
/// A Set as bytes: the built-in one is compiled by the build and only read at start, which takes a
/// quarter of the time.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "schema/set.hpp"
#include "schema/text_index.hpp"

namespace gltfx::schema {

/// All of a Set but the tables that are made from it. Equal Sets give equal bytes. Strings that
/// stand in the texts are written as their places.
std::string write_image(const Set& set, Texts texts = {});

/// The Set behind an image of the same version of the library, written with the same texts. Null
/// when the bytes are no image. Shapes and types are read when they are asked for: bytes and texts
/// stay where they are while the Set lives.
std::shared_ptr<const Set> read_image(std::string_view bytes, Texts texts = {});

}  // namespace gltfx::schema

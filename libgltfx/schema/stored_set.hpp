// SPDX-License-Identifier: Apache-2.0
/// A Set as bytes: the built-in Set is compiled by the build and only read at start, which takes a
/// quarter of the time.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "schema/set.hpp"
#include "schema/text_index.hpp"

namespace gltfx::schema {

/// A Set without its derived tables. Equal Sets give equal bytes. Strings that occur in the texts
/// are written as their places.
std::string write_set(const Set& set, Texts texts = {});

/// The Set that the same version of the library wrote with the same texts. Null when the bytes are
/// no such Set. Shapes and types are read at first use: bytes and texts must outlive the Set.
std::shared_ptr<const Set> read_set(std::string_view bytes, Texts texts = {});

}  // namespace gltfx::schema

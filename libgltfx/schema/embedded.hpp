// SPDX-License-Identifier: Apache-2.0
/// The schema files inside the library, written by the build.
#pragma once

#include <span>
#include <string_view>

namespace gltfx::schema {

struct EmbeddedFile {
  std::string_view name;                   ///< relative to schema/
  std::span<const std::string_view> text;  ///< in pieces
};

std::span<const EmbeddedFile> embedded_files();
/// The Set they make, as `schema/image.hpp` reads it.
std::string_view embedded_image();

}  // namespace gltfx::schema

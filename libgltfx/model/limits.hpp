// SPDX-License-Identifier: Apache-2.0
/// What is too much for the size of an asset.
#pragma once

#include <cstdint>

#include "json/document.hpp"

namespace gltfx::model {

/// Most objects in the root arrays of an asset with so many bytes of text, all arrays together. A
/// million of them, and one more for each 32 bytes: what is written on purpose takes more, and each
/// costs many times the three bytes of "{},".
constexpr std::uint64_t most_root_objects(std::uint64_t text_bytes) {
  return 1'000'000 + text_bytes / 32;
}

/// Elements of the arrays that are members of the root.
std::uint64_t root_objects(const json::Document& document);

}  // namespace gltfx::model

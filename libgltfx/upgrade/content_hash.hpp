// SPDX-License-Identifier: Apache-2.0
/// A number that stands for bytes in names and tables; equal numbers are no proof of equal bytes.
#pragma once

#include <cstdint>
#include <string_view>

namespace gltfx::upgrade {

/// The same on every machine, today and later: names of files are made of it.
std::uint64_t content_hash(std::string_view bytes);

}  // namespace gltfx::upgrade

// SPDX-License-Identifier: Apache-2.0
/// Finds equal records in a list of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace gltfx {

/// For each of the records of `size` bytes, the number of the first record with the same bytes.
/// Takes a few steps for each, on average, for any bytes. Preconditions: `size` is not 0, and there
/// are at most UINT32_MAX records.
std::vector<std::uint32_t> first_equal_records(std::string_view bytes, std::size_t size);

}  // namespace gltfx

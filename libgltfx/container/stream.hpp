// SPDX-License-Identifier: Apache-2.0
/// Reads what has no size and no name: standard input, a pipe.
#pragma once

#include <cstdint>

#include "base/result.hpp"
#include "container/bytes.hpp"

namespace gltfx::container {

/// Reads `fd` to its end into memory; the descriptor stays the caller's. Waits where the other side
/// is slow, also when the descriptor does not block. An Error when more than `max_bytes` come.
Result<Bytes> read_stream(int fd, std::uint64_t max_bytes = UINT64_MAX);

}  // namespace gltfx::container

// SPDX-License-Identifier: Apache-2.0
/// Which memory is a mapped file, so that a signal handler can tell.
#pragma once

#include <cstddef>
#include <memory>

#include "container/bytes.hpp"

namespace gltfx::container {

/// Owns `length` bytes mapped at `start`: unmaps them when the last copy is gone.
std::shared_ptr<const void> own_mapping(void* start, std::size_t length);

/// Whether the file behind the bytes became shorter while it was read, as far as somebody called
/// repair_mapping(). False for bytes that are no mapping.
bool is_torn(const Bytes& bytes);

}  // namespace gltfx::container

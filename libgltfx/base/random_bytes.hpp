// SPDX-License-Identifier: Apache-2.0
/// Seeds of hashes.
#pragma once

#include <span>

namespace gltfx {

/// Fills `bytes` with random numbers of the system. Without a source of entropy, the clock and the
/// layout of the address space seed a generator. Not for cryptography.
void fill_with_random(std::span<unsigned char> bytes);

}  // namespace gltfx

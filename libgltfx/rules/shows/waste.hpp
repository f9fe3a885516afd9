// SPDX-License-Identifier: Apache-2.0
/// How much waste is worth a word.
#pragma once

#include <cstdint>
#include <string>

#include "rules/payload/phases.hpp"

namespace gltfx::validate {

inline constexpr std::uint64_t kWorthBytes = 1024;

/// Whether the bytes are many, and a hundredth of those of all buffers.
inline bool is_worth(const DataPhase& phase, std::uint64_t bytes) {
  return bytes >= kWorthBytes && bytes >= phase.resources.buffer_bytes() / 100;
}

}  // namespace gltfx::validate

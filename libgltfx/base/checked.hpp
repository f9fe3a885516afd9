// SPDX-License-Identifier: Apache-2.0
/// Unsigned 64-bit arithmetic that reports overflow instead of wrapping. Every offset, count and
/// stride that comes from a file goes through here.
#pragma once

#include <cstdint>
#include <optional>

namespace gltfx {

using Checked = std::optional<std::uint64_t>;

/// a + b, or nothing when it does not fit in 64 bits.
constexpr Checked checked_add(std::uint64_t a, std::uint64_t b) {
  const std::uint64_t sum = a + b;
  if (sum < a) return std::nullopt;
  return sum;
}

/// a + b, or the largest number when it does not fit in 64 bits.
constexpr std::uint64_t saturating_add(std::uint64_t a, std::uint64_t b) {
  return checked_add(a, b).value_or(UINT64_MAX);
}

/// a * b, or nothing when it does not fit in 64 bits.
constexpr Checked checked_mul(std::uint64_t a, std::uint64_t b) {
  if (a != 0 && b > UINT64_MAX / a) return std::nullopt;
  return a * b;
}

/// Whether [offset, offset + length) is inside [0, size).
constexpr bool fits(std::uint64_t offset, std::uint64_t length, std::uint64_t size) {
  return offset <= size && length <= size - offset;
}

}  // namespace gltfx

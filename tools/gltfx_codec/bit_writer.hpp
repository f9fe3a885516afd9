// SPDX-License-Identifier: Apache-2.0
/// Writes bits from the lowest bit of the first byte on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace gltfx::codec {

/// Precondition: the bytes are 0 and there is room for all bits.
class BitWriter {
 public:
  explicit BitWriter(std::span<std::byte> bytes) : bytes_(bytes) {}

  /// Appends the lowest `count` bits, the first one lowest.
  void put(std::uint32_t value, unsigned count) {
    for (unsigned i = 0; i < count; ++i, ++at_) {
      bytes_[at_ / 8] |= static_cast<std::byte>((value >> i & 1U) << at_ % 8);
    }
  }

 private:
  std::span<std::byte> bytes_;
  std::size_t at_ = 0;
};

}  // namespace gltfx::codec

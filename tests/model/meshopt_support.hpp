// SPDX-License-Identifier: Apache-2.0
/// Streams to decode, and data to make them from.
#pragma once

#include <span>

#include "model/meshopt.hpp"
#include "model/meshopt_encoder.hpp"

namespace gltfx::test {

inline std::span<const std::byte> bytes_of(const Octets& octets) {
  return std::as_bytes(std::span(octets));
}

struct Decoded {
  model::meshopt::DecodeError error = model::meshopt::DecodeError::none;
  Octets elements;
  bool operator==(const Decoded&) const = default;
};

inline Decoded decoded(const Octets& stream, const model::meshopt::Layout& layout) {
  Decoded result;
  result.elements.resize(static_cast<std::size_t>(layout.count * layout.stride));
  result.error = model::meshopt::decode(bytes_of(stream), layout,
                                        std::as_writable_bytes(std::span(result.elements)));
  if (result.error != model::meshopt::DecodeError::none) result.elements.clear();
  return result;
}

inline model::meshopt::DecodeError error_of(const Octets& stream,
                                            const model::meshopt::Layout& layout) {
  return decoded(stream, layout).error;
}

/// The same numbers on every machine.
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : state_(seed) {}
  std::uint32_t below(std::uint32_t limit) {
    state_ = state_ * 1664525U + 1013904223U;
    return (state_ >> 8U) % limit;
  }
  /// Some of it noise, some of it steps, some of it the same over and over.
  Octets elements(std::size_t count, std::size_t stride) {
    Octets all(count * stride);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t lane = i % stride;
      const std::uint32_t before = i < stride ? 7 : all[i - stride];
      const std::uint32_t noise[] = {0, below(3), below(256), below(20) == 0 ? below(256) : 0U, 5};
      all[i] = static_cast<std::uint8_t>(before + noise[lane % 5]);
    }
    return all;
  }

 private:
  std::uint32_t state_;
};

}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
/// Hashes of contents that come from strangers: XXH3 with a secret of 192 bytes. Who does not know
/// the secret cannot prepare two contents with one hash. It is no seal: for that, see
/// pipeline/seal.hpp.
#pragma once

#include <array>
#include <string_view>

#include "base/hash.hpp"

namespace gltfx {

class KeyedHash {
 public:
  using Secret = std::array<unsigned char, 192>;  ///< bytes that look random

  explicit KeyedHash(const Secret& secret) : secret_(secret) {}
  Hash128 of(std::string_view bytes) const;

 private:
  Secret secret_;
};

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
/// Hashes that tell contents apart: XXH3 with 128 bits. Not against somebody who looks for two
/// contents with one hash; for contents that come from strangers there is KeyedHash.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace gltfx {

struct Hash128 {
  std::uint64_t low = 0, high = 0;
  bool operator==(const Hash128&) const = default;
};

/// The same on every machine.
Hash128 hash_bytes(std::string_view bytes);

/// The same on every machine, today and later: names of files are made of it.
std::uint64_t content_hash(std::string_view bytes);

/// Takes parts together so that no two lists of parts give the same bytes.
class HashParts {
 public:
  void add(std::string_view text);
  void add(std::uint64_t number);
  void add(const Hash128& hash);
  Hash128 finish() const { return hash_bytes(bytes_); }

 private:
  std::string bytes_;
};

/// Hashes of contents that come from strangers, with a secret of 192 bytes. Who does not know the
/// secret cannot prepare two contents with one hash. It is no seal: for that, see
/// pipeline/seal.hpp.
class KeyedHash {
 public:
  using Secret = std::array<unsigned char, 192>;  ///< bytes that look random

  explicit KeyedHash(const Secret& secret) : secret_(secret) {}
  Hash128 of(std::string_view bytes) const;

 private:
  Secret secret_;
};

}  // namespace gltfx

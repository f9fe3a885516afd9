// SPDX-License-Identifier: Apache-2.0
/// Hashes that distinguish contents: XXH3 with 128 bits. It does not resist deliberate collisions;
/// use KeyedHash for contents from untrusted sources.
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

/// The same on every machine and in every version: file names contain it.
std::uint64_t content_hash(std::string_view bytes);

/// Combines parts so that no two lists of parts give the same bytes.
class HashParts {
 public:
  void add(std::string_view text);
  void add(std::uint64_t number);
  void add(const Hash128& hash);
  Hash128 finish() const { return hash_bytes(bytes_); }

 private:
  std::string bytes_;
};

/// Hashes contents from untrusted sources, with a secret of 192 bytes. Without the secret, two
/// contents with one hash cannot be prepared. It is not a seal: see pipeline/seal.hpp.
class KeyedHash {
 public:
  using Secret = std::array<unsigned char, 192>;  ///< bytes that look random

  explicit KeyedHash(const Secret& secret) : secret_(secret) {}
  Hash128 of(std::string_view bytes) const;

 private:
  Secret secret_;
};

}  // namespace gltfx

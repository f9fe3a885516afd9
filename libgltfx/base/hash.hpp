// SPDX-License-Identifier: Apache-2.0
/// Hashes that tell contents apart: XXH3 with 128 bits. Not against somebody who looks for two
/// contents with one hash.
#pragma once

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

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
#include "base/secret_hash.hpp"

#include "base/fork.hpp"
#include "base/random_bytes.hpp"
#include "base/stable_hashes.hpp"

namespace gltfx {
namespace {

thread_local const KeyedHash* stable_hash = nullptr;  // that of StableHashes

// Bytes that look random, and are the same everywhere.
KeyedHash make_stable_hash() {
  KeyedHash::Secret secret{};
  std::size_t at = 0;
  for (char seed = 0; at < secret.size(); ++seed) {
    const Hash128 hash = hash_bytes({&seed, 1});
    for (const std::uint64_t word : {hash.low, hash.high}) {
      for (unsigned i = 0; i < sizeof(word) && at < secret.size(); ++i) {
        secret[at++] = static_cast<unsigned char>(word >> (8 * i));
      }
    }
  }
  return KeyedHash(secret);
}

}  // namespace

StableHashes::StableHashes() {
  static constinit MadeOnce<KeyedHash> made;
  stable_hash = &made.get([] { return make_stable_hash(); });
}

StableHashes::~StableHashes() { stable_hash = nullptr; }

const KeyedHash& secret_hash() {
  if (stable_hash != nullptr) return *stable_hash;
  static constinit MadeOnce<KeyedHash> made;
  return made.get([] {
    KeyedHash::Secret secret{};
    fill_with_random(secret);
    return KeyedHash(secret);
  });
}

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
#include "base/secret_hash.hpp"

#include "base/fork.hpp"
#include "base/random_bytes.hpp"

namespace gltfx {

const KeyedHash& secret_hash() {
  static constinit MadeOnce<KeyedHash> made;
  return made.get([] {
    KeyedHash::Secret secret{};
    fill_with_random(secret);
    return KeyedHash(secret);
  });
}

}  // namespace gltfx

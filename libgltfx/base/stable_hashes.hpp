// SPDX-License-Identifier: Apache-2.0
/// Hashes that are printed.
#pragma once

#include "base/hash.hpp"

namespace gltfx {

/// While one lives, secret_hash() on this thread is the same in each run. Contents with equal
/// hashes can be prepared then: for what is printed, not for what is proved.
class StableHashes {
 public:
  StableHashes();
  ~StableHashes();
  StableHashes(const StableHashes&) = delete;
  StableHashes& operator=(const StableHashes&) = delete;
};

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
/// Where bytes come from, as far as it matters who trusts whom.
#pragma once

#include <atomic>
#include <cstdint>

namespace gltfx {

/// The folder that an asset is confined to, by device and file number, or a number of its own for
/// bytes that came from no folder. What bytes of one origin break may spoil nothing that is made of
/// another. The default one stands for what this program makes itself.
struct Origin {
  std::uint64_t device = 0;
  std::uint64_t file = 0;
  bool operator==(const Origin&) const = default;
};

/// One that nothing else has. Any number of threads may call.
inline Origin new_origin() {
  static constinit std::atomic<std::uint64_t> last = 0;
  return {0, ++last};  // no folder is on device 0
}

}  // namespace gltfx

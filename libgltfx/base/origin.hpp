// SPDX-License-Identifier: Apache-2.0
/// The trust domain of bytes.
#pragma once

#include <atomic>
#include <cstdint>

namespace gltfx {

/// The folder that an asset is confined to, by device and file number, or a number of its own for
/// bytes that came from no folder. Bytes of one origin must not affect results of another. The
/// default is the origin of bytes that this program makes itself.
struct Origin {
  std::uint64_t device = 0;
  std::uint64_t file = 0;
  bool operator==(const Origin&) const = default;
};

/// A unique origin. Thread-safe.
inline Origin new_origin() {
  static constinit std::atomic<std::uint64_t> last = 0;
  return {0, ++last};  // no folder is on device 0
}

}  // namespace gltfx

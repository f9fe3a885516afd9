// SPDX-License-Identifier: Apache-2.0
#include "base/origin.hpp"

#include <atomic>

namespace gltfx {

Origin new_origin() {
  static std::atomic<std::uint64_t> last = 0;
  return {0, ++last};  // no folder is on device 0
}

}  // namespace gltfx

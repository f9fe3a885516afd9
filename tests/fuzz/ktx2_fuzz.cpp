// SPDX-License-Identifier: Apache-2.0
// Any bytes are read as a KTX2 file; what is said of them holds, and sound ones lie inside.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "base/checked.hpp"
#include "image/ktx2.hpp"

namespace {

using namespace gltfx::image;

void require(bool promise) {
  if (!promise) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Ktx2 file = read_ktx2({reinterpret_cast<const std::byte*>(data), size});
  require(file.levels.size() <= 32);
  for (const Ktx2Error& error : file.errors) {
    require(!gltfx::code_name(error.code).empty() && error.problem.back() == '.');
  }
  if (!file.is_sound()) return 0;
  require(file.described && !file.levels.empty());
  for (const Ktx2Level& level : file.levels) {
    require(gltfx::fits(level.offset, level.length, size) && level.length > 0);
  }
  const Header header = header_of(file);
  require(header.width > 0 && header.height > 0);
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// Any bytes are read as an image; a header that is given contradicts itself nowhere.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <variant>

#include "image/header.hpp"

namespace {

using namespace gltfx::image;

void require(bool promise) {
  if (!promise) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  const HeaderResult result = read_header(bytes);
  if (const auto* error = std::get_if<HeaderError>(&result)) {
    require(error->kind != HeaderError::Kind::invalid || !error->problem.empty());
    return 0;
  }
  const Header& header = std::get<Header>(result);
  require(sniff(bytes).known && sniff(bytes).format == header.format);
  require(!header.opaque || has_alpha(header.channels));
  require(!header.doubt.empty() || (header.width > 0 && header.height > 0));
  return 0;
}

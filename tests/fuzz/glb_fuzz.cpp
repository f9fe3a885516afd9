// SPDX-License-Identifier: Apache-2.0
// Any bytes are taken apart; whatever is said about them must lie inside them.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/checked.hpp"
#include "container/container.hpp"

namespace {

using namespace gltfx::container;

void require(bool promise) {
  if (!promise) std::abort();
}

void check_errors(const std::vector<ContainerError>& errors, std::uint64_t size) {
  for (const ContainerError& error : errors) {
    require(error.offset <= size && !gltfx::code_name(error.code).empty());
    require(!error.message.empty() && !error.help.empty());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const Container container = open_bytes(Bytes::from_string(bytes), "fuzz.glb");
  require(container.bytes.text() == bytes);
  check_errors(container.errors, size);
  check_errors(container.late_errors, size);
  for (const Chunk& chunk : container.chunks) {
    require(gltfx::fits(chunk.offset, chunk.length, size));
    const std::uint64_t header = chunk.offset - chunk.header_offset;
    require(header == 8 || header == 16);  // of version 2, of version 3
  }
  if (container.bin) require(gltfx::fits(container.bin->offset, container.bin->length, size));
  if (container.json) {
    require(bytes.compare(container.json_offset, container.json->size(), *container.json) == 0);
  }
  return 0;
}

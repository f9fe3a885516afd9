// SPDX-License-Identifier: Apache-2.0
// Floor of a check of compressed geometry: maps a GLB and decodes every Draco bitstream in it.
//
//   floor_draco FILE.glb THREADS
#include <string_view>

#include <draco/compression/decode.h>

#include "embedded.hpp"

namespace {

bool decode(std::string_view bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  draco::Decoder decoder;
  return decoder.DecodeMeshFromBuffer(&buffer).ok();
}

}  // namespace

int main(int argc, char** argv) { return gltfx::bench::decode_all(argc, argv, "DRACO\2", decode); }

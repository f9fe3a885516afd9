// SPDX-License-Identifier: Apache-2.0
// gltfx-codec-avif: decodes AVIF images for gltfx, which starts it and communicates over a socket.
// It is a separate program because loading the libraries of libavif takes longer than decoding most
// images.
#include "avif_decode.hpp"
#include "codec/server.hpp"

int main() {
  return gltfx::codec::serve([] {}, gltfx::codec::decode_avif);
}

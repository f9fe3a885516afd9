// SPDX-License-Identifier: Apache-2.0
// gltfx-codec-avif: decodes AVIF images for gltfx, which starts it and talks to it over a socket.
// It is a separate program because the libraries of libavif take longer to load than most images
// take to decode.
#include "avif_decode.hpp"
#include "codec/server.hpp"

int main() {
  return gltfx::codec::serve([] {}, gltfx::codec::decode_avif);
}

// SPDX-License-Identifier: Apache-2.0
// gltfx-codec-draco: decodes Draco meshes for gltfx, which starts it and talks to it over a socket.
#include "codec/server.hpp"
#include "draco_decode.hpp"

int main() {
  return gltfx::codec::serve([] {}, gltfx::codec::decode_draco);
}

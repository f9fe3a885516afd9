// SPDX-License-Identifier: Apache-2.0
// gltfx-codec-image: decodes PNG, JPEG, WebP, KTX2, Radiance and EXR for gltfx, changes
// their size, and encodes all but Radiance. gltfx starts it and talks to it over a socket.
// Workers are forked from it: nothing that it links may start a thread.
#include "codec/server.hpp"
#include "transcode.hpp"

int main() {
  return gltfx::codec::serve([] {}, gltfx::codec::serve_image);
}

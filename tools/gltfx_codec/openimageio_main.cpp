// SPDX-License-Identifier: Apache-2.0
// gltfx-codec-openimageio: decodes images that glTF does not have for gltfx, which starts it and
// talks to it over a socket. A program of its own: OpenImageIO brings some 260 libraries.
#include "codec/server.hpp"
#include "openimageio_decode.hpp"

int main() {
  return gltfx::codec::serve(gltfx::codec::prepare_openimageio, gltfx::codec::decode_openimageio);
}

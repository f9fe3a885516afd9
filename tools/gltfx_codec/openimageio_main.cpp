// SPDX-License-Identifier: Apache-2.0
// gltfx-codec-openimageio: decodes formats that are not part of glTF for gltfx, which starts it and
// communicates over a socket. It is a separate program because OpenImageIO loads some 260
// libraries.
#include "codec/server.hpp"
#include "openimageio_decode.hpp"

int main() {
  return gltfx::codec::serve(gltfx::codec::prepare_openimageio, gltfx::codec::decode_openimageio);
}

// SPDX-License-Identifier: Apache-2.0
// gltfx-codec-avif: decodes and encodes AVIF images for gltfx, which starts it and communicates
// over a socket. It is a separate program because loading the libraries of libavif takes longer
// than decoding most images.
#include "avif_decode.hpp"
#include "avif_encode.hpp"
#include "codec/server.hpp"

namespace gltfx::codec {
namespace {

Answer serve_avif(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  return job.task == Task::transcode ? encode_avif(job, bytes, output)
                                     : decode_avif(job, bytes, output);
}

}  // namespace
}  // namespace gltfx::codec

int main() {
  return gltfx::codec::serve([] {}, gltfx::codec::serve_avif);
}

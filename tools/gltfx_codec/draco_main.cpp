// SPDX-License-Identifier: Apache-2.0
// gltfx-codec-draco: decodes and encodes Draco meshes for gltfx, which starts it and communicates
// over a socket.
#include "codec/server.hpp"
#include "draco_decode.hpp"
#include "draco_encode.hpp"

namespace gltfx::codec {
namespace {

Answer serve_mesh(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  return job.task == Task::encode_draco ? encode_draco(bytes, output)
                                        : decode_draco(job, bytes, output);
}

}  // namespace
}  // namespace gltfx::codec

int main() {
  return gltfx::codec::serve([] {}, gltfx::codec::serve_mesh);
}

// SPDX-License-Identifier: Apache-2.0
// The client in WebAssembly, where a process is a sandbox itself and cannot start others. A payload
// that crashes the decoder, or takes all memory, ends the instance, which its owner replaces.
#include <gltfx/decoders.hpp>

#include <utility>

#include "codec/client.hpp"
#include "codec/limited_job.hpp"
#include "draco_decode.hpp"

namespace gltfx {

// No effect: there are no other programs.
void set_codec_folder(const std::string&) {}
void permit_unsandboxed_decoders(bool) {}

namespace codec {
namespace {

DecodeError no_images() { return {ErrorKind::unavailable, "This build does not decode images."}; }

}  // namespace

std::uint64_t transient_errors() { return 0; }

struct Client::State {
  Settings settings;
};

Client::Client(Settings settings) : state_(std::make_unique<State>(State{std::move(settings)})) {}
Client::~Client() = default;

DracoResult Client::decode_draco(std::span<const std::byte> bytes, const Origin&) {
  const Job job = limited_job(state_->settings, Task::draco, bytes.size());
  const auto values = std::make_shared<std::vector<std::byte>>();
  Answer answer = decode_safely(gltfx::codec::decode_draco, job, bytes, [&](std::uint64_t size) {
    if (size <= job.memory_bytes) values->resize(static_cast<std::size_t>(size));
    return std::span<std::byte>(*values);
  });
  if (const auto* error = std::get_if<DecodeError>(&answer)) return *error;
  DracoMesh mesh = std::get<DracoMesh>(std::move(answer));
  if (!attach(mesh, *values)) return DecodeError{ErrorKind::malformed, "An index is too large."};
  mesh.owner = values;
  return mesh;
}

DracoEncodeResult Client::encode_draco(const DracoMesh&, const Origin&) {
  return DecodeError{ErrorKind::unavailable, "This build does not encode Draco meshes."};
}

ImageResult Client::decode_image(const ImageRequest&) { return no_images(); }
EncodeResult Client::encode_image(const EncodeRequest&) { return no_images(); }
EncodeResult Client::transcode_image(const TranscodeRequest&) { return no_images(); }
void Client::prepare_images() {}

Client& Client::shared() {
  static Client client;
  return client;
}

}  // namespace codec

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
#include "codec/client.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <utility>

#include "base/fork.hpp"
#include "codec/draco_source.hpp"
#include "codec/limited_job.hpp"
#include "codec/pool.hpp"
#include "codec/program_path.hpp"

namespace gltfx::codec {
namespace {

constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 28U;  // that are returned
// As kSecondsPerByte.
constexpr double kSecondsPerTexel = 1e-7;

std::chrono::milliseconds standstill_of(const Settings& settings) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(settings.standstill_seconds * 1000));
}

// An encoder holds the texels, its output, and tables.
constexpr std::uint64_t kEncoderMemoryPerByte = 8;

std::atomic<std::uint64_t> chances = 0;

DecodeError noted(const DecodeError& error) {
  const bool certain = error.kind == ErrorKind::malformed || error.kind == ErrorKind::too_large;
  if (!certain) ++chances;
  return error;
}

DecodeError no_thread_here() {
  return {ErrorKind::unavailable, "The system cannot wait for a decoder."};
}

DecodeError no_avif() {
  return {ErrorKind::unavailable,
          "This installation has no decoder of AVIF images: gltfx was built without libavif."};
}

// The result of `work`. Missing memory in this process is not an error of a payload.
template <typename Work>
auto guarded(Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return noted(no_thread_here());
  }
}

template <typename T>
std::variant<T, DecodeError> result_of(Pool& pool, const Job& job, std::span<const std::byte> bytes,
                                       const Origin& origin, bool with_memory) {
  return guarded([&]() -> std::variant<T, DecodeError> {
    Reply reply = pool.ask(job, bytes, origin);
    if (const auto* error = std::get_if<DecodeError>(&reply.answer)) return noted(*error);
    T& result = *std::get_if<T>(&reply.answer);
    if (with_memory) result.owner = std::move(reply.memory.owner);
    return std::move(result);
  });
}

}  // namespace

std::uint64_t transient_errors() { return chances; }

struct Client::State {
  explicit State(Settings given)
      : settings(std::move(given)),
        meshes(program_path(settings.folder, "gltfx-codec-draco"), settings.workers,
               standstill_of(settings)),
        images(program_path(settings.folder, "gltfx-codec-image"), settings.workers,
               standstill_of(settings)),
        avif_program(program_path(settings.folder, "gltfx-codec-avif")),
        avif_images(avif_program, settings.workers, standstill_of(settings)) {}

  Settings settings;
  Pool meshes, images;
  std::string avif_program;
  Pool avif_images;
};

Client::Client(Settings settings) : state_(std::make_unique<State>(std::move(settings))) {}
Client::~Client() = default;

DracoResult Client::decode_draco(std::span<const std::byte> bytes, const Origin& origin) {
  const Job job = limited_job(state_->settings, Task::draco, bytes.size());
  return result_of<DracoMesh>(state_->meshes, job, bytes, origin, true);
}

DracoEncodeResult Client::encode_draco(const DracoMesh& mesh, const Origin& origin) {
  if (const std::string flaw = find_flaw(mesh); !flaw.empty()) {
    return DecodeError{ErrorKind::malformed, flaw};
  }
  const std::vector<std::byte> payload = pack(mesh);
  const Job job = limited_job(state_->settings, Task::encode_draco, payload.size());
  EncodeResult encoded = result_of<EncodedImage>(state_->meshes, job, payload, origin, true);
  if (auto* error = std::get_if<DecodeError>(&encoded)) return std::move(*error);
  const EncodedImage& file = *std::get_if<EncodedImage>(&encoded);
  DracoResult decoded = decode_draco(file.bytes, origin);
  if (auto* error = std::get_if<DecodeError>(&decoded)) return std::move(*error);
  DracoMesh& again = *std::get_if<DracoMesh>(&decoded);
  if (!have_same_triangles(mesh, again)) {
    return DecodeError{ErrorKind::malformed, "Draco does not keep all values of this mesh."};
  }
  return EncodedDraco{file.bytes, std::move(again), file.owner};
}

ImageResult Client::decode_image(const ImageRequest& request) {
  Job job = limited_job(state_->settings, Task::image, request.bytes.size());
  job.format = request.format;
  job.level = request.level;
  job.pixels = request.pixels;
  if (request.pixels) {
    const std::uint64_t texel = holds_floats(request.format) ? 16 : 8;
    job.memory_bytes += std::min(request.max_pixels, kMostTexels) * texel;
  }
  job.normals = request.normals;
  job.halvings =
      static_cast<std::uint8_t>(std::min<std::uint32_t>(request.halvings, kMostHalvings));
  job.max_pixels = request.max_pixels;
  const auto texels = static_cast<double>(std::min(request.max_pixels, kMostTexels));
  job.milliseconds += static_cast<std::uint64_t>(texels * kSecondsPerTexel * 1000);
  const bool avif = request.format == ImageFormat::avif;
  if (avif && !is_program(state_->avif_program)) return noted(no_avif());
  return result_of<Image>(avif ? state_->avif_images : state_->images, job, request.bytes,
                          request.origin, request.pixels);
}

EncodeResult Client::encode_image(const EncodeRequest& request) {
  Job job = limited_job(state_->settings, Task::encode, request.pixels.size());
  job.memory_bytes =
      request.pixels.size() * kEncoderMemoryPerByte + state_->settings.image_memory_bytes;
  job.raster = request.raster;
  job.encoded = request.format;
  job.quality = request.quality;
  if (!is_consistent(job)) {
    return DecodeError{ErrorKind::malformed, "The format does not support such images."};
  }
  return result_of<EncodedImage>(state_->images, job, request.pixels, request.origin, true);
}

void Client::prepare_images() {
  try {
    state_->images.prepare();
  } catch (const std::bad_alloc&) {  // reported by the call that needs it
  }
}

namespace {

// Its workers end with the process.
struct SharedClient : PerProcess<Client> {
  ~SharedClient() { destroy(); }
};
constinit SharedClient shared_client;

}  // namespace

Client& Client::shared() { return shared_client.get(); }

}  // namespace gltfx::codec

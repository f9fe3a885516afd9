// SPDX-License-Identifier: Apache-2.0
#include "codec/client.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <exception>
#include <optional>
#include <utility>

#include "base/fork.hpp"
#include "base/work_count.hpp"
#include "codec/draco_source.hpp"
#include "codec/limited_job.hpp"
#include "codec/pool.hpp"
#include "codec/program_path.hpp"

namespace gltfx::codec {
namespace {

constexpr std::uint64_t kMostTexels = std::uint64_t{1} << 28U;  // limit of returned texels
// Like kSecondsPerByte.
constexpr double kSecondsPerTexel = 1e-7;

std::chrono::milliseconds standstill_of(const Settings& settings) {
  return std::chrono::milliseconds(static_cast<std::int64_t>(settings.standstill_seconds * 1000));
}

// An encoder needs memory for the texels, its output, and tables.
constexpr std::uint64_t kEncoderMemoryPerByte = 8;

// Like kSecondsPerByte, for each filtered texel, and for each texel that is encoded with the
// greatest effort and decoded again.
constexpr double kSecondsPerFilteredTexel = 2e-6;
constexpr double kSecondsPerEncodedTexel = 6e-5;

Job image_job(const Settings& settings, const ImageRequest& request) {
  Job job = limited_job(settings, Task::image, request.bytes.size());
  job.format = request.format;
  job.level = request.level;
  job.pixels = request.pixels;
  const std::uint64_t most = std::min(request.max_pixels, kMostTexels);
  const bool floats = holds_floats(request.format) || request.floats;
  if (request.pixels) job.memory_bytes += most * (floats ? 16 : 8);
  job.normals = request.normals;
  job.floats = request.floats;
  job.halvings =
      static_cast<std::uint8_t>(std::min<std::uint32_t>(request.halvings, kMostHalvings));
  job.max_pixels = request.max_pixels;
  job.milliseconds +=
      static_cast<std::uint64_t>(static_cast<double>(most) * kSecondsPerTexel * 1000);
  return job;
}

// The texels, half of them as floats, and the filtered floats.
constexpr std::uint64_t kFilterMemoryPerTexel = 64;

void add_resize(Job& job, const Resize& resize, std::uint64_t texels) {
  job.resize = resize;
  if (resize.max_side == 0) return;
  texels = std::min(texels, kMostTexels);
  job.memory_bytes += texels * kFilterMemoryPerTexel;
  job.milliseconds +=
      static_cast<std::uint64_t>(static_cast<double>(texels) * kSecondsPerFilteredTexel * 1000);
}

void add_encoding(Job& job, std::uint64_t texels) {
  constexpr std::uint64_t kMostTexelBytes = 16;
  job.memory_bytes += texels * kMostTexelBytes * kEncoderMemoryPerByte;
  job.milliseconds +=
      static_cast<std::uint64_t>(static_cast<double>(texels) * kSecondsPerEncodedTexel * 1000);
}

std::atomic<std::uint64_t> chances = 0;

DecodeError noted(const DecodeError& error) {
  if (!depends_on_bytes_alone(error)) ++chances;
  return error;
}

DecodeError no_thread_here() {
  return {ErrorKind::unavailable, "The system cannot wait for a decoder."};
}

DecodeError no_avif() {
  return {ErrorKind::unavailable,
          "This installation does not support AVIF images: gltfx was built without libavif."};
}

DecodeError no_openimageio() {
  return {ErrorKind::unavailable,
          "This installation has no decoder for such images: install the package "
          "gltfx-openimageio, or build gltfx where OpenImageIO is found."};
}

// Whichever worker would get the cutoff.
std::optional<DecodeError> flaw_of(const Resize& resize) {
  if (std::isfinite(resize.alpha_cutoff)) return std::nullopt;
  return DecodeError{ErrorKind::malformed, "The alpha cutoff is not a number."};
}

bool in_image_worker(ImageFormat format) {
  return format != ImageFormat::avif && !is_foreign(format);
}

Raster raster_of(const Image& image) {
  return {image.width, image.height, image.channels, image.bits};
}

// The result of `work`. Missing memory here is not an error of the payload.
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
        avif_images(avif_program, settings.workers, standstill_of(settings)),
        foreign_program(program_path(settings.folder, "gltfx-codec-openimageio")),
        foreign_images(foreign_program, settings.workers, standstill_of(settings)) {}

  /// The workers that decode a format.
  Pool& decoders_of(ImageFormat format) {
    if (is_foreign(format)) return foreign_images;
    return format == ImageFormat::avif ? avif_images : images;
  }
  std::optional<DecodeError> find_missing(ImageFormat format) const {
    if (format == ImageFormat::avif && !is_program(avif_program)) return noted(no_avif());
    if (is_foreign(format) && !is_program(foreign_program)) return noted(no_openimageio());
    return std::nullopt;
  }

  Settings settings;
  Pool meshes, images;
  std::string avif_program;
  Pool avif_images;
  std::string foreign_program;
  Pool foreign_images;
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
  const bool resized = request.pixels && request.resize.max_side != 0;
  if (auto flaw = flaw_of(request.resize); flaw && resized) return *std::move(flaw);
  if (auto missing = state_->find_missing(request.format)) return *std::move(missing);
  if (resized && !in_image_worker(request.format)) return resize_elsewhere(request);
  Job job = image_job(state_->settings, request);
  if (resized) add_resize(job, request.resize, request.max_pixels);
  ++work_count.decoded;
  return result_of<Image>(state_->decoders_of(request.format), job, request.bytes, request.origin,
                          request.pixels);
}

// For an image whose own worker does not resize.
ImageResult Client::resize_elsewhere(const ImageRequest& request) {
  ImageRequest whole = request;
  whole.resize = {};
  ImageResult decoded = decode_image(whole);
  const auto* image = std::get_if<Image>(&decoded);
  if (image == nullptr || !request.resize.needed(image->width, image->height)) return decoded;
  return resize_pixels(*image, request);
}

ImageResult Client::resize_pixels(const Image& image, const ImageRequest& request) {
  Job job = image_job(state_->settings, request);
  job.raster = raster_of(image);
  job.input_bytes = image.pixels.size();
  add_resize(job, request.resize, image.texels());
  ImageResult result = result_of<Image>(state_->images, job, image.pixels, request.origin, true);
  if (auto* resized = std::get_if<Image>(&result)) resized->doubt = image.doubt;
  return result;
}

EncodeResult Client::encode_image(const EncodeRequest& request) {
  Job job = limited_job(state_->settings, Task::encode, request.pixels.size());
  job.memory_bytes =
      request.pixels.size() * kEncoderMemoryPerByte + state_->settings.image_memory_bytes;
  job.raster = request.raster;
  job.encoded = request.format;
  job.quality = request.quality;
  job.options = request.options;
  if (!is_consistent(job)) {
    return DecodeError{ErrorKind::unsupported, "The format does not support such images."};
  }
  return result_of<EncodedImage>(state_->images, job, request.pixels, request.origin, true);
}

namespace {

// The whole image of a request, in its own size.
ImageRequest whole_image(const TranscodeRequest& request) {
  ImageRequest image = request.image;
  image.pixels = true;
  image.normals = false;
  image.level = image.halvings = 0;
  image.resize = {};
  return image;
}

void add_format(Job& job, const TranscodeRequest& request, std::uint64_t texels) {
  job.task = Task::transcode;
  job.encoded = request.format;
  job.quality = request.quality;
  job.options = request.options;
  add_encoding(job, texels);
}

}  // namespace

EncodeResult Client::transcode_image(const TranscodeRequest& request) {
  if (auto flaw = flaw_of(request.image.resize)) return *std::move(flaw);
  if (request.format == EncodedFormat::avif) return transcode_to_avif(request);
  const ImageRequest image = whole_image(request);
  std::span<const std::byte> payload = image.bytes;
  ImageResult decoded;
  Job job = image_job(state_->settings, image);
  std::uint64_t texels = std::min(image.max_pixels, kMostTexels);
  if (!in_image_worker(image.format)) {
    decoded = decode_image(image);
    if (auto* error = std::get_if<DecodeError>(&decoded)) return std::move(*error);
    const Image& whole = *std::get_if<Image>(&decoded);
    if (!whole.doubt.empty()) return DecodeError{ErrorKind::malformed, whole.doubt};
    job.raster = raster_of(whole);
    payload = whole.pixels;
    job.input_bytes = payload.size();
    texels = whole.texels();
  }
  add_resize(job, request.image.resize, texels);
  add_format(job, request, texels);
  if (!is_consistent(job)) {
    return DecodeError{ErrorKind::unsupported, "The format does not support this quality."};
  }
  return result_of<EncodedImage>(state_->images, job, payload, image.origin, true);
}

// The encoder of AVIF is in a program that neither decodes other formats nor resizes.
EncodeResult Client::transcode_to_avif(const TranscodeRequest& request) {
  if (auto missing = state_->find_missing(ImageFormat::avif)) return *std::move(missing);
  ImageRequest request_of_image = whole_image(request);
  ImageResult decoded = decode_image(request_of_image);
  if (auto* error = std::get_if<DecodeError>(&decoded)) return std::move(*error);
  const Raster source = raster_of(*std::get_if<Image>(&decoded));
  if (request.image.resize.needed(source.width, source.height)) {
    request_of_image.resize = request.image.resize;
    decoded = resize_pixels(*std::get_if<Image>(&decoded), request_of_image);
    if (auto* error = std::get_if<DecodeError>(&decoded)) return std::move(*error);
  }
  const Image& image = *std::get_if<Image>(&decoded);
  if (!image.doubt.empty()) return DecodeError{ErrorKind::malformed, image.doubt};
  Job job = limited_job(state_->settings, Task::transcode, image.pixels.size());
  job.raster = raster_of(image);
  job.max_pixels = image.texels();
  add_format(job, request, image.texels());
  if (!is_consistent(job)) {
    return DecodeError{ErrorKind::unsupported, "The format does not support this quality."};
  }
  EncodeResult result =
      result_of<EncodedImage>(state_->avif_images, job, image.pixels, request.image.origin, true);
  if (auto* encoded = std::get_if<EncodedImage>(&result)) encoded->source = source;
  return result;
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

// SPDX-License-Identifier: Apache-2.0
// gltfx-codec-image: decodes PNG, JPEG, WebP, KTX2, Radiance and EXR for gltfx and encodes all
// except KTX2 and Radiance. gltfx starts it and talks to it over a socket. Workers are forked from
// it: nothing that it links may start a thread.
#include <cstring>
#include <new>

#include "codec/server.hpp"
#include "image_decode.hpp"
#include "image_encode.hpp"

namespace gltfx::codec {

Answer hand_over(std::span<const std::byte> file, const Output& output) {
  const std::span<std::byte> to = output(file.size());
  if (to.size() < file.size() || file.empty()) throw std::bad_alloc();
  std::memcpy(to.data(), file.data(), file.size());
  EncodedImage image;
  image.size = file.size();
  return image;
}

namespace {

Answer decode(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  switch (job.format) {
    case ImageFormat::png:
      return decode_png(job, bytes, output);
    case ImageFormat::jpeg:
      return decode_jpeg(job, bytes, output);
    case ImageFormat::webp:
      return decode_webp(job, bytes, output);
    case ImageFormat::ktx2:
      return decode_ktx2(job, bytes, output);
    case ImageFormat::radiance:
      return decode_radiance(job, bytes, output);
    default:
      return decode_exr(job, bytes, output);
  }
}

Answer encode(const Job& job, std::span<const std::byte> texels, const Output& output) {
  switch (job.encoded) {
    case EncodedFormat::png:
      return encode_png(job, texels, output);
    case EncodedFormat::webp:
      return encode_webp(job, texels, output);
    case EncodedFormat::jpeg:
      return encode_jpeg(job, texels, output);
    default:
      return encode_exr(job, texels, output);
  }
}

Answer serve_job(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  return job.task == Task::encode ? encode(job, bytes, output) : decode(job, bytes, output);
}

}  // namespace
}  // namespace gltfx::codec

int main() {
  return gltfx::codec::serve([] {}, gltfx::codec::serve_job);
}

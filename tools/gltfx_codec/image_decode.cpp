// SPDX-License-Identifier: Apache-2.0
#include "image_decode.hpp"

#include <algorithm>
#include <new>

#include "base/checked.hpp"

namespace gltfx::codec {
namespace {

constexpr std::size_t kBandBytes = std::size_t{1} << 20U;

}  // namespace

Rows::Rows(const Image& image, const Job& job, std::span<std::byte> pixels)
    : image_(image),
      statistics_(image, job.normals),
      row_(std::size_t{image.width} * image.channels * (image.bits / 8)),
      rows_in_band_(std::clamp<std::size_t>(kBandBytes / row_, 1, image.height)),
      own_(pixels.empty() ? rows_in_band_ * row_ : 0),
      pixels_(pixels),
      band_(pixels.empty() ? own_.data() : pixels.data()) {}

std::byte* Rows::next() {
  if (filled_ == rows_in_band_) flush();
  return band_ + filled_++ * row_;
}

void Rows::flush() {
  statistics_.add({band_, filled_ * row_});
  if (!pixels_.empty()) band_ += filled_ * row_;
  filled_ = 0;
}

Image Rows::finish() {
  flush();
  statistics_.finish(image_);
  return image_;
}

DecodeError too_many_texels() { return {ErrorKind::too_large, "It exceeds the limit on texels."}; }

bool exceeds_memory(const Job& job, std::uint64_t texels, std::uint64_t bytes_per_texel) {
  const auto size = checked_mul(texels, bytes_per_texel);
  return !size || *size > job.memory_bytes;
}

DecodeError no_memory() { return {ErrorKind::out_of_memory, "Decoding exceeds the memory limit."}; }

std::span<std::byte> create_pixels(const Image& image, const Job& job, const Output& output) {
  if (!job.pixels) return {};
  const auto size = result_size(image);
  if (!size || *size > job.memory_bytes) throw std::bad_alloc();
  const std::span<std::byte> pixels = output(*size);
  if (pixels.size() < *size) throw std::bad_alloc();
  return pixels;
}

}  // namespace gltfx::codec

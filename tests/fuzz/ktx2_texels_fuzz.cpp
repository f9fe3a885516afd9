// SPDX-License-Identifier: Apache-2.0
// Any bytes are decoded as a KTX2 image, with little memory: there is an image of as many texels as
// its header says, or an error.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "codec/decode.hpp"
#include "image_decode.hpp"

namespace {

using namespace gltfx::codec;

void require(bool promise) {
  if (!promise) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Job job;
  job.task = Task::image;
  job.format = ImageFormat::ktx2;
  job.pixels = size % 2 == 0;
  job.normals = true;
  job.max_pixels = 1U << 16U;
  job.memory_bytes = 1U << 20U;
  std::vector<std::byte> pixels;
  const Output output = [&pixels](std::uint64_t bytes) {
    pixels.resize(static_cast<std::size_t>(bytes));
    return std::span<std::byte>(pixels);
  };
  const Answer answer =
      decode_safely(decode_ktx2, job, {reinterpret_cast<const std::byte*>(data), size}, output);
  if (const auto* error = std::get_if<DecodeError>(&answer)) {
    require(!error->message.empty() && error->message.back() == '.');
    return 0;
  }
  const Image& image = std::get<Image>(answer);
  require(image.texels() > 0 && image.texels() <= job.max_pixels);
  require(image.channels >= 1 && image.channels <= 4 && image.bits == 8);
  require(!job.pixels || pixels.size() == image.texels() * image.channels);
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
/// What the decoders of images share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "codec/server.hpp"
#include "codec/statistics.hpp"

namespace gltfx::codec {

/// That there are more texels than asked for.
DecodeError too_many_texels();

/// Whether so many texels take more memory than a job has.
bool exceeds_memory(const Job& job, std::uint64_t texels, std::uint64_t bytes_per_texel);
DecodeError no_memory();

/// Room for the pixels of `image` where they were asked for, else none. Throws std::bad_alloc.
std::span<std::byte> create_pixels(const Image& image, const Job& job, const Output& output);

/// Takes the rows of an image from the top, band by band: no image is held for its statistics.
class Rows {
 public:
  /// With `pixels` the rows go there.
  Rows(const Image& image, const Job& job, std::span<std::byte> pixels);

  /// Where the next row goes. The row before it has been written.
  std::byte* next();
  /// The image with its statistics. Precondition: all rows have been written.
  Image finish();

 private:
  void flush();

  Image image_;
  Statistics statistics_;
  std::size_t row_;
  std::size_t rows_in_band_;
  std::vector<std::byte> own_;  ///< one band, where there are no pixels
  std::span<std::byte> pixels_;
  std::byte* band_;
  std::size_t filled_ = 0;  ///< rows of the band
};

// Each decodes one format. May throw std::exception, which becomes an error.

Answer decode_png(const Job& job, std::span<const std::byte> bytes, const Output& output);
Answer decode_jpeg(const Job& job, std::span<const std::byte> bytes, const Output& output);
Answer decode_webp(const Job& job, std::span<const std::byte> bytes, const Output& output);
Answer decode_ktx2(const Job& job, std::span<const std::byte> bytes, const Output& output);
Answer decode_radiance(const Job& job, std::span<const std::byte> bytes, const Output& output);
Answer decode_exr(const Job& job, std::span<const std::byte> bytes, const Output& output);

}  // namespace gltfx::codec

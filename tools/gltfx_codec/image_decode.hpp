// SPDX-License-Identifier: Apache-2.0
/// Code shared by the decoders of images.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "codec/server.hpp"
#include "codec/statistics.hpp"

namespace gltfx::codec {

/// The error for an image with too many texels.
DecodeError too_many_texels();

/// Whether this number of texels takes more memory than the job has.
bool exceeds_memory(const Job& job, std::uint64_t texels, std::uint64_t bytes_per_texel);
DecodeError no_memory();

/// Memory for the pixels of `image` if requested, otherwise none. Throws std::bad_alloc.
std::span<std::byte> create_pixels(const Image& image, const Job& job, const Output& output);

/// Takes the rows of an image from the top, in bands, so that statistics do not need the whole
/// image.
class Rows {
 public:
  /// The rows go to `pixels`, unless it is empty.
  Rows(const Image& image, const Job& job, std::span<std::byte> pixels);

  /// Memory of the next row. Precondition: the previous row has been written.
  std::byte* next();
  /// The image with its statistics. Precondition: all rows have been written.
  Image finish();

 private:
  void flush();

  Image image_;
  Statistics statistics_;
  std::size_t row_;
  std::size_t rows_in_band_;
  std::vector<std::byte> own_;  ///< one band, if there are no pixels
  std::span<std::byte> pixels_;
  std::byte* band_;
  std::size_t filled_ = 0;  ///< number of rows in the band
};

// Each function decodes one format. May throw std::exception, which becomes an error.

Answer decode_png(const Job& job, std::span<const std::byte> bytes, const Output& output);
Answer decode_jpeg(const Job& job, std::span<const std::byte> bytes, const Output& output);
Answer decode_webp(const Job& job, std::span<const std::byte> bytes, const Output& output);
Answer decode_ktx2(const Job& job, std::span<const std::byte> bytes, const Output& output);
Answer decode_radiance(const Job& job, std::span<const std::byte> bytes, const Output& output);
Answer decode_exr(const Job& job, std::span<const std::byte> bytes, const Output& output);

}  // namespace gltfx::codec

// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <bit>
#include <csetjmp>
#include <new>
#include <vector>

#include <png.h>

#include "image_encode.hpp"

namespace gltfx::codec {
namespace {

constexpr std::array<int, 5> kColorType{0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                        PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};

// libpng reports a failure by a jump, over frames that have nothing to destroy.
[[noreturn]] void fail(png_structp png, png_const_charp /*message*/) { png_longjmp(png, 1); }
void ignore(png_structp /*png*/, png_const_charp /*message*/) {}
void flush(png_structp /*png*/) {}

void append(png_structp png, png_bytep bytes, std::size_t size) {
  auto& file = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
  bool fits = true;
  try {
    const auto* begin = reinterpret_cast<const std::byte*>(bytes);
    file.insert(file.end(), begin, begin + size);
  } catch (const std::bad_alloc&) {
    fits = false;
  }
  if (!fits) png_error(png, "");
}

class PngEncoder {
 public:
  PngEncoder()
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ != nullptr) return;
    png_destroy_write_struct(&png_, nullptr);
    throw std::bad_alloc();
  }
  ~PngEncoder() { png_destroy_write_struct(&png_, &info_); }
  PngEncoder(const PngEncoder&) = delete;
  PngEncoder& operator=(const PngEncoder&) = delete;

  bool encode(const Raster& raster, std::span<const std::byte> texels) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    write(raster, texels);
    return true;
  }
  std::span<const std::byte> file() const { return file_; }

 private:
  void write(const Raster& raster, std::span<const std::byte> texels) {
    png_set_write_fn(png_, &file_, append, flush);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_IHDR(png_, info_, raster.width, raster.height, static_cast<int>(raster.bits),
                 kColorType[raster.channels], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE,
                 PNG_FILTER_TYPE_BASE);
    png_write_info(png_, info_);
    if (raster.bits == 16 && std::endian::native == std::endian::little) png_set_swap(png_);
    const std::size_t row = texels.size() / raster.height;
    for (std::size_t at = 0; at < texels.size(); at += row) {
      png_write_row(png_, reinterpret_cast<png_const_bytep>(texels.data() + at));
    }
    png_write_end(png_, nullptr);
  }

  png_structp png_;
  png_infop info_;
  std::vector<std::byte> file_;
};

}  // namespace

Answer encode_png(const Job& job, std::span<const std::byte> texels, Output& output) {
  PngEncoder encoder;
  if (!encoder.encode(job.raster, texels)) throw std::bad_alloc();
  return hand_over(encoder.file(), output);
}

}  // namespace gltfx::codec

// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include <png.h>
#include <zlib.h>

#include "image_decode.hpp"
#include "image_encode.hpp"

namespace gltfx::codec {
namespace {

// An interlaced image is kept as a whole.
constexpr std::uint64_t kBytesPerTexel = 8;

/// The input of libpng, and its error message.
struct Source {
  std::span<const std::byte> rest;
  char message[160] = {};
};

// libpng reports a failure by a jump over frames without destructors.
[[noreturn]] void fail(png_structp png, png_const_charp message) {
  auto* source = static_cast<Source*>(png_get_error_ptr(png));  // null while a file is written
  if (source != nullptr) std::strncpy(source->message, message, sizeof source->message - 1);
  png_longjmp(png, 1);
}
void ignore(png_structp /*png*/, png_const_charp /*message*/) {}

void read(png_structp png, png_bytep to, std::size_t size) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (source.rest.size() < size) png_error(png, "Its data is truncated.");
  std::memcpy(to, source.rest.data(), size);
  source.rest = source.rest.subspan(size);
}

class PngDecoder {
 public:
  explicit PngDecoder(std::span<const std::byte> bytes)
      : source_{bytes},
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, fail, ignore)),
        info_(png_ == nullptr ? nullptr : png_create_info_struct(png_)) {
    if (info_ != nullptr) return;
    png_destroy_read_struct(&png_, nullptr, nullptr);
    throw std::bad_alloc();
  }
  ~PngDecoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;

  // Each of these is false if libpng fails.
  bool read_header(Image& image) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    header(image);
    return true;
  }
  bool read_rows(Rows& rows, std::uint32_t height) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    for (std::uint32_t y = 0; y < height; ++y) png_read_row(png_, byte(rows.next()), nullptr);
    return true;
  }
  bool read_interlaced(std::byte* texels, std::uint32_t height) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    const std::size_t row = png_get_rowbytes(png_, info_);
    for (int pass = 0; pass < passes_; ++pass) {
      for (std::uint32_t y = 0; y < height; ++y) {
        png_read_row(png_, byte(texels + y * row), nullptr);
      }
    }
    png_read_end(png_, nullptr);  // checks the data after the last pass
    return true;
  }

  bool interlaced() const { return passes_ > 1; }
  std::string message() const { return source_.message; }

 private:
  static png_bytep byte(std::byte* at) { return reinterpret_cast<png_bytep>(at); }

  // Palettes and transparent colours are resolved, and less than 8 bits become 8. Gamma and colour
  // profiles are ignored.
  void header(Image& image) {
    png_set_read_fn(png_, &source_, read);
    png_read_info(png_, info_);
    png_set_expand(png_);
    if (std::endian::native == std::endian::little) png_set_swap(png_);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    image.width = png_get_image_width(png_, info_);
    image.height = png_get_image_height(png_, info_);
    image.channels = png_get_channels(png_, info_);
    image.bits = png_get_bit_depth(png_, info_);
  }

  Source source_;
  png_structp png_;
  png_infop info_;
  int passes_ = 1;
};

Answer interlaced(PngDecoder& decoder, Image image, const Job& job, std::span<std::byte> pixels) {
  std::vector<std::byte> own;
  if (pixels.empty()) {
    own.resize(static_cast<std::size_t>(image.texels() * image.channels * (image.bits / 8)));
    pixels = own;
  }
  if (!decoder.read_interlaced(pixels.data(), image.height)) {
    return DecodeError{ErrorKind::malformed, decoder.message()};
  }
  Statistics statistics(image, job.normals);
  statistics.add(pixels);
  statistics.finish(image);
  return image;
}

constexpr std::array<int, 5> kColorType{0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                        PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGB_ALPHA};

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

/// How libpng compresses: the filters that it tries on each row, and the level and strategy of
/// zlib. The defaults of the latter two are libpng's.
struct Packing {
  int level = 0;
  int filters = PNG_ALL_FILTERS;
  int strategy = Z_FILTERED;
};
// Files are 2 % larger than with zlib's usual level 6, in less than half of the time.
constexpr Packing kQuick{4};
// None of them is always the best. Another strategy with filters is never much better.
constexpr std::array kSmallest{kQuick, Packing{9}, Packing{9, PNG_FILTER_NONE, Z_DEFAULT_STRATEGY}};

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

  bool encode(const Raster& raster, std::span<const std::byte> texels, const Packing& packing) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    write(raster, texels, packing);
    return true;
  }
  std::vector<std::byte>& file() { return file_; }

 private:
  void write(const Raster& raster, std::span<const std::byte> texels, const Packing& packing) {
    png_set_write_fn(png_, &file_, append, flush);
    png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_compression_level(png_, packing.level);
    png_set_filter(png_, PNG_FILTER_TYPE_BASE, packing.filters);
    png_set_compression_strategy(png_, packing.strategy);
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

Answer decode_png(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  PngDecoder decoder(bytes);
  Image image;
  if (!decoder.read_header(image)) return DecodeError{ErrorKind::malformed, decoder.message()};
  if (image.texels() > job.max_pixels) return too_many_texels();
  if (decoder.interlaced() && exceeds_memory(job, image.texels(), kBytesPerTexel)) {
    return no_memory();
  }
  const std::span<std::byte> pixels = create_pixels(image, job, output);
  if (decoder.interlaced()) return interlaced(decoder, std::move(image), job, pixels);
  Rows rows(image, job, pixels);
  if (!decoder.read_rows(rows, image.height)) {
    return DecodeError{ErrorKind::malformed, decoder.message()};
  }
  return rows.finish();
}

Answer encode_png(const Job& job, std::span<const std::byte> texels, const Output& output) {
  const std::span<const Packing> packings =
      job.options.smallest ? std::span<const Packing>(kSmallest) : std::span(&kQuick, 1);
  std::vector<std::byte> best;
  for (const Packing& packing : packings) {
    PngEncoder encoder;
    if (!encoder.encode(job.raster, texels, packing)) throw std::bad_alloc();
    if (best.empty() || encoder.file().size() < best.size()) best = std::move(encoder.file());
  }
  return hand_over(best, output);
}

}  // namespace gltfx::codec

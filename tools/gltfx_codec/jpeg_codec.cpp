// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include <jerror.h>
#include <jpeglib.h>

#include "image_decode.hpp"
#include "image_encode.hpp"

namespace gltfx::codec {
namespace {

/// Messages of libjpeg. The first member is its own type.
struct Messages {
  jpeg_error_mgr manager;
  std::jmp_buf failed;
  char first[JMSG_LENGTH_MAX];  ///< the first message; empty: none
};

Messages& messages_of(j_common_ptr jpeg) { return *reinterpret_cast<Messages*>(jpeg->err); }

void note(j_common_ptr jpeg) {
  Messages& messages = messages_of(jpeg);
  if (messages.first[0] == '\0') messages.manager.format_message(jpeg, messages.first);
}

// libjpeg reports a failure by a jump over frames without destructors.
[[noreturn]] void fail(j_common_ptr jpeg) {
  note(jpeg);
  std::longjmp(messages_of(jpeg).failed, 1);
}

// libjpeg stores this pointer, and its interface does not use const.
unsigned char* data_of(std::span<const std::byte> bytes) {
  return reinterpret_cast<unsigned char*>(const_cast<std::byte*>(bytes.data()));
}

// Adobe's programs store the complement of each ink.
void convert_inks(const unsigned char* inks, std::size_t count, unsigned char* rgb) {
  for (std::size_t i = 0; i < count; ++i, inks += 4, rgb += 3) {
    for (int c = 0; c < 3; ++c) {
      rgb[c] = static_cast<unsigned char>((unsigned{inks[c]} * inks[3] + 127) / 255);
    }
  }
}

// Each scan of a JPEG processes the whole image, but takes only a dozen bytes. Encoders write ten
// scans.
constexpr std::size_t kMostScans = 500;

// In compressed data a byte 0xFF is followed by 0 or by a marker without a segment.
std::size_t count_scans(std::span<const std::byte> bytes) {
  const auto at = [&](std::size_t i) { return std::to_integer<unsigned>(bytes[i]); };
  std::size_t scans = 0;
  for (std::size_t i = 0; i + 3 < bytes.size();) {
    const void* const found = std::memchr(bytes.data() + i, 0xFF, bytes.size() - i);
    if (found == nullptr) break;
    i = static_cast<std::size_t>(static_cast<const std::byte*>(found) - bytes.data()) + 1;
    if (i + 2 >= bytes.size() || at(i) == 0xFF) continue;
    const unsigned marker = at(i);
    if (marker <= 0x01 || (marker >= 0xD0 && marker <= 0xD9)) continue;
    if (marker == 0xDA) ++scans;
    i += 1 + std::max(at(i + 1) * 256 + at(i + 2), 2U);
  }
  return scans;
}

class JpegDecoder {
 public:
  JpegDecoder() {
    jpeg_.err = jpeg_std_error(&messages_.manager);
    messages_.manager.error_exit = fail;
    messages_.manager.output_message = note;
  }
  ~JpegDecoder() { jpeg_destroy_decompress(&jpeg_); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  // Each of these is false if libjpeg fails.
  bool read_header(std::span<const std::byte> bytes, unsigned halvings, Image& image) {
    if (setjmp(messages_.failed) != 0) return false;
    header(bytes, halvings, image);
    return true;
  }
  bool read_rows(Rows& rows) {
    if (inks()) row_.resize(std::size_t{jpeg_.image_width} * 4);
    if (setjmp(messages_.failed) != 0) return false;
    jpeg_start_decompress(&jpeg_);
    while (jpeg_.output_scanline < jpeg_.output_height) read_row(rows.next());
    return true;
  }

  std::string message() const { return messages_.first; }
  DecodeError error() const {
    if (messages_.manager.msg_code == JERR_OUT_OF_MEMORY) return no_memory();
    return {ErrorKind::malformed, message()};
  }

 private:
  bool inks() const { return jpeg_.out_color_space == JCS_CMYK; }

  // Reduced images use only the lowest frequencies.
  void header(std::span<const std::byte> bytes, unsigned halvings, Image& image) {
    jpeg_create_decompress(&jpeg_);
    jpeg_mem_src(&jpeg_, data_of(bytes), bytes.size());
    jpeg_read_header(&jpeg_, TRUE);
    jpeg_.scale_denom = 1U << halvings;
    jpeg_calc_output_dimensions(&jpeg_);
    image.width = jpeg_.output_width;
    image.height = jpeg_.output_height;
    image.channels = inks() ? 3 : static_cast<std::uint32_t>(jpeg_.output_components);
  }

  void read_row(std::byte* to) {
    auto* texels = reinterpret_cast<JSAMPROW>(to);
    JSAMPROW row = inks() ? row_.data() : texels;
    jpeg_read_scanlines(&jpeg_, &row, 1);
    if (inks()) convert_inks(row, jpeg_.output_width, texels);
  }

  Messages messages_{};
  jpeg_decompress_struct jpeg_{};
  std::vector<unsigned char> row_;
};

class JpegEncoder {
 public:
  JpegEncoder() {
    jpeg_.err = jpeg_std_error(&messages_.manager);
    messages_.manager.error_exit = fail;
    messages_.manager.output_message = note;
  }
  ~JpegEncoder() {
    jpeg_destroy_compress(&jpeg_);
    std::free(file_);  // NOLINT(cppcoreguidelines-no-malloc): libjpeg's
  }
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  bool encode(const Job& job, std::span<const std::byte> texels) {
    if (setjmp(messages_.failed) != 0) return false;
    write(job, texels);
    return true;
  }
  std::span<const std::byte> file() const { return std::as_bytes(std::span(file_, size_)); }

 private:
  void write(const Job& job, std::span<const std::byte> texels) {
    const Raster& raster = job.raster;
    jpeg_create_compress(&jpeg_);
    jpeg_mem_dest(&jpeg_, &file_, &size_);
    jpeg_.image_width = raster.width;
    jpeg_.image_height = raster.height;
    jpeg_.input_components = static_cast<int>(raster.channels);
    jpeg_.in_color_space = raster.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&jpeg_);
    jpeg_set_quality(&jpeg_, static_cast<int>(job.quality), TRUE);
    if (raster.channels == 3) {
      jpeg_.comp_info[0].h_samp_factor = jpeg_.comp_info[0].v_samp_factor =
          job.options.subsampled ? 2 : 1;
    }
    jpeg_.optimize_coding = job.options.smallest ? TRUE : FALSE;
    jpeg_start_compress(&jpeg_, TRUE);
    const std::size_t size = std::size_t{raster.width} * raster.channels;
    for (std::size_t at = 0; at < texels.size(); at += size) {
      // the interface of libjpeg does not use const
      auto* row = reinterpret_cast<JSAMPROW>(const_cast<std::byte*>(texels.data() + at));
      jpeg_write_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_compress(&jpeg_);
  }

  Messages messages_{};
  jpeg_compress_struct jpeg_{};
  unsigned char* file_ = nullptr;
  unsigned long size_ = 0;
};

}  // namespace

Answer decode_jpeg(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  JpegDecoder decoder;
  Image image;
  if (!decoder.read_header(bytes, job.halvings, image)) return decoder.error();
  if (image.channels < 1 || image.channels > 4) {
    return DecodeError{ErrorKind::malformed, "It has more than 4 channels."};
  }
  if (image.texels() > job.max_pixels) return too_many_texels();
  if (const std::size_t scans = count_scans(bytes); scans > kMostScans) {
    return DecodeError{ErrorKind::timed_out, "It has " + std::to_string(scans) +
                                                 " scans; more than " + std::to_string(kMostScans) +
                                                 " take too long to decode."};
  }
  Rows rows(image, job, create_pixels(image, job, output));
  if (!decoder.read_rows(rows)) return decoder.error();
  Image result = rows.finish();
  result.doubt = decoder.message();
  return result;
}

Answer encode_jpeg(const Job& job, std::span<const std::byte> texels, const Output& output) {
  if (job.raster.width > JPEG_MAX_DIMENSION || job.raster.height > JPEG_MAX_DIMENSION) {
    return DecodeError{ErrorKind::unsupported, "JPEG is limited to 65500 texels per side."};
  }
  JpegEncoder encoder;
  if (!encoder.encode(job, texels)) throw std::bad_alloc();
  return hand_over(encoder.file(), output);
}

}  // namespace gltfx::codec

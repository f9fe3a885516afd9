// SPDX-License-Identifier: Apache-2.0
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <new>

#include <jpeglib.h>

#include "image_encode.hpp"

namespace gltfx::codec {
namespace {

struct Failure {
  jpeg_error_mgr manager;  ///< first: libjpeg knows it only
  std::jmp_buf jump;
};

// libjpeg reports a failure by a jump, over frames that have nothing to destroy.
[[noreturn]] void fail(j_common_ptr jpeg) {
  std::longjmp(reinterpret_cast<Failure*>(jpeg->err)->jump, 1);
}
void ignore(j_common_ptr /*jpeg*/) {}

class JpegEncoder {
 public:
  JpegEncoder() {
    jpeg_.err = jpeg_std_error(&failure_.manager);
    failure_.manager.error_exit = fail;
    failure_.manager.output_message = ignore;
  }
  ~JpegEncoder() {
    jpeg_destroy_compress(&jpeg_);
    std::free(file_);  // NOLINT(cppcoreguidelines-no-malloc): libjpeg's
  }
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  bool encode(const Job& job, std::span<const std::byte> texels) {
    if (setjmp(failure_.jump) != 0) return false;
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
    jpeg_start_compress(&jpeg_, TRUE);
    const std::size_t size = std::size_t{raster.width} * raster.channels;
    for (std::size_t at = 0; at < texels.size(); at += size) {
      // libjpeg has no const in its interface.
      auto* row = reinterpret_cast<JSAMPROW>(const_cast<std::byte*>(texels.data() + at));
      jpeg_write_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_compress(&jpeg_);
  }

  Failure failure_{};
  jpeg_compress_struct jpeg_{};
  unsigned char* file_ = nullptr;
  unsigned long size_ = 0;
};

}  // namespace

Answer encode_jpeg(const Job& job, std::span<const std::byte> texels, Output& output) {
  if (job.raster.width > JPEG_MAX_DIMENSION || job.raster.height > JPEG_MAX_DIMENSION) {
    return DecodeError{ErrorKind::malformed, "JPEG holds no more than 65500 texels a side."};
  }
  JpegEncoder encoder;
  if (!encoder.encode(job, texels)) throw std::bad_alloc();
  return hand_over(encoder.file(), output);
}

}  // namespace gltfx::codec

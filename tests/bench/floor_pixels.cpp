// SPDX-License-Identifier: Apache-2.0
// Floor of a look at every pixel: maps a GLB and decodes every PNG in it.
//
//   floor_pixels FILE.glb THREADS
#include <string_view>
#include <vector>

#include <png.h>

#include "embedded.hpp"

namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";

bool decode(std::string_view bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return false;
  std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
  return png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) != 0;
}

}  // namespace

int main(int argc, char** argv) { return gltfx::bench::decode_all(argc, argv, kSignature, decode); }

// SPDX-License-Identifier: Apache-2.0
// Floor of an upgrade with new images: parses every .gltf below a folder, decodes the first PNG
// that it names, puts its red into the alpha of white texels, and encodes that.
//
//   floor_upgrade FOLDER
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <png.h>

#include "json/parse.hpp"

namespace {

namespace fs = std::filesystem;

std::string read_all(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t repack(const std::string& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return 0;
  image.format = PNG_FORMAT_RGB;
  std::vector<png_byte> texels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, texels.data(), 0, nullptr) == 0) return 0;
  std::vector<png_byte> packed(texels.size() / 3 * 4, png_byte{255});
  for (std::size_t i = 0; i < texels.size() / 3; ++i) packed[i * 4 + 3] = texels[i * 3];
  image.format = PNG_FORMAT_RGBA;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<png_byte> file(size);
  return png_image_write_to_memory(&image, file.data(), &size, 0, packed.data(), 0, nullptr) != 0
             ? size
             : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  for (const auto& entry : fs::directory_iterator(argv[1])) {
    if (entry.path().extension() != ".gltf") continue;
    const std::string text = read_all(entry.path());
    const gltfx::json::Parsed parsed = gltfx::json::parse(std::string_view(text));
    const gltfx::json::NodeId uri = parsed.document.resolve("/images/0/uri");
    if (uri == gltfx::json::kNoNode) return 3;
    if (repack(read_all(entry.path().parent_path() / parsed.document.string(uri))) == 0) return 1;
  }
  return 0;
}

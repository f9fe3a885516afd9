// SPDX-License-Identifier: Apache-2.0
#include "image/gpu_memory.hpp"

#include <algorithm>
#include <variant>

#include "base/checked.hpp"

namespace gltfx::image {
namespace {

// The texels of an image and of all smaller levels down to one texel.
std::uint64_t texels_of_levels(std::uint64_t width, std::uint64_t height) {
  std::uint64_t sum = 0;
  for (;; width = std::max<std::uint64_t>(width / 2, 1),
          height = std::max<std::uint64_t>(height / 2, 1)) {
    sum = saturating_add(sum, width * height);
    if (width <= 1 && height <= 1) return sum;
  }
}

}  // namespace

std::uint64_t gpu_bytes(const Header& header) {
  return checked_mul(texels_of_levels(header.width, header.height), 4).value_or(UINT64_MAX);
}

std::uint64_t gpu_bytes(const Ktx2& file) {
  const std::uint64_t height = std::max(file.height, 1U);
  const std::uint64_t count =
      file.level_count == 1 ? file.width * height : texels_of_levels(file.width, height);
  const bool alpha = file.contents && has_alpha(*file.contents);
  if (file.model == Ktx2Model::etc1s) return alpha ? count : count / 2;
  if (file.model == Ktx2Model::uastc) return count;
  std::uint64_t sum = 0;
  for (const Ktx2Level& level : file.levels) {
    sum = saturating_add(sum, std::max(level.uncompressed, level.length));
  }
  return sum;
}

std::uint64_t gpu_bytes(std::span<const std::byte> file) {
  const Sniffed sniffed = sniff(file);
  if (sniffed.known && sniffed.format == Format::ktx2) return gpu_bytes(read_ktx2(file));
  const HeaderResult header = read_header(file);
  const auto* found = std::get_if<Header>(&header);
  return found == nullptr ? 0 : gpu_bytes(*found);
}

}  // namespace gltfx::image

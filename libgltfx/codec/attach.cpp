// SPDX-License-Identifier: Apache-2.0
// The layout of a result in the memory that a worker has filled.
#include <algorithm>

#include "base/checked.hpp"
#include "codec/protocol.hpp"

namespace gltfx::codec {

unsigned component_size(Component component) {
  switch (component) {
    case Component::int8:
    case Component::uint8:
      return 1;
    case Component::int16:
    case Component::uint16:
      return 2;
    case Component::int32:
    case Component::uint32:
    case Component::float32:
      return 4;
    case Component::other:
      break;
  }
  return 0;
}

std::optional<std::uint64_t> result_size(const DracoMesh& mesh) {
  // 32 bits times 12, and 32 bits times 255 times 4 for each of a thousand: the sum fits into 64
  // bits.
  std::uint64_t end = (std::uint64_t{mesh.faces} * 12 + 7) / 8 * 8;
  if (mesh.attributes.size() > kMostAttributes) return std::nullopt;
  for_each_values(mesh, [&](std::uint64_t offset, std::uint64_t size) { end = offset + size; });
  return end;
}

std::optional<std::uint64_t> result_size(const Image& image) {
  return checked_mul(image.texels(), std::uint64_t{image.channels} * (image.bits / 8));
}

std::optional<std::uint64_t> result_size(const EncodedImage& image) { return image.size; }

bool attach(DracoMesh& mesh, std::span<const std::byte> memory) {
  const auto wanted = result_size(mesh);
  const auto address = reinterpret_cast<std::uintptr_t>(memory.data());
  if (!wanted || *wanted > memory.size() || address % alignof(std::uint32_t) != 0) return false;
  mesh.indices = {reinterpret_cast<const std::uint32_t*>(memory.data()),
                  std::size_t{mesh.faces} * 3};
  std::uint32_t greatest = 0;
  for (const std::uint32_t index : mesh.indices) greatest = std::max(greatest, index);
  if (mesh.faces != 0 && greatest >= mesh.points) return false;
  auto attribute = mesh.attributes.begin();
  for_each_values(mesh, [&](std::uint64_t offset, std::uint64_t size) {
    attribute->values =
        memory.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
    ++attribute;
  });
  return true;
}

bool attach(Image& image, std::span<const std::byte> memory) {
  const auto wanted = result_size(image);
  if (!wanted || *wanted > memory.size()) return false;
  image.pixels = memory.first(static_cast<std::size_t>(*wanted));
  return true;
}

bool attach(EncodedImage& image, std::span<const std::byte> memory) {
  if (image.size > memory.size()) return false;
  image.bytes = memory.first(static_cast<std::size_t>(image.size));
  return true;
}

}  // namespace gltfx::codec

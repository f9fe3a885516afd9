// SPDX-License-Identifier: Apache-2.0
#include "steps/stored_size.hpp"

#include <string>
#include <string_view>

#include "change/companions.hpp"
#include "change/rewrite.hpp"

namespace gltfx::steps {

std::uint64_t stored_size(const model::OpenedAsset& asset) {
  const container::Container& container = asset.container();
  const std::string_view json = container.json ? *container.json : std::string_view();
  std::uint64_t bytes = json.size();
  if (container.glb_version == 3U) {
    const auto file = container.json && !change::find_glb_obstacle(container)
                          ? change::rewrite(container)
                          : std::vector{container.bytes};
    if (file) bytes = container::size_of(*file);
  } else if (container.format == container::Format::glb) {
    constexpr std::uint64_t kHeader = 12, kChunkHeader = 8, kWord = 4;
    const std::uint64_t words = (change::without_padding(json).size() + kWord - 1) / kWord;
    bytes = kHeader + kChunkHeader + words * kWord;
    for (std::size_t i = 1; i < container.chunks.size(); ++i) {
      bytes += kChunkHeader + container.chunks[i].length;
    }
  }
  for (const std::string& path : change::referred_paths(asset.document())) {
    std::uint64_t size = 0;
    if (asset.resolver().stat(path, size) == container::ResolveError::none) bytes += size;
  }
  return bytes;
}

}  // namespace gltfx::steps

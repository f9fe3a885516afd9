// SPDX-License-Identifier: Apache-2.0
#include "container/memory_asset.hpp"

#include <utility>

namespace gltfx::container {

Container open_memory(std::string bytes, const std::string& name, AssetFormat format) {
  Bytes kept = Bytes::from_string(std::move(bytes));
  if (format == AssetFormat::detect) return open_bytes(std::move(kept), name);
  return open_bytes(std::move(kept), format == AssetFormat::glb ? Format::glb : Format::gltf);
}

Resolver resolver_of(MemoryAsset&& asset, const std::string& root) {
  Resolver resolver;
  if (asset.read) {
    const auto found = [read = asset.read](const std::string& uri) -> std::optional<Bytes> {
      auto bytes = read(uri);
      if (!bytes) return std::nullopt;
      return Bytes::from_string(*std::move(bytes));
    };
    resolver = Resolver(
        found, asset.names == MemoryAsset::Names::uris ? ReadNames::uris : ReadNames::paths);
  } else if (!root.empty()) {
    resolver = Resolver(root, root);
  }
  for (auto& [path, bytes] : asset.files) resolver.add(path, Bytes::from_string(std::move(bytes)));
  return resolver;
}

}  // namespace gltfx::container

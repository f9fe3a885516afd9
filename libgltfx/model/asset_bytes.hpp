// SPDX-License-Identifier: Apache-2.0
/// The bytes of the buffers and images of an asset, read at first use.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

#include "base/result.hpp"
#include "container/container.hpp"
#include "container/opened_files.hpp"
#include "container/resolver.hpp"
#include "model/asset.hpp"

namespace gltfx::model {

/// The place of the bytes of a buffer or image. A buffer of version 2.1 may name any BIN chunk.
enum class Storage : std::uint8_t { nowhere, file, data_uri, buffer_view, bin_chunk };

/// Keeps references to all constructor arguments. Not thread-safe.
class AssetBytes {
 public:
  AssetBytes(const Asset& asset, const container::Container& container,
             const container::Resolver& resolver)
      : asset_(asset), container_(container), files_(resolver) {}

  const Asset& asset() const { return asset_; }
  const Origin& origin() const { return files_.resolver().origin(); }
  /// The bytes of an element of the root's images or buffers, or a sentence about why there are
  /// none. A buffer may have fewer bytes than it declares.
  Result<container::Bytes> image(std::uint64_t index);
  Result<container::Bytes> buffer(std::uint64_t index);
  /// The bytes of the buffer view that a member `bufferView` of `object` names, likewise.
  Result<container::Bytes> view_of(json::NodeId object);
  /// The first reason why an existing file could not be read; empty: none.
  const std::string& trouble() const { return trouble_; }
  Storage image_storage(std::uint64_t index) const;
  Storage buffer_storage(std::uint64_t index) const;
  /// The BIN chunk of a buffer without a URI; nothing: it has none.
  std::optional<container::Chunk> buffer_chunk(std::uint64_t index) const;
  /// The URI, as written, of the file with an image or with the buffer of its buffer view; empty if
  /// there is none.
  std::string image_file_uri(std::uint64_t index) const;

 private:
  json::NodeId element(RootArray array, std::uint64_t index) const;
  Result<container::Bytes> fetch(const std::string& uri);
  std::uint64_t buffer_of(json::NodeId image) const;

  const Asset& asset_;
  const container::Container& container_;
  container::OpenedFiles files_;
  std::string trouble_;
  std::unordered_map<std::uint64_t, container::Bytes> buffers_;  ///< those used so far
};

}  // namespace gltfx::model

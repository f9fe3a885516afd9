// SPDX-License-Identifier: Apache-2.0
/// The bytes of the buffers and images of an asset, read when they are asked for.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

#include "base/result.hpp"
#include "container/container.hpp"
#include "container/resolver.hpp"
#include "model/asset.hpp"

namespace gltfx::model {

/// Where the bytes of a buffer or image stand.
enum class Storage : std::uint8_t { nowhere, file, data_uri, buffer_view, bin_chunk };

/// Keeps references to all it is made of. Not thread-safe.
class AssetBytes {
 public:
  AssetBytes(const Asset& asset, const container::Container& container,
             const container::Resolver& resolver)
      : asset_(asset), container_(container), resolver_(resolver) {}

  const Asset& asset() const { return asset_; }
  const Origin& origin() const { return resolver_.origin(); }
  /// The bytes of an element of the root's images or buffers, or a sentence about why there are
  /// none. Those of a buffer may be fewer than it says.
  Result<container::Bytes> image(std::uint64_t index);
  Result<container::Bytes> buffer(std::uint64_t index);
  /// Why a file that is there could not be read, the first time that happened; empty: it did not.
  const std::string& trouble() const { return trouble_; }
  Storage image_storage(std::uint64_t index) const;
  Storage buffer_storage(std::uint64_t index) const;
  /// The URI of the file that an image stands in or that its buffer view leads to, as written;
  /// empty where there is none.
  std::string image_file_uri(std::uint64_t index) const;

 private:
  json::NodeId element(RootArray array, std::uint64_t index) const;
  Result<container::Bytes> fetch(const std::string& uri);
  Result<container::Bytes> view_bytes(json::NodeId image);
  std::uint64_t buffer_of(json::NodeId image) const;

  const Asset& asset_;
  const container::Container& container_;
  const container::Resolver& resolver_;
  std::string trouble_;
  std::unordered_map<std::uint64_t, container::Bytes> buffers_;  ///< those that were asked for
};

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
/// @file
/// Assets in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace gltfx {

/// Gives the bytes of a resource by the URI that an asset names it with, as reports print it;
/// nothing when there are none. It may be called more than once for a URI, and must give the same
/// each time. Threads may call it at once unless `jobs` of the options is 1.
using ReadResource = std::function<std::optional<std::string>(const std::string& uri)>;

/// The format of an asset in memory; `detect`: the one that its first bytes have.
enum class AssetFormat : std::uint8_t { detect, gltf, glb };

/// An asset in memory, with the files that it refers to.
struct MemoryAsset {
  std::string bytes;                         ///< of the .gltf or .glb itself
  std::string name;                          ///< as the report names it
  AssetFormat format = AssetFormat::detect;  ///< of `bytes`
  /// Gives the resources that are not in `files`. Empty: there are no others, or they come from the
  /// folder `root` of the options if the call has one.
  ReadResource read = {};
  /// Forms of the names of resources.
  enum class Names : std::uint8_t {
    uris,   ///< URIs as reports print them, absolute ones too
    paths,  ///< decoded paths below the folder of the asset; what leads out of it is refused
  };
  Names names = Names::uris;  ///< the argument of `read`
  /// Resources by their paths from the asset's own folder: '/' separated, not percent-encoded.
  std::map<std::string, std::string> files = {};
};

}  // namespace gltfx

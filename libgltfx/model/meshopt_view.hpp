// SPDX-License-Identifier: Apache-2.0
/// Buffer views whose elements come as a stream of meshoptimizer: EXT_meshopt_compression and
/// KHR_meshopt_compression.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "container/bytes.hpp"
#include "model/asset.hpp"
#include "model/meshopt.hpp"
#include "model/resource_data.hpp"

namespace gltfx::model {

/// The names of the two. They share their members, and what a reader does.
inline constexpr std::array<std::string_view, 2> kMeshoptExtensions{"EXT_meshopt_compression",
                                                                    "KHR_meshopt_compression"};

/// A stream, and what it decodes to.
struct MeshoptView {
  std::string_view extension;
  json::NodeId object = json::kNoNode;  ///< of the extension
  std::uint32_t buffer = 0;             ///< leads to an object
  std::uint64_t byte_offset = 0;
  std::uint64_t byte_length = 0;
  meshopt::Layout layout;  ///< sound
};

/// The stream of a buffer view, or nothing when it has none, or one whose members are missing,
/// malformed or do not go together: the schema walk has told so.
std::optional<MeshoptView> read_meshopt_view(const Asset& asset, json::NodeId buffer_view);

/// The bytes of the stream, or nothing when they are not all there.
std::optional<container::Bytes> stream_bytes(const MeshoptView& view,
                                             const ResourceData& resources);

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
/// Buffer views with a stream of meshoptimizer (EXT_meshopt_compression and
/// KHR_meshopt_compression); all of an asset are decoded once.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "container/bytes.hpp"
#include "model/asset.hpp"
#include "model/meshopt.hpp"
#include "model/resource_data.hpp"
#include "model/views.hpp"

namespace gltfx::model {

/// The names of both extensions, which have the same members.
inline constexpr std::array<std::string_view, 2> kMeshoptExtensions{"EXT_meshopt_compression",
                                                                    "KHR_meshopt_compression"};

/// A stream, and the layout of its elements.
struct MeshoptView {
  std::string_view extension;
  json::NodeId object = json::kNoNode;  ///< of the extension
  std::uint32_t buffer = 0;             ///< index of an object
  std::uint64_t byte_offset = 0;
  std::uint64_t byte_length = 0;
  meshopt::Layout layout;  ///< sound
};

/// The stream of a buffer view, or nothing when it has none, or one whose members are missing,
/// malformed or inconsistent: the schema walk has reported that.
std::optional<MeshoptView> read_meshopt_view(const Asset& asset, json::NodeId buffer_view);

/// The bytes of the stream, or nothing when some are missing.
std::optional<container::Bytes> stream_bytes(const MeshoptView& view,
                                             const ResourceData& resources);

/// A buffer view and the result of its stream.
struct DecodedStream {
  std::uint32_t index = 0;  ///< of the buffer view
  MeshoptView view;
  container::Bytes stream;
  std::optional<container::Bytes> plain;  ///< the copy for readers without the extension
  bool affordable = false;                ///< within the limit of all views together
  meshopt::DecodeError error = meshopt::DecodeError::none;
  meshopt::Misfits misfits{};
  bool differs = false;         ///< `plain` has other bytes than the stream
  container::Bytes elements{};  ///< if there is no problem and no plain copy with the same bytes

  /// Why there are no elements, as the end of a sentence; empty if there are.
  std::string problem() const;
};

/// Memory is bounded by the streams, and by a limit that grows with their size. Up to `jobs`
/// threads; in the order of the views.
std::vector<DecodedStream> decode_streams(const Asset& asset, const Views& views,
                                          const ResourceData& resources, unsigned jobs);

}  // namespace gltfx::model

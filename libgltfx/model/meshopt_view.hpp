// SPDX-License-Identifier: Apache-2.0
/// Buffer views whose elements come as a stream of meshoptimizer (EXT_meshopt_compression and
/// KHR_meshopt_compression), and all of an asset decoded once.
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

/// A buffer view and what became of its stream.
struct DecodedStream {
  std::uint32_t index = 0;  ///< of the buffer view
  MeshoptView view;
  container::Bytes stream;
  std::optional<container::Bytes> plain;  ///< the copy for readers without the extension
  bool affordable = false;                ///< within what may be decoded, all views together
  meshopt::DecodeError error = meshopt::DecodeError::none;
  meshopt::Misfits misfits{};
  bool differs = false;         ///< `plain` has other bytes than the stream
  container::Bytes elements{};  ///< where all is well and there is no plain copy

  /// Why there are no elements, as the end of a sentence; empty where all is well.
  std::string problem() const;
};

/// Takes memory only for what its stream can hold, and for little beyond a limit that grows with
/// the streams. Up to `jobs` threads; in the order of the views.
std::vector<DecodedStream> decode_streams(const Asset& asset, const Views& views,
                                          const ResourceData& resources, unsigned jobs);

}  // namespace gltfx::model

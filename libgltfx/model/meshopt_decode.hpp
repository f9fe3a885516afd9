// SPDX-License-Identifier: Apache-2.0
/// All buffer views of an asset that come as streams of meshoptimizer, decoded once.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/meshopt_view.hpp"
#include "model/views.hpp"

namespace gltfx::model {

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

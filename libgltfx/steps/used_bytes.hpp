// SPDX-License-Identifier: Apache-2.0
/// The bytes of buffers that objects of an asset use.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "base/result.hpp"
#include "change/buffer_layout.hpp"
#include "graph/graph.hpp"
#include "model/opened_asset.hpp"
#include "schema/set.hpp"

namespace gltfx::steps {

/// Ranges of bytes of a buffer, sorted and without overlaps.
using ByteRanges = std::vector<change::ByteRange>;

/// The parts of `ranges` that are not in `taken`.
ByteRanges without(const ByteRanges& ranges, const ByteRanges& taken);

/// The number of bytes in ranges.
std::uint64_t size_of(const ByteRanges& ranges);

/// All used bytes of an asset, by buffer. Keeps references to both arguments.
class UsedBytes {
 public:
  UsedBytes(const model::OpenedAsset& asset, const schema::Set& schemas);

  /// The used bytes of any of these buffers. Precondition: `users` has no error.
  ByteRanges of(const std::vector<std::uint64_t>& buffers) const;

  const graph::Graph graph;
  const Result<std::vector<change::BufferUser>> users;
  const std::uint64_t buffers;  ///< their number

 private:
  std::map<std::uint64_t, ByteRanges> ranges_;  ///< by buffer
};

}  // namespace gltfx::steps

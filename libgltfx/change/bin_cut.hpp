// SPDX-License-Identifier: Apache-2.0
/// Unused bytes of a BIN chunk.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "change/change.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"

namespace gltfx::change {

/// Whole words of 8 bytes of the BIN chunk that contain only removed buffer views, in order; empty
/// if not all uses of the chunk are known. Words of 8 bytes keep the alignment of the other data;
/// at the end of the chunk, all padding is cut, too. `editor` gets edits that shorten buffer 0,
/// which is the chunk, and move the remaining views. `size`: of the chunk.
std::vector<ByteRange> cut_bin(const graph::Graph& graph,
                               const std::function<bool(json::NodeId object)>& goes,
                               std::uint64_t size, json::Editor& editor);

/// The data without the cut ranges, as consecutive pieces.
std::vector<container::Bytes> without(const container::Bytes& data,
                                      const std::vector<ByteRange>& cut);

}  // namespace gltfx::change

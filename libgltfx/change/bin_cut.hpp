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

/// Whole words of 8 bytes of the BIN chunk in which only buffer views lie that go, in order; empty
/// where not all that lies in the chunk is known. Words of 8, so that what stays is aligned as it
/// was; at the end of the chunk all that filled it up. Buffer 0, which is the chunk, is made
/// shorter, and views that stay move, by edits that `editor` gets. `size`: of the chunk.
std::vector<ByteRange> cut_bin(const graph::Graph& graph,
                               const std::function<bool(json::NodeId object)>& goes,
                               std::uint64_t size, json::Editor& editor);

/// The data without the cut ranges, as consecutive pieces.
std::vector<container::Bytes> without(const container::Bytes& data,
                                      const std::vector<ByteRange>& cut);

}  // namespace gltfx::change

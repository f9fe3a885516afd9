// SPDX-License-Identifier: Apache-2.0
/// Unused bytes of BIN chunks.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/result.hpp"
#include "change/buffer_layout.hpp"
#include "change/change.hpp"
#include "container/container.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"

namespace gltfx::change {

/// Whole words of 8 bytes of a BIN chunk that contain only removed buffer views, in order. Words of
/// 8 bytes keep the alignment of the other data; at the end of the chunk, all padding is cut, too.
/// `editor` gets edits that shorten the buffer and move the remaining views. `users`: all of the
/// buffer, which is the only one of the chunk. `size`: of the chunk.
std::vector<ByteRange> cut_bin(const graph::Tree& tree, const std::vector<BufferUser>& users,
                               const std::function<bool(json::NodeId object)>& goes,
                               std::uint64_t size, json::Editor& editor);

/// The changes of BIN chunks when objects go: chunks of which all buffers go are dropped, unless
/// numbers of other chunks would change that are not all known; of the others, bytes are cut if all
/// uses of them are known. An Error, half a sentence, if another buffer would get a chunk.
Result<BinChanges> cut_bins(const graph::Graph& graph, const container::Container& container,
                            const std::function<bool(json::NodeId object)>& goes,
                            json::Editor& editor);

/// The part of cut_bins() that drops chunks. `goes` is asked for buffers.
Result<BinChanges> drop_bins(const graph::Graph& graph, const container::Container& container,
                             const std::function<bool(json::NodeId buffer)>& goes,
                             json::Editor& editor);

/// The data without the cut ranges, as consecutive pieces.
std::vector<container::Bytes> without(const container::Bytes& data,
                                      const std::vector<ByteRange>& cut);

}  // namespace gltfx::change

// SPDX-License-Identifier: Apache-2.0
/// Which chunk of a GLB has the bytes of a buffer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "container/container.hpp"
#include "json/document.hpp"
#include "schema/version.hpp"

namespace gltfx::model {

/// The member `chunk` of a buffer, which versions after 2.0 have; json::kNoNode: none.
json::NodeId chunk_member(const json::Document& document, json::NodeId buffer,
                          const schema::Version& version);

/// The number of the chunk that a buffer without a URI names, or that buffer 0 has without a word.
/// Nothing if it has none; there need not be such a chunk.
std::optional<std::uint64_t> chunk_number(const json::Document& document, json::NodeId buffer,
                                          std::uint64_t index, const schema::Version& version);

/// The chunk of a buffer without a URI: the one that it names, or for buffer 0 the BIN chunk.
/// Nothing if it has none, or one of another type or of an unknown encoding.
std::optional<container::Chunk> chunk_of(const container::Container& container,
                                         const json::Document& document, json::NodeId buffer,
                                         std::uint64_t index, const schema::Version& version);

/// The position of a chunk of the container. Precondition: it has that chunk.
std::size_t position_of(const container::Container& container, const container::Chunk& chunk);

}  // namespace gltfx::model

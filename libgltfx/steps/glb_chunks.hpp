// SPDX-License-Identifier: Apache-2.0
/// The chunks of a GLB that becomes one of another version.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "container/container.hpp"
#include "model/asset_bytes.hpp"
#include "steps/step.hpp"

namespace gltfx::steps {

/// The letters of a chunk type, quoted.
std::string chunk_type(const container::Chunk& chunk);

/// Adds to `row` what a GLB of the other version cannot hold, as refused and as lost, and the
/// chunks whose numbers change, as lost. `used`: from used_chunks().
void note_chunks(const container::Container& container, const std::set<std::uint64_t>& used,
                 std::uint32_t version, ConvertStep& row);

/// Whether buffers name their chunks, which those of glTF 2.0 do not.
bool names_chunks(const json::Document& document);

/// The offsets of the data of BIN chunks that buffers have.
std::set<std::uint64_t> used_chunks(const model::AssetBytes& bytes);

/// The BIN chunk of a GLB with exactly one, also without a buffer of it.
std::optional<container::Chunk> lone_bin(const container::Container& container);

}  // namespace gltfx::steps

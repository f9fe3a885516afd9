// SPDX-License-Identifier: Apache-2.0
/// Unused bytes of a BIN chunk.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "change/change.hpp"
#include "json/edit.hpp"

namespace gltfx::change {

/// Whole words of the BIN chunk that only removed buffer views use, in order; empty if the chunk
/// has unknown contents. Shortens buffer 0 and moves kept views by edits of `editor`. `references`:
/// number of indices of buffer 0 in the document; `size`: of the chunk.
std::vector<ByteRange> cut_bin(const json::Document& document,
                               const std::set<std::uint64_t>& gone_views, std::uint64_t references,
                               std::uint64_t size, json::Editor& editor);

}  // namespace gltfx::change

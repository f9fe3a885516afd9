// SPDX-License-Identifier: Apache-2.0
/// Bytes of a BIN chunk that nobody needs any more.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "change/change.hpp"
#include "json/edit.hpp"

namespace gltfx::change {

/// Whole words of the BIN chunk in which only buffer views lie that go, in order; empty where not
/// all that lies in the chunk is known. Buffer 0 is made shorter, and views that stay move, by
/// edits that `editor` gets. `references`: how many indices of the document lead to buffer 0;
/// `size`: of the chunk.
std::vector<ByteRange> cut_bin(const json::Document& document,
                               const std::set<std::uint64_t>& gone_views, std::uint64_t references,
                               std::uint64_t size, json::Editor& editor);

}  // namespace gltfx::change

// SPDX-License-Identifier: Apache-2.0
/// Buffers that become parts of another one.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "change/buffer_layout.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"
#include "model/asset_bytes.hpp"

namespace gltfx::steps {

/// An object that refers to bytes after the end of its buffer, which would be those of another one
/// after merging; empty: there is none.
std::string find_overrun(const graph::Graph& graph, const model::AssetBytes& bytes,
                         const std::vector<change::BufferUser>& users);

/// Whether readers that support compressed views need not load the buffer
/// (EXT_meshopt_compression, "fallback").
bool is_plain_copy(const json::Document& document, json::NodeId buffer);

/// The first member of a merged buffer, other than length, place and name, that would be lost.
std::string find_lost_member(const json::Document& document, json::NodeId buffer);

/// A buffer that becomes a part of another one.
struct Packed {
  std::uint64_t index;
  std::uint64_t base;  ///< its offset in the other one
};

/// Makes all users of buffers use the first of them, and removes the others. `users`: all of the
/// asset.
void move_users(const graph::Graph& graph, const std::vector<change::BufferUser>& users,
                const std::vector<Packed>& packed, json::Editor& editor);

}  // namespace gltfx::steps

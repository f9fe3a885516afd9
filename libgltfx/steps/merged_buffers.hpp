// SPDX-License-Identifier: Apache-2.0
/// Why a buffer must not become a part of another one.
#pragma once

#include <string>
#include <vector>

#include "change/buffer_layout.hpp"
#include "graph/graph.hpp"
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

}  // namespace gltfx::steps

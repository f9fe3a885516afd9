// SPDX-License-Identifier: Apache-2.0
/// The used bytes of buffers, and the objects that use them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "change/change.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"

namespace gltfx::change {

/// An object that refers to bytes of a buffer by its members `buffer`, `byteOffset` and
/// `byteLength`: a buffer view, or an object of an extension with these members.
struct BufferUser {
  json::NodeId object = json::kNoNode;
  std::uint64_t buffer = 0;  ///< index
  ByteRange bytes;
};

/// All of them, in the order of the walk. An Error, half a sentence, if the bytes of an object are
/// not known. Extensions without a schema are not checked.
Result<std::vector<BufferUser>> buffer_users(const graph::Graph& graph);

/// Moves the begin of an object to another byte of its buffer.
void move_user(const json::Document& document, const BufferUser& user, std::uint64_t begin,
               json::Editor& editor);

/// The data URI with other bytes, in base64. Its media type and parameters stay. An Error if it is
/// not a data URI.
Result<std::string> with_data(std::string_view uri, std::string_view bytes);

}  // namespace gltfx::change

// SPDX-License-Identifier: Apache-2.0
/// Which bytes of buffers are in use, and by which objects.
#pragma once

#include <cstdint>
#include <vector>

#include "base/result.hpp"
#include "change/change.hpp"
#include "graph/graph.hpp"
#include "json/edit.hpp"

namespace gltfx::change {

/// An object that names bytes of a buffer by its members `buffer`, `byteOffset` and `byteLength`: a
/// buffer view, or what an extension has in its place.
struct BufferUser {
  json::NodeId object = json::kNoNode;
  std::uint64_t buffer = 0;  ///< index
  ByteRange bytes;
};

/// All of them, in the order of the walk. An Error where it is not known which bytes something
/// means: half a sentence. What extensions without a schema may mean is not looked at.
Result<std::vector<BufferUser>> buffer_users(const graph::Graph& graph);

/// Lets an object begin at another byte of its buffer.
void move_user(const json::Document& document, const BufferUser& user, std::uint64_t begin,
               json::Editor& editor);

}  // namespace gltfx::change

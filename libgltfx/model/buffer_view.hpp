// SPDX-License-Identifier: Apache-2.0
/// Buffer views as numbers instead of JSON (specification section 3.6.1).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "model/asset.hpp"

namespace gltfx::model {

enum class ViewTarget : std::uint8_t { none, vertices, indices };

/// One buffer view. A member that is absent or malformed is an empty optional.
struct BufferView {
  json::NodeId node = json::kNoNode;    ///< kNoNode: the element of the array is no object
  std::optional<std::uint32_t> buffer;  ///< leads to an object
  std::optional<std::uint64_t> byte_offset;
  std::optional<std::uint64_t> byte_length;  ///< at least 1
  std::optional<std::uint64_t> byte_stride;  ///< 4 to 252
  ViewTarget target = ViewTarget::none;
};

BufferView read_buffer_view(const Asset& asset, json::NodeId object);

/// All buffer views, by index.
std::vector<BufferView> read_buffer_views(const Asset& asset);

}  // namespace gltfx::model

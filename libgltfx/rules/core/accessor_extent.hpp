// SPDX-License-Identifier: Apache-2.0
/// Whether numbers lie on their boundaries and inside their buffer view.
#pragma once

#include <cstdint>
#include <optional>

#include "base/checked.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// Whether an accessor says enough to know where its elements lie. The Khronos validator takes a
/// type that glTF does not have for one without components.
bool is_measurable(const Context& context, const model::Accessor& accessor);

/// Numbers in a buffer view, as an accessor or a part of a sparse accessor has them.
struct Extent {
  json::NodeId object = json::kNoNode;       ///< the one with `byteOffset`
  std::uint32_t view = 0;                    ///< index of the buffer view, which is an object
  std::optional<std::uint64_t> byte_offset;  ///< as written
  unsigned component_size = 1;               ///< bytes, at least 1
  Checked length;                            ///< bytes; nothing: beyond 64 bits
};

/// Reports ACCESSOR_OFFSET_ALIGNMENT, ACCESSOR_TOTAL_OFFSET_ALIGNMENT and ACCESSOR_TOO_LONG.
void check_extent(const Context& context, const Extent& extent, const Path& path);

}  // namespace gltfx::validate

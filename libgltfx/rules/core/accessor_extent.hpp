// SPDX-License-Identifier: Apache-2.0
/// Alignment of numbers, and whether they are inside their buffer view.
#pragma once

#include <cstdint>
#include <optional>

#include "base/checked.hpp"
#include "rules/context.hpp"

namespace gltfx::validate {

/// Whether the place of an accessor's elements can be computed. The Khronos validator treats an
/// unknown type as one without components.
bool is_measurable(const Context& context, const model::Accessor& accessor);

/// Numbers in a buffer view, of an accessor or a part of a sparse accessor.
struct Extent {
  json::NodeId object = json::kNoNode;       ///< the object with `byteOffset`
  std::uint32_t view = 0;                    ///< index of a buffer view that is an object
  std::optional<std::uint64_t> byte_offset;  ///< as written
  unsigned component_size = 1;               ///< bytes, at least 1
  Checked length;                            ///< bytes; nothing: more than 64 bits
};

/// Reports ACCESSOR_OFFSET_ALIGNMENT, ACCESSOR_TOTAL_OFFSET_ALIGNMENT and ACCESSOR_TOO_LONG.
void check_extent(const Context& context, const Extent& extent, const Path& path);

}  // namespace gltfx::validate

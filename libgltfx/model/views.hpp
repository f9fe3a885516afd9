// SPDX-License-Identifier: Apache-2.0
/// The tables that most questions about geometry start from, read once.
#pragma once

#include <vector>

#include "model/accessor.hpp"
#include "model/buffer_view.hpp"
#include "model/usage.hpp"

namespace gltfx::model {

/// Numbers only: it stays valid as long as the document its nodes belong to.
struct Views {
  std::vector<Accessor> accessors;       ///< as many as elements(RootArray::accessors)
  std::vector<BufferView> buffer_views;  ///< as many as elements(RootArray::buffer_views)
  Usage usage;

  Views() = default;
  explicit Views(const Asset& asset)
      : accessors(read_accessors(asset)),
        buffer_views(read_buffer_views(asset)),
        usage(asset, accessors, buffer_views) {}

  /// The view behind an accessor, or null.
  const BufferView* view_of(const Accessor& accessor) const {
    return accessor.buffer_view ? &buffer_views[*accessor.buffer_view] : nullptr;
  }
};

}  // namespace gltfx::model

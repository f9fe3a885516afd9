// SPDX-License-Identifier: Apache-2.0
/// The basic tables of an asset, read once.
#pragma once

#include <vector>

#include "model/accessor.hpp"
#include "model/animation.hpp"
#include "model/mesh.hpp"
#include "model/node.hpp"
#include "model/usage.hpp"

namespace gltfx::model {

/// Valid as long as the document of its nodes and names.
struct Views {
  std::vector<Accessor> accessors;       ///< as many as elements(RootArray::accessors)
  std::vector<BufferView> buffer_views;  ///< as many as elements(RootArray::buffer_views)
  std::vector<Mesh> meshes;              ///< as many as elements(RootArray::meshes)
  std::vector<Node> nodes;               ///< as many as elements(RootArray::nodes)
  std::vector<Animation> animations;     ///< as many as elements(RootArray::animations)
  Usage usage;

  Views() = default;
  explicit Views(const Asset& asset)
      : accessors(read_accessors(asset)),
        buffer_views(read_buffer_views(asset)),
        meshes(read_meshes(asset)),
        nodes(read_nodes(asset)),
        animations(read_animations(asset)),
        usage(asset, accessors, buffer_views, meshes) {}

  /// The view of an accessor, or null.
  const BufferView* view_of(const Accessor& accessor) const {
    return accessor.buffer_view ? &buffer_views[*accessor.buffer_view] : nullptr;
  }
};

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
/// Objects that equal earlier ones of their root array, but for their names.
#pragma once

#include <utility>
#include <vector>

#include "measure/source.hpp"

namespace gltfx::measure {

/// Pairs of an object and the first one that it equals, in document order.
struct Duplicates {
  using Pairs = std::vector<std::pair<json::NodeId, json::NodeId>>;
  Pairs images, materials, accessors, meshes;
  bool complete = true;  ///< false: objects share too many bytes, and some were not compared
};

/// Reads all bytes of images and accessors.
Duplicates find_duplicates(const Source& source);

}  // namespace gltfx::measure

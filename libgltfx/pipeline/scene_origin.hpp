// SPDX-License-Identifier: Apache-2.0
/// The point that positions of a picture are relative to. Single precision has steps of 0.03 at
/// 500,000 and of 1 at 1e7: georeferenced assets need the difference before anything is rounded.
#pragma once

#include "model/node.hpp"
#include "pipeline/scene_tree.hpp"

namespace gltfx {

/// A point in the middle of most of what is drawn, in the unit of the scene; 0 unless that is many
/// times farther from 0 than it is large. Only what the picture is of counts. Reads bounds of
/// accessors, no vertex, of a bounded number of nodes.
model::Vector3 find_origin(const SceneTree& tree);

}  // namespace gltfx

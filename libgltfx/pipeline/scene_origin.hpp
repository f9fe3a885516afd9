// SPDX-License-Identifier: Apache-2.0
/// The point that positions of a picture are relative to. Single precision has steps of 0.03 at
/// 500,000 and of 1 at 1e7: georeferenced assets need the difference before anything is rounded.
#pragma once

#include <cstdint>
#include <vector>

#include "model/pose.hpp"

namespace gltfx {

/// A point in the middle of most of what is drawn, in the unit of the scene; 0 unless that is many
/// times farther from 0 than it is large. `framed`: by node, those that count; empty: all. Reads
/// bounds of accessors, no vertex, of a bounded number of nodes.
model::Vector3 find_origin(const model::Asset& asset, const model::Views& views,
                           const model::ResourceData& resources, const model::Pose& pose,
                           const std::vector<std::uint8_t>& framed);

}  // namespace gltfx

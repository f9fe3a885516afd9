// SPDX-License-Identifier: Apache-2.0
/// Where changes are: in the texts, and in the scenes.
#pragma once

#include <gltfx/compare.hpp>

#include <cstdint>
#include <vector>

#include "model/scene_box.hpp"
#include "prove/changes.hpp"

namespace gltfx::prove {

/// Of a changed object, in the space of the scene; empty: it is not drawn.
struct ChangedBoxes {
  model::Box ours, theirs;
};

/// Whether the first one is more of a change: by level, then by its part of the bound.
bool is_greater(const Change& a, const Change& b);

/// The change at whose moment both assets are drawn: the greatest one that has a time, or null.
const Change* change_of_moment(const CompareReport& report);

/// Sets lines and columns of all changes. `our_offset`: byte in the file where the text begins.
void locate_changes(const Comparison& comparison, std::uint64_t our_offset,
                    std::uint64_t their_offset, CompareReport& report);

/// The boxes of the first changes, up to a limit, in the order of the report: of a node with its
/// children, of the largest node with a mesh, of what a material or image is seen on, of what a
/// curve moves; all at change_of_moment(). Linear in the references of both assets.
std::vector<ChangedBoxes> find_changed_boxes(const Comparison& comparison,
                                             const CompareReport& report);

}  // namespace gltfx::prove

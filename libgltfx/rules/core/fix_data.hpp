// SPDX-License-Identifier: Apache-2.0
/// Fixes of what is wrong with the elements of accessors. Each of them changes bytes where they
/// are, and only where nobody else reads these bytes as something else.
#pragma once

#include "rules/fix.hpp"

namespace gltfx::validate {

// Fixes for FixEntry. `place` is the member that uses the accessor, unless it says otherwise.

/// Normals and tangents get the length 1 in their direction.
bool make_unit_vectors(Fixing& fixing, Span place);
/// The same; where no vertex of a face has a direction, normals come from the faces.
bool make_unit_or_fill(Fixing& fixing, Span place);
/// As fill_unused_vertices(), and make_unit_or_fill() for normals that are no numbers.
bool fill_unused_or_normals(Fixing& fixing, Span place);
/// Normals without a direction come from the faces, whatever others have; `place` is the member or
/// the accessor.
bool fill_some_normals(Fixing& fixing, Span place);
/// The sign of tangents becomes 1 or -1.
bool make_signs(Fixing& fixing, Span place);
/// Rotations of instances and splats.
bool make_unit_rotations(Fixing& fixing, Span place);
/// Rotations that an animation writes; `place` is the sampler of the channel.
bool make_unit_keyframes(Fixing& fixing, Span place);
/// What is hardly below 0 or above 1.
bool clamp(Fixing& fixing, Span place);
/// What is no finite number in vertices that no index refers to; `place` is the accessor.
bool fill_unused_vertices(Fixing& fixing, Span place);
/// The weights of each vertex get the sum 1, where they nearly have it.
bool normalize_weights(Fixing& fixing, Span place);
/// Joints with a weight of 0 become joint 0.
bool clear_unweighted_joints(Fixing& fixing, Span place);
/// Indices of a sparse accessor in ascending order, with their values; `place` is the sparse
/// object.
bool sort_sparse(Fixing& fixing, Span place);

/// Gives an accessor the bounds it lacks; `place` is the member that uses it.
bool add_bounds(Fixing& fixing, Span place);
/// Writes a bound of an accessor that is none, of which `value` is a part or all.
bool write_bound(Fixing& fixing, json::NodeId value);
/// Corrects numbers of `min` or `max`, one of which `place` is.
bool correct_bounds(Fixing& fixing, Span place);

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
/// Fixes of invalid elements of accessors. Each of them changes bytes in place, and only if nothing
/// else reads these bytes as something else.
#pragma once

#include "rules/fix.hpp"

namespace gltfx::validate {

// Fixes for FixEntry. The subject is the member that uses the accessor, unless stated otherwise.

/// Scales normals and tangents to length 1.
bool make_unit_vectors(Fixing& fixing, const Subject& subject);
/// Likewise; if no vertex of a face has a direction, normals are computed from the faces.
bool make_unit_or_fill(Fixing& fixing, const Subject& subject);
/// Like fill_unused_vertices(), and like make_unit_or_fill() for normals that are not numbers.
bool fill_unused_or_normals(Fixing& fixing, const Subject& subject);
/// Computes normals without a direction from the faces, regardless of other normals; the subject is
/// the member or the accessor.
bool fill_some_normals(Fixing& fixing, const Subject& subject);
/// Sets the sign of tangents to 1 or -1.
bool make_signs(Fixing& fixing, const Subject& subject);
/// Scales rotations of instances and splats to length 1.
bool make_unit_rotations(Fixing& fixing, const Subject& subject);
/// Scales rotations that an animation writes to length 1; the subject is the sampler of
/// the channel.
bool make_unit_keyframes(Fixing& fixing, const Subject& subject);
/// Clamps numbers that are slightly below 0 or above 1.
bool clamp(Fixing& fixing, const Subject& subject);
/// Replaces numbers that are not finite in vertices without an index; the subject is the
/// accessor.
bool fill_unused_vertices(Fixing& fixing, const Subject& subject);
/// Scales the weights of each vertex to the sum 1 if they nearly have it.
bool normalize_weights(Fixing& fixing, const Subject& subject);
/// Replaces joints with a weight of 0 by joint 0.
bool clear_unweighted_joints(Fixing& fixing, const Subject& subject);
/// Sorts indices of a sparse accessor, with their values; the subject is the sparse object.
bool sort_sparse(Fixing& fixing, const Subject& subject);

/// Adds missing bounds of an accessor; the subject is the member that uses it.
bool add_bounds(Fixing& fixing, const Subject& subject);
/// Replaces an invalid bound of an accessor; `value` is the bound or a part of it.
bool write_bound(Fixing& fixing, json::NodeId value);
/// Corrects numbers of `min` or `max`; the subject is one of them.
bool correct_bounds(Fixing& fixing, const Subject& subject);

}  // namespace gltfx::validate

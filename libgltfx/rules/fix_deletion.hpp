// SPDX-License-Identifier: Apache-2.0
/// Fixes that delete objects. All of one run are planned as one deletion (change/deletion.hpp), in
/// a stage of their own, because other changes of the document would conflict with new indices.
#pragma once

#include "rules/fix.hpp"

namespace gltfx::validate {

/// Deletes the subject, and the references to it as far as their objects are invalid without them.
bool delete_marked(Fixing& fixing, const Subject& subject);

/// Deletes an object without references, and the objects in arrays of the root that only deleted
/// objects refer to.
bool delete_unused(Fixing& fixing, const Subject& object);

}  // namespace gltfx::validate

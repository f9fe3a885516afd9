// SPDX-License-Identifier: Apache-2.0
/// Fixes that take objects out. All of one run are planned as one deletion (change/deletion.hpp),
/// in a stage of their own: what a document loses elsewhere would move under its indices.
#pragma once

#include "rules/fix.hpp"

namespace gltfx::validate {

/// Deletes the value that `place` marks, and what refers to it as far as that cannot be without it.
bool delete_marked(Fixing& fixing, Span place);

/// Deletes the object that `place` marks, to which nothing refers, and the objects in arrays of the
/// root to which only deleted ones refer.
bool delete_unused(Fixing& fixing, Span place);

}  // namespace gltfx::validate

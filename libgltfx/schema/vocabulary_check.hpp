// SPDX-License-Identifier: Apache-2.0
/// Whether a schema file speaks the vocabulary: known words, values of the right form, limits in
/// order.
#pragma once

#include <vector>

#include "schema/source.hpp"

namespace gltfx::schema {

/// Adds an error for every word that is not in the vocabulary and every value of a wrong form.
/// Behind it the compiler may rely on the forms. Iterative.
void check_vocabulary(const std::vector<Source>& sources, ErrorList& errors);

}  // namespace gltfx::schema

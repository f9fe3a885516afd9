// SPDX-License-Identifier: Apache-2.0
/// Limits for the examples of rules about limits.
#pragma once

#include <gltfx/diagnostic.hpp>
#include <gltfx/limit.hpp>

#include <vector>

namespace gltfx {

/// A limit on the first value of the page of a measure: one that the example breaks, or one at the
/// value, which holds. None for other rules.
std::vector<Limit> example_limits(const RuleDescription& rule, bool broken);

}  // namespace gltfx

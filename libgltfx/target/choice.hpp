// SPDX-License-Identifier: Apache-2.0
/// The target and version of a text such as "three@0.187".
#pragma once

#include <gltfx/targets.hpp>

#include <memory>
#include <span>
#include <string_view>

#include "base/result.hpp"

namespace gltfx::target {

/// "NAME" and "NAME@newest" are the newest measured version of the target, "NAME@VERSION" the
/// newest one that begins with these numbers, or else the newest one before it. The Error is a
/// clause.
Result<TargetChoice> choose(std::string_view word,
                            std::span<const std::shared_ptr<const Target>> targets);

}  // namespace gltfx::target

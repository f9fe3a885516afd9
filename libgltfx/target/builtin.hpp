// SPDX-License-Identifier: Apache-2.0
/// A single built-in target.
#pragma once

#include <gltfx/targets.hpp>

#include <memory>
#include <string_view>

namespace gltfx::target {

/// The target of that name, or null. Read at first use. Thread-safe.
std::shared_ptr<const Target> builtin_target(std::string_view name);

}  // namespace gltfx::target

// SPDX-License-Identifier: Apache-2.0
/// One of the targets that the library knows, without the others.
#pragma once

#include <gltfx/targets.hpp>

#include <memory>
#include <string_view>

namespace gltfx::target {

/// The target of that name, or null. Read when it is first asked for; any number of threads may
/// call.
std::shared_ptr<const Target> builtin_target(std::string_view name);

}  // namespace gltfx::target

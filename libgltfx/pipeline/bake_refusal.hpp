// SPDX-License-Identifier: Apache-2.0
/// Limits of options that draw, for callers other than the program, which checks them itself.
#pragma once

#include <gltfx/bake.hpp>

#include <optional>
#include <string>

namespace gltfx {

/// Why nothing can be drawn with these options, half a sentence; or nothing.
std::optional<std::string> find_refusal(const BakeOptions& options);

}  // namespace gltfx

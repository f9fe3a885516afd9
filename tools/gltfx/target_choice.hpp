// SPDX-License-Identifier: Apache-2.0
/// The engines that a user names.
#pragma once

#include <gltfx/targets.hpp>

#include <string>
#include <vector>

#include "base/result.hpp"

namespace gltfx::tool {

/// Comma lists of "NAME" or "NAME@VERSION", among the built-in targets and those of `files`, which
/// replace built-in ones of the same name. The Error names the option.
Result<std::vector<TargetChoice>> read_targets(const std::vector<std::string>& words,
                                               const std::vector<std::string>& files);

/// The names of all targets, sorted; unreadable files are skipped.
std::vector<std::string> target_names(const std::vector<std::string>& files);

}  // namespace gltfx::tool

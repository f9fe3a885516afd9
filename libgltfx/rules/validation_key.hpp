// SPDX-License-Identifier: Apache-2.0
/// What a report depends on beside the asset's files.
#pragma once

#include <gltfx/validate.hpp>

#include <string>

#include "base/hash.hpp"

namespace gltfx {

/// Of everything in the options that bears on a report, and of the build of the program. `folder`:
/// where relative paths start from.
Hash128 validation_key(const ValidateOptions& options, const std::string& folder);

}  // namespace gltfx

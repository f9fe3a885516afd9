// SPDX-License-Identifier: Apache-2.0
/// `--schema FILE` and `--schema-dir DIR`.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "schema/set.hpp"

namespace gltfx::tool {

/// What gltfx knows with the user's files added; null stands for the built-in set when there are
/// none. The Error has a line for each mistake: file:line:column and what is wrong.
Result<std::shared_ptr<const schema::Set>> load_schemas(const std::vector<std::string>& files,
                                                        const std::vector<std::string>& folders);

}  // namespace gltfx::tool

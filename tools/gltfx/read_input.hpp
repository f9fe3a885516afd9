// SPDX-License-Identifier: Apache-2.0
/// Small inputs read whole: standard input, schema files, baselines.
#pragma once

#include <string>

#include "base/result.hpp"

namespace gltfx::tool {

/// All bytes of standard input.
Result<std::string> read_stdin();

/// All bytes of a file that the user named for gltfx itself. The Error names it.
Result<std::string> read_text_file(const std::string& path);

}  // namespace gltfx::tool

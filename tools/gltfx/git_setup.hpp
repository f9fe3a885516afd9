// SPDX-License-Identifier: Apache-2.0
/// Tells git to compare assets with this program.
#pragma once

#include "commands.hpp"

namespace gltfx::tool {

/// Adds what is missing to the attributes and the configuration of the repository around the
/// working directory, or with `global` to those of the user, and prints it. Settings with other
/// values stay and are named: then the code is that of work left.
ExitCode set_up_git(bool global);

}  // namespace gltfx::tool

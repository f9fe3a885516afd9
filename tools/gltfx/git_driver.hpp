// SPDX-License-Identifier: Apache-2.0
/// The program that `git diff` runs for a file (gitattributes(5), "diff.<driver>.command").
#pragma once

#include "commands.hpp"
#include "options.hpp"

namespace gltfx::tool {

/// Prints what changed in the file that the paths of the request describe, as git gives them. What
/// cannot be compared is said there, too: git stops at a program that fails. Of the three paths of
/// `git difftool` it writes a page and prints its path.
ExitCode print_for_git(const CompareRequest& request, const CompareOptions& options);

}  // namespace gltfx::tool

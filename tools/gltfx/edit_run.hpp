// SPDX-License-Identifier: Apache-2.0
/// What the verbs that change assets do alike.
#pragma once

#include <gltfx/edited_file.hpp>

#include <string>
#include <string_view>

#include "commands.hpp"
#include "options.hpp"

namespace gltfx::tool {

/// A diff as standard output gets it: into a file as it is, otherwise without characters that drive
/// a terminal, hide or reorder text. `raw`: with them. Says so where some are left out.
std::string diff_text(std::string_view diff, bool raw);

/// Puts the copies that --backup kept back in their places. `root`: as in EditOptions.
ExitCode restore_all(const EditRequest& request, const std::string& root);

/// What a file that was not dealt with comes to. Precondition: there is a problem.
ExitCode exit_code_of(EditProblem problem);

}  // namespace gltfx::tool

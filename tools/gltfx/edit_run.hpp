// SPDX-License-Identifier: Apache-2.0
/// Code shared by the verbs that change assets.
#pragma once

#include <gltfx/edited_file.hpp>

#include <string>
#include <string_view>

#include "commands.hpp"
#include "options.hpp"

namespace gltfx::tool {

/// A diff for standard output: unchanged for a file, otherwise without characters that control a
/// terminal, hide or reorder text. `raw`: with them. Prints a note if some are escaped.
std::string diff_text(std::string_view diff, bool raw);

/// Restores the copies that --backup kept. `root`: as in EditOptions.
ExitCode restore_all(const EditRequest& request, const std::string& root);

/// The exit code for a problem. Precondition: there is a problem.
ExitCode exit_code_of(EditProblem problem);

}  // namespace gltfx::tool

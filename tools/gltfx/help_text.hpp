// SPDX-License-Identifier: Apache-2.0
/// Texts below the lists of options in `--help`.
#pragma once

#include <string>
#include <string_view>

namespace gltfx::tool {

/// Examples, then the table of exit codes. `verb` is empty for the program itself.
std::string help_footer(std::string_view verb);

/// Only the examples, below a line "Examples:"; the text before that is prose.
std::string_view help_examples(std::string_view verb);

/// "0 nothing found ..." one line per code, in the order of the numbers, indented by two spaces.
std::string exit_code_table();

}  // namespace gltfx::tool

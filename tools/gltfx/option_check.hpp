// SPDX-License-Identifier: Apache-2.0
/// Checks that options have their values, before CLI11 reads them.
#pragma once

#include <string>
#include <vector>

#include "command_table.hpp"

namespace gltfx::tool {

/// The message for an empty argument.
std::string empty_argument();

/// The first mistake in the words after the name of the program, as a sentence, or an empty text: a
/// flag with a value, an option without its value, an empty value or argument. Words that are not
/// options of the verb are not checked. `table`: that of command_table(); the words end before
/// "--".
std::string option_mistake(const std::vector<CommandEntry>& table,
                           const std::vector<std::string>& words);

}  // namespace gltfx::tool

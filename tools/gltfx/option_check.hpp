// SPDX-License-Identifier: Apache-2.0
/// Whether options have the values that they take, before CLI11 reads them.
#pragma once

#include <string>
#include <vector>

#include "command_table.hpp"

namespace gltfx::tool {

/// What is said of an argument without any character.
std::string empty_argument();

/// The first mistake in the words behind the name of the program, as a sentence, or an empty text:
/// a flag with a value, an option without its value, an empty value or argument. Words that are no
/// option of the verb are left to others. `table`: that of command_table(); the words end before
/// "--".
std::string option_mistake(const std::vector<CommandEntry>& table,
                           const std::vector<std::string>& words);

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
/// Parses the command line. The only interface to CLI11, which is slow to compile.
#pragma once

#include <string>
#include <variant>

#include "commands.hpp"
#include "options.hpp"

namespace gltfx::tool {

/// Output instead of a run of a verb: help, versions, or an error in the command.
struct Answer {
  std::string output;  ///< for standard output
  std::string error;   ///< for standard error
  ExitCode code = ExitCode::ok;
};

using CommandLine = std::variant<Request, Answer>;

/// Reads the arguments of main(). Never throws.
CommandLine read_command_line(int argc, const char* const* argv);

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
/// `gltfx schema --new`, `--check` and `--test`, for authors of schema files.
#pragma once

#include <string>
#include <string_view>

#include "commands.hpp"
#include "options.hpp"

namespace gltfx::tool {

/// A schema file to start with, with a test for each thing that it states.
std::string new_schema(std::string_view name);

/// Whether the name has the form PREFIX_name.
bool is_extension_name(std::string_view name);

/// Checks the files of `request` and, on request, runs the tests in them; prints a line for each
/// file and each failure. Returns `findings` when there are failures.
ExitCode check_schemas(const SchemaRequest& request);

}  // namespace gltfx::tool

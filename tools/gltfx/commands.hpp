// SPDX-License-Identifier: Apache-2.0
/// One function a verb: does what was asked, writes to standard output and the targets, complains
/// on standard error, and says what to exit with.
#pragma once

#include <string_view>

#include "exit_code.hpp"
#include "options.hpp"

namespace gltfx::tool {

ExitCode run(const ValidateRequest& request);
ExitCode run(const MergeRequest& request);
ExitCode run(const UpgradeRequest& request);
ExitCode run(const HookRequest& request);
ExitCode run(const BakeRequest& request);
ExitCode run(const PageRequest& request);
ExitCode run(const InspectRequest& request);
ExitCode run(const ExplainRequest& request);
ExitCode run(const RulesRequest& request);
ExitCode run(const SchemaRequest& request);
ExitCode run(const ConfigRequest& request);

/// Writes to standard output: ok, or internal when that fails.
ExitCode print(std::string_view text);

/// "gltfx: <message>" and a line break on standard error.
void complain(std::string_view message);

}  // namespace gltfx::tool

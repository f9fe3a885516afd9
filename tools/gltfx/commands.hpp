// SPDX-License-Identifier: Apache-2.0
/// One function per verb: it runs the request, writes to standard output and the targets, reports
/// problems on standard error, and returns the exit code. One table has the exit codes of all
/// verbs; `--help` prints it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "options.hpp"

namespace gltfx::tool {

/// If several apply, the one of higher rank() is used: a failed run says nothing about findings.
enum class ExitCode : std::uint8_t {
  ok = 0,
  findings = 1,
  usage = 2,
  unreadable = 3,
  internal = 4
};

struct ExitCodeEntry {
  ExitCode code;
  std::string_view meaning;
};

inline constexpr std::array<ExitCodeEntry, 5> kExitCodes{{
    {ExitCode::ok, "success: no findings at or above --fail-on"},
    {ExitCode::findings, "findings at or above --fail-on, work left or refused, or failed renders"},
    {ExitCode::usage, "invalid usage, configuration, schema or baseline, or no assets"},
    {ExitCode::unreadable, "an input cannot be read"},
    {ExitCode::internal, "internal error, or the output cannot be written"},
}};

/// Severity of a code: the code with the highest rank in a run is used.
constexpr int rank(ExitCode code) {
  switch (code) {
    case ExitCode::ok:
      return 0;
    case ExitCode::findings:
      return 1;
    case ExitCode::unreadable:
      return 2;
    case ExitCode::usage:
      return 3;
    case ExitCode::internal:
      break;
  }
  return 4;
}

/// The code to use when both apply.
constexpr ExitCode worse(ExitCode a, ExitCode b) { return rank(a) < rank(b) ? b : a; }

ExitCode run(const ValidateRequest& request);
ExitCode run(const MergeRequest& request);
/// The same for pages. Precondition: there is a MergeRequest::page.
ExitCode merge_pages(const MergeRequest& request);
ExitCode run(const FixRequest& request);
ExitCode run(const UpgradeRequest& request);
ExitCode run(const DeleteRequest& request);
ExitCode run(const ConvertRequest& request);
ExitCode run(const CompareRequest& request);
ExitCode run(const HookRequest& request);
ExitCode run(const BakeRequest& request);
ExitCode run(const PageRequest& request);
ExitCode run(const InspectRequest& request);
ExitCode run(const ExplainRequest& request);
ExitCode run(const RulesRequest& request);
ExitCode run(const TargetsRequest& request);
ExitCode run(const SchemaRequest& request);
ExitCode run(const MeasuresRequest& request);
ExitCode run(const PresetsRequest& request);
ExitCode run(const ConfigRequest& request);

/// Writes to standard output: ok, or internal when that fails.
ExitCode print(std::string_view text);

/// "gltfx: <message>" and a line break on standard error.
void complain(std::string_view message);

}  // namespace gltfx::tool

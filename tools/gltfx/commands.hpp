// SPDX-License-Identifier: Apache-2.0
/// One function a verb: does what was asked, writes to standard output and the targets, complains
/// on standard error, and says what to exit with.
/// What the program ends with. One table for all verbs; `--help` prints it.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "options.hpp"

namespace gltfx::tool {

/// When several apply the one of higher rank() stands: a run that failed says nothing about
/// findings.
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
    {ExitCode::findings,
     "findings at or above --fail-on, fixes or upgrades left, or failed renders"},
    {ExitCode::usage, "invalid usage, configuration, schema or baseline, or no assets"},
    {ExitCode::unreadable, "an input cannot be read"},
    {ExitCode::internal, "internal error, or the output cannot be written"},
}};

/// How bad it is: of several codes of one run the highest rank wins.
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

/// The code that stands when both apply.
constexpr ExitCode worse(ExitCode a, ExitCode b) { return rank(a) < rank(b) ? b : a; }

ExitCode run(const ValidateRequest& request);
ExitCode run(const MergeRequest& request);
/// That of pages. Precondition: there is a MergeRequest::page.
ExitCode merge_pages(const MergeRequest& request);
ExitCode run(const FixRequest& request);
ExitCode run(const UpgradeRequest& request);
ExitCode run(const DeleteRequest& request);
ExitCode run(const HookRequest& request);
ExitCode run(const BakeRequest& request);
ExitCode run(const PageRequest& request);
ExitCode run(const InspectRequest& request);
ExitCode run(const ExplainRequest& request);
ExitCode run(const RulesRequest& request);
ExitCode run(const TargetsRequest& request);
ExitCode run(const SchemaRequest& request);
ExitCode run(const ConfigRequest& request);

/// Writes to standard output: ok, or internal when that fails.
ExitCode print(std::string_view text);

/// "gltfx: <message>" and a line break on standard error.
void complain(std::string_view message);

}  // namespace gltfx::tool

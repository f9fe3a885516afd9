// SPDX-License-Identifier: Apache-2.0
/// @file
/// Options and report of `gltfx fix`. The calls are in <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/diagnostic.hpp>
#include <gltfx/edited_file.hpp>
#include <gltfx/validate.hpp>

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

/// Outcome for the findings of one rule in one file. Owns its text.
struct FixAction {
  std::string_view code;               ///< of the rule, static storage
  Fix kind = Fix::safe;                ///< safe or unsafe
  Severity severity = Severity::hint;  ///< of the most severe finding
  std::uint64_t count = 0;             ///< findings
  std::vector<std::string> pointers;   ///< of the first of them (RFC 6901); "" is the file itself
  bool done = false;                   ///< they are fixed in the new file
  std::string why_not;                 ///< one sentence without full stop where they are not
};

/// Options of a run.
struct FixOptions : EditOptions {
  /// Options of the validation of the asset at a path: the findings that it reports are fixed. Its
  /// profile, select, ignore, severity and inline_suppressions apply. Null: default options.
  /// Several threads call it.
  std::function<ValidateOptions(const std::string& path)> validation;
  /// Codes of rules to which the run is limited, also of hints that validation does not report;
  /// empty: all whose fix is safe.
  std::set<std::string, std::less<>> only;
  std::set<std::string, std::less<>> skip;  ///< codes that are left alone
  bool unsafe = false;  ///< do unsafe fixes, too, of those rules that `only` names
};

/// Findings in one file and their outcome.
struct FixReport : EditOutcome {
  /// First those that are done, then those that are not, each sorted by code. Findings of rules
  /// without a fix are not listed.
  std::vector<FixAction> actions;
  std::vector<std::string> changed_files;  ///< buffers that were rewritten, from its folder
  std::vector<std::string> new_files;      ///< converted images, from its folder

  /// Findings that are fixed in the new file.
  std::uint64_t fixed() const;
  /// Findings that have a fix but stay.
  std::uint64_t left() const;
};

}  // namespace gltfx

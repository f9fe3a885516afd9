// SPDX-License-Identifier: Apache-2.0
/// @file
/// What `gltfx fix` can be asked for, and what it says of each finding that it fixes. The calls are
/// in <gltfx/pipeline.hpp>.
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

/// What the findings of one rule came to in one file. Owns its text.
struct FixAction {
  std::string_view code;               ///< of the rule, static storage
  Fix kind = Fix::safe;                ///< safe or unsafe
  Severity severity = Severity::hint;  ///< of the most severe finding
  std::uint64_t count = 0;             ///< findings
  std::vector<std::string> pointers;   ///< of the first of them (RFC 6901); "" is the file itself
  bool done = false;                   ///< they are fixed in the new file
  std::string why_not;                 ///< one sentence without stop where they are not
};

/// What a run is asked for.
struct FixOptions : EditOptions {
  /// What validation of the asset at a path is asked for: findings that it reports are fixed, by
  /// their profile, select, ignore, severity and inline_suppressions. Null: default options.
  /// Several threads call it.
  std::function<ValidateOptions(const std::string& path)> validation;
  /// Codes of rules to which the run is limited, also of hints that validation does not report;
  /// empty: all whose fix is safe.
  std::set<std::string, std::less<>> only;
  std::set<std::string, std::less<>> skip;  ///< codes that are left alone
  bool unsafe = false;  ///< do unsafe fixes, too, of those rules that `only` names
};

/// What was found in one file, and what became of it.
struct FixReport : EditOutcome {
  /// First what is done, then what is not, each by code. Findings of rules without a fix are not
  /// listed.
  std::vector<FixAction> actions;
  std::vector<std::string> changed_files;  ///< buffers that were rewritten, from its folder

  /// Findings that are fixed in the new file.
  std::uint64_t fixed() const;
  /// Those that have a fix and stay all the same.
  std::uint64_t left() const;
};

}  // namespace gltfx

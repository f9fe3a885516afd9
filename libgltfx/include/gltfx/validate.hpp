// SPDX-License-Identifier: Apache-2.0
/// What validation can be asked for, and every rule it knows. The calls are in
/// <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace gltfx {

namespace schema {
class Set;
}

/// What is reported. `standard`: all errors, warnings and infos. `khronos`: what the Khronos
/// validator reports, unfolded. `strict`: hints too, and everything decoded that a rule needs.
enum class Profile : std::uint8_t { standard, khronos, strict };

/// What a Git-LFS pointer in place of a file is: an info, or an error.
enum class LfsPolicy : std::uint8_t { skip, error };

struct ValidateOptions {
  Profile profile = Profile::standard;
  LfsPolicy lfs = LfsPolicy::skip;
  /// Folder that resources may come from; empty: the asset's own folder.
  std::string root;
  /// Findings kept per file, 0: no limit.
  std::uint64_t max_issues = 0;
  /// Threads that one large file may be given; 0: one a core. Reports do not depend on it.
  unsigned jobs = 0;
  std::set<std::string, std::less<>> select;              ///< only these codes; empty: all
  std::set<std::string, std::less<>> ignore;              ///< never these
  std::map<std::string, Severity, std::less<>> severity;  ///< instead of a rule's default
  /// What is known of glTF; null: the built-in set. Shared with other threads, never changed.
  std::shared_ptr<const schema::Set> schemas;
};

/// All rules, sorted by code. Static storage.
std::span<const RuleDescription> rules();

/// The rule with that code, or null.
const RuleDescription* find_rule(std::string_view code);

/// The bytes of a rule's example. An example is the text of an asset; `{{text*N}}` in it stands for
/// N times `text`, and one that begins with "base64:" is a binary file.
std::string example_bytes(std::string_view example);

}  // namespace gltfx

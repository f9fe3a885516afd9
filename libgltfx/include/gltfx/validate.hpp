// SPDX-License-Identifier: Apache-2.0
/// @file
/// What validation can be asked for, and every rule it knows. The calls are in
/// <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/diagnostic.hpp>
#include <gltfx/searched_folders.hpp>
#include <gltfx/targets.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gltfx {

namespace schema {
class Set;
}
class ResultCache;

/// What is reported. `standard`: all errors, warnings and infos. `khronos`: what the Khronos
/// validator reports, unfolded. `strict`: hints too, and everything decoded that a rule needs.
enum class Profile : std::uint8_t { standard, khronos, strict };

/// What a Git-LFS pointer in place of a file is: an info, or an error.
enum class LfsPolicy : std::uint8_t { skip, error };

/// How far images are looked into. `headers`: nothing is decoded. `needed`: what a rule that is
/// asked for cannot judge otherwise. `all`: every image.
enum class PixelLevel : std::uint8_t { headers, needed, all };

/// "headers", "needed", "all".
std::string_view pixel_level_name(PixelLevel level);

/// What an asset may cost; 0: no limit. Findings about them are errors of their own codes.
struct Budgets {
  std::uint64_t texture_size = 0;  ///< pixels along the longer side of any image
  std::uint64_t total_pixels = 0;  ///< of all images
  std::uint64_t triangles = 0;     ///< of all primitives, each counted once
  std::uint64_t draw_calls = 0;    ///< primitives, each counted once
  std::uint64_t file_size = 0;     ///< bytes of the file and of those it refers to
};

/// Lines of a text, counted from 1; `last` belongs to it.
struct LineRange {
  std::uint64_t first = 0, last = 0;  ///< numbers of lines
};

/// What a validation is asked for.
struct ValidateOptions {
  Profile profile = Profile::standard;  ///< what is reported
  /// Nothing: `needed` in the strict profile, otherwise `headers`. The khronos profile never
  /// decodes.
  std::optional<PixelLevel> pixels;
  Budgets budgets;                  ///< what an asset may cost
  LfsPolicy lfs = LfsPolicy::skip;  ///< how pointers of Git LFS count
  /// Leave out what an asset asks to leave out, errors too: `{"ignore": [{"code": "UNUSED_OBJECT",
  /// "reason": "..."}]}` in `extras.gltfx` of an object, for findings on it and below it. Only for
  /// assets from a trusted source; the khronos profile never does.
  bool inline_suppressions = false;
  /// Folder that the asset and its resources may come from; empty: the asset's own folder.
  std::string root;
  /// Folders that were searched: without a `root`, an asset below one is opened beneath it. Null:
  /// none. Not changed during a call.
  std::shared_ptr<const SearchedFolders> searched;
  /// Findings kept per file, 0: no limit.
  std::uint64_t max_issues = 0;
  /// Leave out findings on other lines of the JSON text; those without a place stay when there is
  /// any range. Nothing: all lines.
  std::optional<std::vector<LineRange>> changed_lines;
  /// Fill Diagnostic::fix where a program can fix the finding and the picture stays the same. Each
  /// proposal is validated, which takes longer than the validation itself.
  bool propose_fixes = false;
  /// Engines that the asset is for: what they refuse or ignore is reported. The khronos profile
  /// reports nothing of it.
  std::vector<TargetChoice> targets;
  /// Threads that one large file may be given; 0: one a core. Reports do not depend on it.
  unsigned jobs = 0;
  std::set<std::string, std::less<>> select;              ///< only these codes; empty: all
  std::set<std::string, std::less<>> ignore;              ///< never these
  std::map<std::string, Severity, std::less<>> severity;  ///< instead of a rule's default
  /// What is known of glTF; null: the built-in set. Shared with other threads, never changed.
  std::shared_ptr<const schema::Set> schemas;
  /// Where reports of earlier runs are looked for and new ones kept (<gltfx/result_cache.hpp>);
  /// null: nowhere.
  std::shared_ptr<ResultCache> cache;
};

/// The level that the options come to.
PixelLevel pixel_level(const ValidateOptions& options);

/// All rules, sorted by code. Static storage.
std::span<const RuleDescription> rules();

/// The rule with that code, or null.
const RuleDescription* find_rule(std::string_view code);

/// The bytes of a rule's example. An example is the text of an asset; `{{text*N}}` in it stands for
/// N times `text`, and one that begins with "base64:" is a binary file.
std::string example_bytes(std::string_view example);

}  // namespace gltfx

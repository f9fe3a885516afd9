// SPDX-License-Identifier: Apache-2.0
/// @file
/// Options of a validation, and all rules. The calls are in <gltfx/pipeline.hpp>.
#pragma once

#include <gltfx/diagnostic.hpp>
#include <gltfx/limit.hpp>
#include <gltfx/own_rules.hpp>
#include <gltfx/searched_folders.hpp>
#include <gltfx/targets.hpp>

#include <cstdint>
#include <functional>
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

/// The set of reported findings. `standard`: all errors, warnings and infos. `khronos`: what the
/// Khronos validator reports, unfolded. `strict`: hints too, and everything decoded that a rule
/// needs.
enum class Profile : std::uint8_t { standard, khronos, strict };

/// Severity of a Git LFS pointer in place of a file: info or error.
enum class LfsPolicy : std::uint8_t { skip, error };

/// How images are checked. `headers`: nothing is decoded. `needed`: the images that an enabled rule
/// needs decoded. `all`: every image.
enum class PixelLevel : std::uint8_t { headers, needed, all };

/// "headers", "needed", "all".
std::string_view pixel_level_name(PixelLevel level);

/// Lines of a text, counted from 1, both inclusive.
struct LineRange {
  std::uint64_t first = 0, last = 0;  ///< line numbers
};

/// Options of a validation.
struct ValidateOptions {
  Profile profile = Profile::standard;  ///< the set of reported findings
  /// Nothing: `needed` in the strict profile, otherwise `headers`. The khronos profile never
  /// decodes.
  std::optional<PixelLevel> pixels;
  /// Limits on measures of the asset, but in the khronos profile. Those that need pixels decode
  /// images, unless `pixels` is `headers`.
  std::vector<Limit> limits;
  /// Sizes of products, for limits on product-deviation; null: none.
  std::shared_ptr<const ProductList> products;
  LfsPolicy lfs = LfsPolicy::skip;  ///< severity of Git LFS pointers
  /// Apply suppressions in the asset, also to errors: `{"ignore": [{"code": "UNUSED_OBJECT",
  /// "reason": "..."}]}` in `extras.gltfx` of an object, for findings on it and below it. Only for
  /// assets from a trusted source; the khronos profile ignores them.
  bool inline_suppressions = false;
  /// Folder that the asset and its resources may come from; empty: the asset's own folder.
  std::string root;
  /// Folders that were searched: without a `root`, an asset below one is opened beneath it. Null:
  /// none. Not changed during a call.
  std::shared_ptr<const SearchedFolders> searched;
  /// Findings kept per file, 0: no limit.
  std::uint64_t max_issues = 0;
  /// Leave out findings on other lines of the JSON text, those of own rules by all lines of their
  /// object. Those without a place and on limits stay when there is any range. Nothing: all lines.
  std::optional<std::vector<LineRange>> changed_lines;
  /// The same for each external asset, by the path of its report; null: all lines of all of them.
  std::function<std::optional<std::vector<LineRange>>(const std::string& path)> changed_lines_of;
  /// Fill Diagnostic::fix where a program can fix the finding and the picture stays the same. Each
  /// proposal is validated, which takes longer than the validation itself.
  bool propose_fixes = false;
  /// Engines that the asset is for: features that they refuse or ignore are reported, except in the
  /// khronos profile.
  std::vector<TargetChoice> targets;
  /// Threads for one large file; 0: one per core. Reports do not depend on it.
  unsigned jobs = 0;
  std::set<std::string, std::less<>> select;              ///< only these codes; empty: all
  std::set<std::string, std::less<>> ignore;              ///< never these
  std::map<std::string, Severity, std::less<>> severity;  ///< instead of a rule's default
  /// Schemas; null: the built-in set. Shared with other threads, never changed.
  std::shared_ptr<const schema::Set> schemas;
  /// Rules of the user, checked after those of gltfx, except in the khronos profile; null: none.
  std::shared_ptr<const OwnRules> own_rules;
  /// Cache of reports of earlier runs (<gltfx/result_cache.hpp>); null: none.
  std::shared_ptr<ResultCache> cache;
};

/// The level that results from the options.
PixelLevel pixel_level(const ValidateOptions& options);

/// All rules, sorted by code. Static storage.
std::span<const RuleDescription> rules();

/// The rule with that code, or null.
const RuleDescription* find_rule(std::string_view code);

/// The bytes of a rule's example. An example is the text of an asset; `{{text*N}}` in it means N
/// times `text`, and one that begins with "base64:" is a binary file.
std::string example_bytes(std::string_view example);

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
/// The requests of the user, by verb, as plain data. `command_line.hpp` fills them.
#pragma once

#include <gltfx/bake.hpp>
#include <gltfx/compare.hpp>
#include <gltfx/pipeline.hpp>
#include <gltfx/report.hpp>
#include <gltfx/upgrade.hpp>
#include <gltfx/validate.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/parallel.hpp"
#include "base/result.hpp"
#include "schema/set.hpp"

namespace gltfx::tool {

enum class ColorMode : std::uint8_t { automatic, always, never };

/// Options of every verb.
struct CommonOptions {
  unsigned jobs = default_jobs();
  ColorMode color = ColorMode::automatic;
  bool unsandboxed_decoders = false;
};

/// The choice of the configuration file.
struct ConfigChoice {
  std::string config;     ///< empty: the nearest gltfx.toml from the working folder upwards
  bool isolated = false;  ///< none
};

class PathOptions;

/// The named paths: to be searched and expanded, or used literally.
struct NamedPaths {
  std::vector<std::string> words;
  bool literal = false;  ///< names of files, also with wildcards
  /// More files and folders, one per line, or each followed by a NUL if there is any.
  std::string listed = {};
  Shard shard = {};  ///< the part of all inputs that this run takes
  /// Having no asset is not a mistake.
  bool allow_empty = false;
  /// Patterns of files to skip in folders and globs (fits_pattern), matched with paths as given and
  /// with those below the named folder.
  std::vector<std::string> exclude = {};
  bool no_ignore = false;  ///< .gitignore files are ignored
};

/// One `--format NAME[=FILE]`. An empty path, like "-", is standard output.
struct FormatTarget {
  ReportFormat format = ReportFormat::text;
  std::string path;
};

/// Formats of the verbs that print tables.
enum class TableFormat : std::uint8_t { text, json };

/// The folder of results of earlier runs, and the key that seals them.
struct CacheChoice {
  std::string folder;    ///< empty: no cache
  std::string key_file;  ///< empty: the key of the environment or the user
};

/// Output and verdict of reports.
struct ReportRequest {
  CommonOptions common;
  /// Rules of users that reports may name; null: none.
  std::shared_ptr<const OwnRules> own_rules;
  /// At least one, at most one of them to standard output.
  std::vector<FormatTarget> targets{FormatTarget{}};
  std::optional<Severity> fail_on = Severity::error;  ///< nothing: never
  bool sarif_notes = false;                           ///< as in FormatOptions
  bool timings = false;                               ///< the same
  bool quiet = false;
  TextLayout layout = TextLayout::findings;
  std::optional<Severity> min_severity;  ///< nothing: warnings on a terminal, everything elsewhere
};

struct ValidateRequest : ReportRequest {
  NamedPaths paths;
  /// All except `schemas`, which comes from the files below.
  ValidateOptions validation;
  std::shared_ptr<const PathOptions> by_path;  ///< null: `validation` applies to all paths
  std::vector<std::string> schema_files;
  std::vector<std::string> schema_folders;
  CacheChoice cache;
  std::string product;         ///< file of sizes of products, may be empty
  std::string diff_base;       ///< revision of git since which lines count; may be empty
  std::string baseline;        ///< file to read, may be empty
  std::string write_baseline;  ///< file to write, may be empty
};

/// A page about assets.
struct PageRequest {
  ValidateRequest validate;  ///< except its targets
  ThumbnailOptions thumbnails;
  std::string output;  ///< file; empty: standard output
  std::string title;   ///< empty: the paths
  /// A report of an earlier run as JSON, whose values are shown beside the new ones; may be empty.
  std::string previous;
};

/// Merging reports of several runs.
struct MergeRequest : ReportRequest {
  std::vector<std::string> files;  ///< output of --format jsonl, or pages if `page` is set
  std::string page;                ///< file to write; empty: the reports are not pages
  bool as_loud_as_runs = true;     ///< `fail_on` is that of the runs
};

/// Options shared by the verbs that change assets.
struct EditRequest {
  CommonOptions common;
  NamedPaths paths;
  TableFormat format = TableFormat::text;
  bool restore = false;  ///< restore the copies of --backup, and do nothing else
  bool check = false;    ///< report by the exit code whether there is work to do
  bool raw = false;      ///< diffs keep all characters
  bool quiet = false;
  std::vector<std::string> schema_files;
  std::vector<std::string> schema_folders;
};

struct UpgradeRequest : EditRequest {
  /// All except `schemas`, which comes from the files. `output` is the named file or folder.
  UpgradeOptions upgrade;
};

struct FixRequest : EditRequest {
  FixOptions fix;  ///< likewise
  /// The least severe fix that --check reports; nothing: none.
  std::optional<Severity> fail_on = Severity::hint;
  ValidateOptions validation;  ///< for all paths without overrides: selects the findings to fix
};

struct DeleteRequest : EditRequest {
  DeleteOptions deletion;  ///< likewise
};

struct ConvertRequest : EditRequest {
  ConvertOptions convert;  ///< likewise
};

/// How changes are printed.
enum class CompareFormat : std::uint8_t { text, json, markdown };

struct CompareRequest {
  CommonOptions common;
  std::vector<std::string> paths;  ///< the old one, the new one
  /// All except `schemas`, which comes from the files below.
  CompareOptions compare;
  /// Up to which level the exit code is 0; nothing: storage, or bounds if those were given.
  std::optional<CompareLevel> allow;
  bool has_bounds = false;
  bool all = false;  ///< text lists all changes
  CompareFormat format = CompareFormat::text;
  /// Commits whose assets are compared; empty: none. `paths` restricts them.
  std::string git;
  bool git_driver = false;  ///< `paths` are the arguments that git gives
  bool setup_git = false;   ///< set up git, and do nothing else
  bool global = false;      ///< for all repositories of the user
  std::string output;       ///< file for the page (.html) or else the answer; empty: stdout
  std::string pictures;     ///< folder for pictures; empty: none are written
  std::string picture_url;  ///< prefix of links to them; empty: the folder
  std::vector<std::string> schema_files;
  std::vector<std::string> schema_folders;
};

struct BakeRequest {
  CommonOptions common;
  NamedPaths paths;
  /// All except `schemas`, which comes from the files below, and `cache`. `output` is the named
  /// file or folder.
  BakeOptions bake;
  std::string format = "png";  ///< ending of files in a folder
  std::string sheet;           ///< file for all pictures, may be empty
  std::string compare;         ///< the other asset, may be empty
  CacheChoice cache;
  bool quiet = false;
  std::vector<std::string> schema_files;
  std::vector<std::string> schema_folders;
};

/// How `gltfx inspect` prints an asset.
enum class InspectFormat : std::uint8_t { text, json, outline };

struct InspectRequest {
  CommonOptions common;
  NamedPaths paths;
  /// All except `schemas`, which comes from the files below.
  InspectOptions inspect;
  InspectFormat format = InspectFormat::text;
  std::size_t most = 10;  ///< rows of a table of text; 0: all
  bool quiet = false;
  std::vector<std::string> schema_files;
  std::vector<std::string> schema_folders;
};

/// A verb on the assets of a commit; its paths are further changed names.
struct HookRequest {
  std::variant<ValidateRequest, UpgradeRequest, FixRequest> verb;
};

struct ExplainRequest {
  CommonOptions common;
  std::shared_ptr<const OwnRules> own_rules;  ///< null: none
  std::vector<std::string> codes;
};

struct RulesRequest {
  CommonOptions common;
  std::shared_ptr<const OwnRules> own_rules;  ///< null: none
  TableFormat format = TableFormat::text;
  std::vector<std::string> tests;  ///< pages whose examples are validated, and folders of them
  std::string new_page, new_on;    ///< not empty: the page to write, and what it is about
};

/// How a matrix of engines is printed.
enum class MatrixFormat : std::uint8_t { text, json, markdown };

struct TargetsRequest {
  CommonOptions common;
  MatrixFormat format = MatrixFormat::text;
  std::vector<std::string> names;
  std::vector<TargetChoice> choices;  ///< versions in the matrix
};

struct SchemaRequest {
  CommonOptions common;
  TableFormat format = TableFormat::text;
  std::string name;                      ///< empty: the list
  std::string new_name;                  ///< not empty: the extension of a new schema
  std::vector<schema::Status> statuses;  ///< of the extensions to list; empty: all
  std::vector<std::string> check_files, test_files;
  std::vector<std::string> schema_files;
  std::vector<std::string> schema_folders;
};

struct MeasuresRequest {
  CommonOptions common;
  TableFormat format = TableFormat::text;
  std::string name;  ///< empty: the list
};

struct PresetsRequest {
  CommonOptions common;
  TableFormat format = TableFormat::text;
  std::string id;  ///< empty: the list
};

struct ConfigRequest {
  CommonOptions common;
  ConfigChoice choice;
  std::string path;         ///< path whose settings are shown; empty: all paths
  std::string import_file;  ///< not empty: a file of the Khronos validator or asset auditor
};

using Request =
    std::variant<ValidateRequest, MergeRequest, FixRequest, UpgradeRequest, DeleteRequest,
                 ConvertRequest, CompareRequest, BakeRequest, InspectRequest, PageRequest,
                 HookRequest, ExplainRequest, RulesRequest, TargetsRequest, SchemaRequest,
                 MeasuresRequest, PresetsRequest, ConfigRequest>;

// Parse words of the command line. Each Error is a sentence that names the option, the given value
// and the allowed ones.

/// A whole number of at least `minimum`.
Result<std::uint64_t> parse_number(std::string_view option, std::string_view text,
                                   std::uint64_t minimum);
/// A whole number from `minimum` to `maximum`.
Result<std::uint32_t> parse_count(std::string_view option, std::string_view text,
                                  std::uint32_t minimum, std::uint32_t maximum);
/// A number from `least` to `greatest`.
Result<double> parse_decimal(std::string_view option, std::string_view text, double least,
                             double greatest);
Result<unsigned> parse_jobs(std::string_view option, std::string_view text);
/// "I/N" with I from 1 to N.
Result<Shard> parse_shard(std::string_view option, std::string_view text);
/// NAME or NAME=FILE, no two with the same place.
Result<std::vector<FormatTarget>> parse_targets(std::string_view option,
                                                const std::vector<std::string>& texts);
/// Comma lists of rule codes and names of groups, in any case; an unknown code is an Error with the
/// nearest one.
Result<std::set<std::string, std::less<>>> parse_codes(std::string_view option,
                                                       const std::vector<std::string>& texts,
                                                       const OwnRules* own);
/// CODE=level or GROUP=level, comma lists allowed; the last level of a code counts.
Result<std::map<std::string, Severity, std::less<>>> parse_severities(
    std::string_view option, const std::vector<std::string>& texts, const OwnRules* own);

/// The rule with that code in any case, or null. `own` may be null.
const RuleDescription* rule_from_user(std::string_view code, const OwnRules* own);
/// The rule with that code, or the rules of the group with that name, in any case; or none.
std::vector<std::string_view> codes_from_user(std::string_view name, const OwnRules* own);
/// " Did you mean 'X'?" for the code nearest to `code`, or empty.
std::string suggest_code(std::string_view code, const OwnRules* own);

}  // namespace gltfx::tool

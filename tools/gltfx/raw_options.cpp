// SPDX-License-Identifier: Apache-2.0
#include "raw_options.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "input_paths.hpp"
#include "output.hpp"
#include "reading.hpp"
#include "schema_tests.hpp"
#include "target_choice.hpp"

namespace gltfx::tool {
namespace {

// A word that was not given leaves the value as it is.
template <class T, class Parse>
void read_word(Reading& reading, T& value, const std::string& word, const Parse& parse) {
  if (!word.empty()) reading.set(value, parse(word));
}

void read_budgets(Reading& reading, const RawValidateOptions& words, Budgets& budgets) {
  const auto read = [&](std::uint64_t& limit, std::string_view option, const std::string& word) {
    if (!word.empty()) reading.set(limit, parse_number(option, word, 0));
  };
  read(budgets.texture_size, "--max-texture-size", words.max_texture_size);
  read(budgets.total_pixels, "--max-total-pixels", words.max_total_pixels);
  read(budgets.triangles, "--max-triangles", words.max_triangles);
  read(budgets.draw_calls, "--max-draw-calls", words.max_draw_calls);
  read(budgets.file_size, "--max-file-size", words.max_file_size);
}

void read_listing(Reading& reading, const ListingWords& words, ReportRequest& request) {
  read_word(reading, request.min_severity, words.min_severity, parse_min_severity);
  read_word(reading, request.layout, words.group_by, parse_group_by);
  reading.require(!words.statistics || words.group_by.empty(),
                  "--statistics and --group-by exclude each other.");
  if (words.statistics) request.layout = TextLayout::statistics;
}

bool names_stdin(const std::vector<std::string>& paths) {
  return std::find(paths.begin(), paths.end(), "-") != paths.end();
}

// Of a hook: the commit names files, and pre-commit may name some.
void read_hooked_inputs(Reading& reading, const RawInputOptions& words, std::string_view what,
                        NamedPaths& paths) {
  reading.require(words.files_from.empty() && words.shard.empty(),
                  "hook: the commit says which files; leave out --files-from and --shard.");
  if (!words.paths.empty()) read_inputs(reading, words, what, paths);
}

}  // namespace

void read_inputs(Reading& reading, const RawInputOptions& words, std::string_view what,
                 NamedPaths& paths) {
  reading.require(!words.paths.empty() || !words.files_from.empty(),
                  fmt::format("{}: name at least one file, folder or glob.", what));
  reading.require(words.files_from != "-" || !names_stdin(words.paths),
                  "--files-from: standard input is either a list or an asset.");
  paths.words = words.paths;
  paths.allow_empty = words.allow_empty;
  paths.exclude = words.exclude;
  paths.no_ignore = words.no_ignore;
  reading.set(paths.shard, parse_shard(words.shard));
  reading.set(paths.listed, read_list(words.files_from));
}

void require_files(Reading& reading, const std::vector<std::string>& paths, std::string_view what,
                   std::string_view done) {
  reading.require(!names_stdin(paths),
                  fmt::format("{}: standard input has no file beside which anything could be {}; "
                              "name a file ('./-' for one that is called '-').",
                              what, done));
}

void read_common(Reading& reading, const RawCommonOptions& words, CommonOptions& options) {
  if (words.jobs.empty()) {
    options.jobs = default_jobs();
  } else {
    reading.set(options.jobs, parse_jobs(words.jobs));
  }
  reading.set(options.color, parse_color(words.color));
  options.unsandboxed_decoders = words.unsandboxed_decoders;
}

Result<ValidateRequest> request_of(const RawValidateOptions& words) {
  Reading reading;
  ValidateRequest request;
  read_common(reading, words.common, request.common);
  (words.hook ? read_hooked_inputs : read_inputs)(reading, words.inputs, "validate", request.paths);
  reading.set(request.targets, parse_targets(words.formats));
  for (const FormatTarget& target : request.targets) {
    reading.require(
        words.write_baseline.empty() || !same_place(target.path, words.write_baseline),
        fmt::format("--write-baseline: {} is where --format {} writes.",
                    quoted(words.write_baseline, 200), report_format_name(target.format)));
  }
  read_word(reading, request.fail_on, words.fail_on, parse_fail_on);
  read_word(reading, request.validation.profile, words.profile, parse_profile);
  read_word(reading, request.validation.pixels, words.pixels, parse_pixels);
  read_budgets(reading, words, request.validation.budgets);
  read_word(reading, request.validation.lfs, words.lfs, parse_lfs);
  read_word(reading, request.validation.max_issues, words.max_issues,
            [](const std::string& word) { return parse_number("--max-issues", word, 0); });
  request.validation.inline_suppressions = words.inline_suppressions == "true";
  reading.set(request.validation.select, parse_codes("--select", words.select));
  reading.set(request.validation.ignore, parse_codes("--ignore", words.ignore));
  reading.set(request.validation.severity, parse_severities(words.severities));
  reading.set(request.validation.targets, read_targets(words.targets, words.target_files));
  request.validation.root = words.root;
  read_listing(reading, words.listing, request);
  request.sarif_notes = words.sarif_notes;
  request.timings = words.timings;
  request.quiet = words.quiet;
  request.schema_files = words.schema_files;
  request.schema_folders = words.schema_folders;
  request.cache = {words.cache, words.cache_key};
  reading.require(words.cache_key.empty() || !words.cache.empty(), kKeyWithoutCache);
  request.diff_base = words.diff_base;
  request.baseline = words.baseline;
  request.write_baseline = words.write_baseline;
  // All findings are known then: numbers say enough.
  const bool unasked = words.listing.group_by.empty() && words.listing.min_severity.empty();
  if (!request.write_baseline.empty() && unasked) request.layout = TextLayout::statistics;
  return reading.finish(request);
}

Result<PageRequest> request_of(const RawPageOptions& words, ValidateRequest validate) {
  constexpr std::uint64_t kLeast = 32, kMost = 1024;
  Reading reading;
  PageRequest request;
  reading.require(!words.output.empty(), "report: say where the page goes with --output.");
  std::uint64_t size = 0;
  reading.set(size, parse_number("--thumbnail-size", words.thumbnail_size, kLeast));
  reading.require(size <= kMost, "--thumbnail-size: from 32 to 1024 pixels.");
  request.thumbnails.size = static_cast<std::uint32_t>(size);
  request.thumbnails.draw = !words.no_thumbnails;
  if (!words.quality.empty()) {
    BakeQuality quality{};
    reading.set(quality, parse_quality(words.quality));
    request.thumbnails.quality = quality;
  }
  request.output = words.output == "-" ? std::string() : words.output;
  request.title = words.title;
  request.validate = std::move(validate);
  return reading.finish(request);
}

Result<MergeRequest> request_of(const RawMergeOptions& words) {
  Reading reading;
  MergeRequest request;
  read_common(reading, words.common, request.common);
  reading.require(!words.files.empty(),
                  "merge: name the reports, written with --format jsonl=FILE.");
  const bool pages = std::any_of(words.files.begin(), words.files.end(),
                                 [](const auto& file) { return ending_of(file) == ".html"; });
  reading.require(!pages || !words.output.empty(),
                  "merge: say where the page of all assets goes with --output.");
  reading.require(words.output.empty() || words.formats.empty(),
                  "merge: --output is for pages and --format for reports; use one of them.");
  request.page = words.output;
  request.files = words.files;
  reading.set(request.targets, parse_targets(words.formats));
  read_word(reading, request.fail_on, words.fail_on, parse_fail_on);
  request.as_loud_as_runs = words.fail_on.empty();
  read_listing(reading, words.listing, request);
  request.sarif_notes = words.sarif_notes;
  request.quiet = words.quiet;
  return reading.finish(request);
}

namespace {

// What the verbs that change assets ask in the same words.
void read_edit(Reading& reading, const RawEditOptions& words, std::string_view verb,
               EditRequest& request, EditOptions& options) {
  read_common(reading, words.common, request.common);
  (words.hook ? read_hooked_inputs : read_inputs)(reading, words.inputs, verb, request.paths);
  require_files(reading, words.inputs.paths, verb, "found or written");
  const auto require = [&](bool holds, std::string_view text) {
    reading.require(holds, fmt::format("{}: {}", verb, text));
  };
  reading.require(!words.hook || words.output.empty(),
                  "hook: the files of a commit stay where they are; leave out --output.");
  const bool writes = words.in_place || !words.output.empty();
  require(!words.in_place || words.output.empty(),
          "--in-place and --output are mutually exclusive.");
  require(!words.check || !writes, "--check writes nothing; leave out --in-place and --output.");
  require(!words.restore || !(writes || words.check || words.diff || words.backup),
          "--restore puts back backups; leave out other actions.");
  require(!words.raw || words.diff, "--raw goes with --diff.");
  require(!words.backup || words.in_place, "--backup goes with --in-place.");
  reading.set(request.format, parse_table_format(words.format));
  request.restore = words.restore;
  request.check = words.check;
  request.raw = words.raw;
  request.quiet = words.quiet;
  request.schema_files = words.schema_files;
  request.schema_folders = words.schema_folders;
  options.diff = words.diff;
  options.in_place = words.in_place;
  options.backup = words.backup;
  options.output = words.output;
  options.root = words.root;
}

// A fix that loses something is asked for by its name and by --unsafe.
std::string find_unasked(const FixOptions& options) {
  for (const std::string& code : options.only) {
    const Fix kind = find_rule(code)->fix;
    if (kind == Fix::unsafe && !options.unsafe) {
      return fmt::format("--only: the fix of {} is unsafe; add --unsafe.", code);
    }
    if (kind == Fix::upgrade) {
      return fmt::format("--only: 'gltfx upgrade' fixes {}.", code);
    }
    if (kind == Fix::none) return fmt::format("--only: {} has no fix.", code);
  }
  return options.unsafe && options.only.empty()
             ? "fix: --unsafe goes with --only, which names the fixes."
             : std::string();
}

}  // namespace

Result<UpgradeRequest> request_of(const RawUpgradeOptions& words) {
  Reading reading;
  UpgradeRequest request;
  read_edit(reading, words, "upgrade", request, request.upgrade);
  reading.require(words.ior == "0" || words.ior == "1000", "upgrade: --ior is 0 or 1000.");
  request.upgrade.ior = words.ior == "0" ? 0 : 1000;
  request.upgrade.only = words.only;
  request.upgrade.to = words.to;
  request.upgrade.generation = words.generation;
  request.upgrade.unsafe = words.unsafe;
  request.upgrade.strict = words.strict;
  request.upgrade.pack = words.pack;
  request.upgrade.prune = words.prune;
  request.upgrade.verify = words.verify;
  reading.set(request.upgrade.targets, read_targets(words.targets, words.target_files));
  return reading.finish(request);
}

Result<DeleteRequest> request_of(const RawDeleteOptions& words) {
  Reading reading;
  DeleteRequest request;
  read_edit(reading, words, "edit", request, request.deletion);
  reading.require(words.restore || !words.pointers.empty(),
                  "edit: name what is to go: --delete POINTER.");
  request.deletion.pointers = words.pointers;
  request.deletion.cascade = words.cascade;
  return reading.finish(request);
}

Result<FixRequest> request_of(const RawFixOptions& words) {
  Reading reading;
  FixRequest request;
  read_edit(reading, words, "fix", request, request.fix);
  read_word(reading, request.fail_on, words.validate.fail_on, parse_fail_on);
  reading.set(request.fix.only, parse_codes("--only", words.only));
  reading.set(request.fix.skip, parse_codes("--skip", words.skip));
  request.fix.unsafe = words.unsafe;
  const std::string unasked = find_unasked(request.fix);
  reading.require(unasked.empty(), unasked);
  return reading.finish(request);
}

Result<InspectRequest> request_of(const RawInspectOptions& words) {
  Reading reading;
  InspectRequest request;
  read_common(reading, words.common, request.common);
  reading.require(!words.paths.empty(), "inspect: name at least one file, folder or glob.");
  require_files(reading, words.paths, "inspect");
  request.paths.words = words.paths;
  request.paths.allow_empty = words.allow_empty;
  request.paths.exclude = words.exclude;
  request.paths.no_ignore = words.no_ignore;
  reading.set(request.format, parse_table_format(words.format));
  std::uint64_t most = 0;
  reading.set(most, parse_number("--top", words.top, 0));
  request.most = static_cast<std::size_t>(most);
  request.inspect.root = words.root;
  request.quiet = words.quiet;
  request.schema_files = words.schema_files;
  request.schema_folders = words.schema_folders;
  return reading.finish(request);
}

Result<ExplainRequest> request_of(const RawExplainOptions& words) {
  Reading reading;
  ExplainRequest request;
  read_common(reading, words.common, request.common);
  reading.require(!words.codes.empty(), "explain: name a code; 'gltfx rules' lists them all.");
  request.codes = words.codes;
  return reading.finish(request);
}

Result<RulesRequest> request_of(const RawRulesOptions& words) {
  Reading reading;
  RulesRequest request;
  read_common(reading, words.common, request.common);
  reading.set(request.format, parse_table_format(words.format));
  return reading.finish(request);
}

Result<TargetsRequest> request_of(const RawTargetsOptions& words) {
  Reading reading;
  TargetsRequest request;
  read_common(reading, words.common, request.common);
  reading.set(request.format, parse_matrix_format(words.format));
  std::vector<std::string> names = words.names;
  names.insert(names.end(), words.targets.begin(), words.targets.end());
  if (names.empty()) names = target_names(words.target_files);
  reading.set(request.choices, read_targets(names, words.target_files));
  return reading.finish(request);
}

Result<SchemaRequest> request_of(const RawSchemaOptions& words) {
  Reading reading;
  SchemaRequest request;
  read_common(reading, words.common, request.common);
  reading.set(request.format, parse_table_format(words.format));
  reading.require(words.names.size() <= 1, "schema: name one extension or core type at a time.");
  if (!words.names.empty()) request.name = words.names.front();
  const bool writes = !words.new_name.empty();
  const bool checks = !words.check_files.empty() || !words.test_files.empty();
  reading.require(words.names.size() + (writes ? 1U : 0U) + (checks ? 1U : 0U) <= 1,
                  "schema: use a name, --new, or --check and --test.");
  for (const std::string& name : words.statuses) {
    reading.set(request.statuses.emplace_back(), parse_status(name));
  }
  reading.require(words.statuses.empty() || (words.names.empty() && !writes && !checks),
                  "--status: it chooses from the list of extensions.");
  reading.require(!writes || is_extension_name(words.new_name),
                  "--new: an extension is named PREFIX_name, such as ACME_leaf.");
  request.new_name = words.new_name;
  request.check_files = words.check_files;
  request.test_files = words.test_files;
  request.schema_files = words.schema_files;
  request.schema_folders = words.schema_folders;
  return reading.finish(request);
}

Result<ConfigRequest> request_of(const RawConfigOptions& words) {
  Reading reading;
  ConfigRequest request;
  read_common(reading, words.common, request.common);
  request.choice = words.configuration;
  const bool import = !words.words.empty() && words.words.front() == "import";
  reading.require(!import || words.words.size() == 2, "config: import takes one file.");
  reading.require(import || words.words.size() <= 1, "config: name one path at a time.");
  if (import) {
    request.import_file = words.words.back();
  } else if (!words.words.empty()) {
    request.path = words.words.front();
  }
  return reading.finish(request);
}

}  // namespace gltfx::tool

// SPDX-License-Identifier: Apache-2.0
// The verbs that write reports: from assets, as a page, and from other reports.
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "measure/limit.hpp"
#include "option_parts.hpp"
#include "option_values.hpp"
#include "output.hpp"
#include "presets.hpp"
#include "verb_options.hpp"

namespace gltfx::tool {
namespace {

using measure::LimitChange;

// Changes limits by the words of an option. A function (option, word) gives the changes.
template <class Read>
Binding changes(std::vector<Limit>& limits, Read read, bool repeatable) {
  return {
      .read = [&limits, read](std::string_view option, const Words& words) -> std::optional<Error> {
        for (const std::string& word : words) {
          auto changes = read(option, word);
          if (!changes) return changes.error();
          for (const LimitChange& change : *changes) measure::apply(limits, change);
        }
        return {};
      },
      .repeatable = repeatable};
}

// An option for one maximum; 0 is none.
void add_maximum(Options& options, std::vector<Limit>& limits, std::string_view names,
                 std::string_view type, std::string_view text, MeasureScope on,
                 std::string_view measure) {
  const auto read = [on, measure](std::string_view option,
                                  std::string_view word) -> Result<std::vector<LimitChange>> {
    const auto most = parse_number(option, word, 0);
    if (!most) return most.error();
    LimitChange change{find_measure(on, measure), on, LimitOp::max, {}};
    if (*most > 0) {
      Limit limit;
      limit.measure = change.measure;
      limit.on = on;
      limit.number = static_cast<double>(*most);
      limit.from = option;
      change.limits.push_back(std::move(limit));
    }
    std::vector<LimitChange> changes{std::move(change)};
    // Whatever the file says of the asset as a whole.
    if (on != MeasureScope::asset) {
      const auto* total = find_measure(MeasureScope::asset, measure);
      changes.push_back({total, MeasureScope::asset, LimitOp::max, {}});
    }
    return changes;
  };
  // Read again for paths with limits of their own.
  options.add(names, type, text, changes(limits, read, false), {.by_path = true});
}

void add_budgets(Options& options, std::vector<Limit>& limits) {
  options.limits = &limits;
  Binding preset = changes(
      limits,
      [](std::string_view option, std::string_view word) -> Result<std::vector<LimitChange>> {
        auto read = read_preset(word);
        if (!read) return Error{fmt::format("{}: {}", option, read.error().message)};
        return std::move(read->limits);
      },
      true);
  preset.values = values::preset_choice;
  options.add("--preset", "ID", "Published limits, see 'gltfx presets' (repeatable)",
              std::move(preset), {.by_path = true});
  Binding budget = changes(
      limits,
      [](std::string_view option, std::string_view word) -> Result<std::vector<LimitChange>> {
        auto read = measure::read_budget(word, option);
        if (!read) {
          const std::string& problem = read.error().message;
          return Error{fmt::format("{}: {}{}", option, problem, problem.ends_with('?') ? "" : ".")};
        }
        return read;
      },
      true);
  budget.values = values::measure_choice;
  options.add("--budget", "[SCOPE.]MEASURE=LIMIT",
              "Limit, such as mesh.vertices=65535 (repeatable)", std::move(budget),
              {.name = "budgets",
               .form = ConfigForm::limits,
               .place = 200,
               .otherwise = "none",
               .by_path = true,
               .adds_up = true});
  add_maximum(options, limits, "--max-texture-size", "PIXELS",
              "Maximum image width and height (default: 0, off)", MeasureScope::image,
              "texture-size");
  add_maximum(options, limits, "--max-total-pixels", "PIXELS",
              "Maximum pixels of all images (default: 0, off)", MeasureScope::asset,
              "total-pixels");
  add_maximum(options, limits, "--max-triangles", "N",
              "Maximum triangles of all meshes (default: 0, off)", MeasureScope::asset,
              "triangles");
  add_maximum(options, limits, "--max-draw-calls", "N",
              "Maximum primitives that are drawn (default: 0, off)", MeasureScope::asset,
              "draw-calls");
  add_maximum(options, limits, "--max-file-size", "BYTES",
              "Maximum size with resources (default: 0, off)", MeasureScope::asset, "file-size");
}

Result<std::uint64_t> parse_thumbnail_size(std::string_view option, std::string_view word) {
  auto size = parse_number(option, word, 32);
  if (size && *size > 1024) return Error{"--thumbnail-size: from 32 to 1024 pixels."};
  return size;
}

}  // namespace

void add_selection(Options& options, ValidateOptions& validation) {
  options.add("--profile", "NAME", "default, khronos (as the Khronos validator), strict",
              one_of(validation.profile, {{"default", Profile::standard},
                                          {"khronos", Profile::khronos},
                                          {"strict", Profile::strict}}),
              {.name = "profile", .place = 10, .otherwise = "default"});
  options.add("--select", "CODES", "Only these codes (comma-separated, repeatable)",
              codes(options, validation.select),
              {.name = "select",
               .form = ConfigForm::codes,
               .place = 40,
               .otherwise = "all",
               .by_path = true});
  options.add("--ignore", "CODES", "Not these codes (comma-separated, repeatable)",
              codes(options, validation.ignore),
              {.name = "ignore",
               .form = ConfigForm::codes,
               .place = 50,
               .otherwise = "none",
               .by_path = true,
               .adds_up = true});
  options.add("--severity", "CODE=LEVEL", "Severity of a code (repeatable)",
              parsed_list(
                  validation.severity,
                  [&options](std::string_view option, const Words& words) {
                    return parse_severities(option, words, options.own_rules().get());
                  },
                  values::code_levels),
              {.name = "severity",
               .form = ConfigForm::levels,
               .place = 60,
               .otherwise = "as 'gltfx rules' says",
               .by_path = true,
               .adds_up = true});
  options.add("--inline-suppressions", "", "Apply suppressions in extras.gltfx, also of errors",
              flag(validation.inline_suppressions),
              {.name = "inline-suppressions",
               .form = ConfigForm::flag,
               .place = 90,
               .otherwise = "false",
               .by_path = true});
}

void add_checks(Options& options, ValidateOptions& validation) {
  options.add(
      "--max-issues", "N", "Maximum findings per file (default: 0, no limit)",
      number(validation.max_issues),
      {.name = "max-issues", .form = ConfigForm::number, .place = 70, .otherwise = "0, no limit"});
  options.add(
      "--pixels", "LEVEL", "Decode images: headers (none, default), needed, all",
      one_of(validation.pixels, {{"headers", PixelLevel::headers},
                                 {"needed", PixelLevel::needed},
                                 {"all", PixelLevel::all}}),
      {.name = "pixels", .place = 20, .otherwise = "headers; needed in the strict profile"});
  add_budgets(options, validation.limits);
  add_targets(options, validation.targets);
  add_root(options, validation.root);
  options.add("--lfs", "POLICY", "Git LFS pointers: skip (default) or error",
              one_of(validation.lfs, {{"skip", LfsPolicy::skip}, {"error", LfsPolicy::error}}),
              {.name = "lfs", .place = 80, .otherwise = "skip", .by_path = true});
}

void declare_checks(Options& options, ValidateRequest& request) {
  add_fail_on(options, request.fail_on, "Exit 1 at error (default), warning, info or never",
              fail_on_key());
  add_selection(options, request.validation);
  add_own_rules(options, request.validation.own_rules);
  add_checks(options, request.validation);
  add_schema_sources(options, request.schema_files, request.schema_folders);
  add_inputs(options, request.paths);
  options.add("--product", "FILE", "Sizes of products, for product-deviation",
              text(request.product,
                   [] {
                     return values::files({"csv", "json"});
                   }),
              {.name = "product", .form = ConfigForm::path, .place = 210, .otherwise = "none"});
  add_cache(options, request.cache, "Cache of reports of unchanged files");
  options.add("--baseline", "FILE", "Ignore the findings recorded in FILE",
              text(request.baseline, values::json_file),
              {.name = "baseline", .form = ConfigForm::path, .place = 140, .otherwise = "none"});
}

void declare_validate(Options& options, ValidateRequest& request) {
  add_asset_arguments(options, request.paths, "Files, folders (recursive), globs, or - for stdin");
  add_report_formats(options, request);
  add_listing(options, request);
  add_sarif_notes(options, request);
  options.add("--timings", "", "Report the time per file (junit, jsonl)", flag(request.timings));
  declare_checks(options, request);
  options.add("--write-baseline", "FILE", "Record all findings in FILE, list none, exit 0",
              text(request.write_baseline, values::json_file));
  options.add("--diff-base", "REVISION", "Only findings on lines changed since this Git ref",
              text(request.diff_base));
  add_quiet(options, request.quiet, "Print findings only, no summary and no notes");
  add_configuration(options);
  add_decoders(options, request.common);
  add_common(options, request.common);
}

void read_validate(Reading& reading, ValidateRequest& request) {
  const Options& options = reading.options();
  reading.require_inputs("validate");
  reading.require_companions();
  reading.read();
  for (const FormatTarget& target : request.targets) {
    reading.require(
        request.write_baseline.empty() || !same_place(target.path, request.write_baseline),
        fmt::format("--write-baseline: {} is where --format {} writes.",
                    quoted(request.write_baseline, 200), report_format_name(target.format)));
  }
  request.by_path = options.by_path;
  request.own_rules = options.own_rules();
  // All findings are then known: counts are enough.
  const bool unasked = !options.given("--group-by") && !options.given("--min-severity");
  if (!request.write_baseline.empty() && unasked) request.layout = TextLayout::statistics;
}

void declare_report(Options& options, PageRequest& request) {
  add_asset_arguments(options, request.validate.paths);
  options.add("-o,--output", "FILE", "Output .html file, or - for stdout",
              text(request.output, [] { return values::files({"html"}); }));
  options.add("--title", "TEXT", "Title of the page (default: the paths)", text(request.title));
  options.add("--previous", "FILE", "JSON report of an earlier run to compare with",
              text(request.previous, values::json_file));
  options.add("--no-thumbnails", "", "Render no previews", set_to(request.thumbnails.draw, false));
  options.add("--thumbnail-size", "PIXELS", "Preview size, 32 to 1024 (default: 160)",
              parsed(request.thumbnails.size, parse_thumbnail_size));
  add_quality(options, request.thumbnails.quality,
              "Previews: draft (above 200 assets), standard, final");
  declare_checks(options, request.validate);
  add_quiet(options, request.validate.quiet, "Print errors only, no progress and no summary");
  add_configuration(options);
  add_decoders(options, request.validate.common);
  add_common(options, request.validate.common);
}

void read_report(Reading& reading, PageRequest& request) {
  reading.require_inputs("report");
  reading.require_files("report");
  reading.require_companions();
  reading.read();
  reading.require(!request.output.empty(), "report: say where the page goes with --output.");
  if (request.output == "-") request.output.clear();
  request.validate.by_path = reading.options().by_path;
  request.validate.own_rules = reading.options().own_rules();
}

void declare_merge(Options& options, MergeRequest& request) {
  options.positional("REPORT", "Files of validate --format jsonl, or report pages",
                     list(request.files, [] { return values::files({"jsonl"}); }));
  add_report_formats(options, request);
  options.add("-o,--output", "FILE", "Page of the pages of report --shard", text(request.page));
  add_listing(options, request);
  add_sarif_notes(options, request);
  add_fail_on(options, request.fail_on, "Exit 1 at error, warning, info, never (else as run)");
  add_own_rules(options, request.own_rules);
  add_configuration(options);
  add_quiet(options, request.quiet, "Print findings only, no summary and no notes");
  add_color(options, request.common);
}

void read_merge(Reading& reading, MergeRequest& request) {
  const Options& options = reading.options();
  const Words& files = options.arguments().words;
  reading.require(!files.empty(), "merge: name the reports, written with --format jsonl=FILE.");
  const bool pages = std::any_of(files.begin(), files.end(),
                                 [](const auto& file) { return ending_of(file) == ".html"; });
  reading.require(!pages || options.given("--output"),
                  "merge: say where the page of all assets goes with --output.");
  reading.require(!options.given("--output") || !options.given("--format"),
                  "merge: --output is for pages and --format for reports; use one of them.");
  reading.require_companions();
  reading.read();
  request.as_loud_as_runs = !options.given("--fail-on");
  request.own_rules = options.own_rules();
}

}  // namespace gltfx::tool

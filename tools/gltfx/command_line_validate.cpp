// SPDX-License-Identifier: Apache-2.0
// The verbs that validate: into formats, or into a page.
#include <CLI/CLI.hpp>

#include "command_line_parts.hpp"

namespace gltfx::tool {
namespace {

void declare_filters(CLI::App& app, RawValidateOptions& words) {
  add_word(app, "--profile", words.profile, "NAME",
           "default, khronos (as the Khronos validator), strict");
  add_list(app, "--select", words.select, "CODES",
           "Only these codes (comma-separated, repeatable)");
  add_list(app, "--ignore", words.ignore, "CODES", "Not these codes (comma-separated, repeatable)");
  add_list(app, "--severity", words.severities, "CODE=LEVEL", "Severity of a code (repeatable)");
  app.add_flag_callback(
      "--inline-suppressions", [&words] { words.inline_suppressions = "true"; },
      "Apply suppressions in extras.gltfx, also of errors");
  add_word(app, "--max-issues", words.max_issues, "N",
           "Maximum findings per file (default: 0, no limit)");
}

void declare_budgets(CLI::App& app, RawValidateOptions& words) {
  add_word(app, "--max-texture-size", words.max_texture_size, "PIXELS",
           "Maximum image width and height (default: 0, off)");
  add_word(app, "--max-total-pixels", words.max_total_pixels, "PIXELS",
           "Maximum pixels of all images (default: 0, off)");
  add_word(app, "--max-triangles", words.max_triangles, "N",
           "Maximum number of triangles (default: 0, off)");
  add_word(app, "--max-draw-calls", words.max_draw_calls, "N",
           "Maximum number of primitives (default: 0, off)");
  add_word(app, "--max-file-size", words.max_file_size, "BYTES",
           "Maximum size with resources (default: 0, off)");
}

// What both verbs ask in the same words.
void declare_checks(CLI::App& app, RawValidateOptions& words) {
  add_fail_on(app, words.fail_on, "Exit 1 at error (default), warning, info or never");
  declare_filters(app, words);
  add_word(app, "--pixels", words.pixels, "LEVEL",
           "Decode images: headers (none, default), needed, all");
  declare_budgets(app, words);
  add_root(app, words.root);
  add_word(app, "--lfs", words.lfs, "POLICY", "Git LFS pointers: skip (default) or error");
  add_schema_sources(app, words.schema_files, words.schema_folders);
  add_inputs(app, words.inputs);
  add_word(app, "--cache", words.cache, "DIR", "Cache of reports of unchanged files");
  add_word(app, "--cache-key", words.cache_key, "FILE",
           "Key of --cache (default: $GLTFX_CACHE_KEY)");
  add_word(app, "--baseline", words.baseline, "FILE", "Ignore the findings recorded in FILE");
}

}  // namespace

void declare_validate(CLI::App& app, RawValidateOptions& words) {
  describe_positional(app, "PATH", "Files, folders (recursive), globs, or - for stdin");
  add_formats(app, words.formats);
  add_listing(app, words.listing);
  add_sarif_notes(app, words.sarif_notes);
  app.add_flag("--timings", words.timings, "Report the time per file (junit, jsonl)");
  declare_checks(app, words);
  add_word(app, "--write-baseline", words.write_baseline, "FILE",
           "Record all findings in FILE and exit 0");
  add_word(app, "--diff-base", words.diff_base, "REVISION",
           "Only findings on lines changed since this Git ref");
  app.add_flag("-q,--quiet", words.quiet, "Print findings only, no summary and no notes");
  add_configuration(app, words.configuration);
  add_decoders(app, words.common);
  add_common(app, words.common);
}

void declare_report(CLI::App& app, RawPageOptions& words) {
  describe_positional(app, "PATH", "Files, folders (recursive) or globs");
  add_word(app, "-o,--output", words.output, "FILE", "Output .html file, or - for stdout");
  add_word(app, "--title", words.title, "TEXT", "Title of the page (default: the paths)");
  app.add_flag("--no-thumbnails", words.no_thumbnails, "Render no previews");
  add_word(app, "--thumbnail-size", words.thumbnail_size, "PIXELS",
           "Preview size, 32 to 1024 (default: 160)");
  declare_checks(app, words.validate);
  app.add_flag("-q,--quiet", words.validate.quiet, "Print errors only, no progress and no summary");
  add_configuration(app, words.validate.configuration);
  add_decoders(app, words.validate.common);
  add_common(app, words.validate.common);
}

}  // namespace gltfx::tool

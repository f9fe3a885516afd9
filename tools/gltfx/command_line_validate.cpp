// SPDX-License-Identifier: Apache-2.0
// The verbs that validate: into formats, or into a page.
#include <CLI/CLI.hpp>

#include "command_line_parts.hpp"

namespace gltfx::tool {
namespace {

void declare_filters(CLI::App& app, ValidateWords& words) {
  add_word(app, "--profile", words.profile, "NAME",
           "default, khronos (what the Khronos validator reports) or strict (hints too)");
  add_list(app, "--select", words.select, "CODES", "Only these codes (comma list, repeatable)");
  add_list(app, "--ignore", words.ignore, "CODES", "Not these codes (comma list, repeatable)");
  add_list(app, "--severity", words.severities, "CODE=LEVEL",
           "Report a code as error, warning, info or hint (repeatable)");
  app.add_flag_callback(
      "--inline-suppressions", [&words] { words.inline_suppressions = "true"; },
      "Leave out what assets ignore in extras.gltfx, errors too");
  add_word(app, "--max-issues", words.max_issues, "N",
           "Findings listed for each file, 0 for no limit (default: 0)");
}

void declare_budgets(CLI::App& app, ValidateWords& words) {
  add_word(app, "--max-texture-size", words.max_texture_size, "PIXELS",
           "Budget for the longer side of an image, 0 for no limit (default: 0)");
  add_word(app, "--max-total-pixels", words.max_total_pixels, "PIXELS",
           "Budget for all images together, 0 for no limit (default: 0)");
  add_word(app, "--max-triangles", words.max_triangles, "N",
           "Budget for triangles, 0 for no limit (default: 0)");
  add_word(app, "--max-draw-calls", words.max_draw_calls, "N",
           "Budget for primitives, 0 for no limit (default: 0)");
  add_word(app, "--max-file-size", words.max_file_size, "BYTES",
           "Budget for the file and those it refers to, 0 for no limit (default: 0)");
}

// What both verbs ask in the same words.
void declare_checks(CLI::App& app, ValidateWords& words) {
  add_fail_on(app, words.fail_on, "error");
  declare_filters(app, words);
  add_word(app, "--pixels", words.pixels, "LEVEL",
           "Images to decode: headers (none; khronos: always), needed (strict: default) or all");
  declare_budgets(app, words);
  add_root(app, words.root);
  add_word(app, "--lfs", words.lfs, "POLICY",
           "Git-LFS pointers instead of files: skip or error (default: skip)");
  add_schema_sources(app, words.schema_files, words.schema_folders);
  add_inputs(app, words.inputs);
  add_word(app, "--cache", words.cache, "DIR",
           "Keep reports there, and take those of files that did not change from there");
  add_word(app, "--cache-key", words.cache_key, "FILE",
           "File with the key of --cache (default: $GLTFX_CACHE_KEY or your own)");
  add_word(app, "--baseline", words.baseline, "FILE", "Leave out findings that FILE knows");
}

}  // namespace

void declare_validate(CLI::App& app, ValidateWords& words) {
  describe_positional(app, "PATH",
                      "Files, folders (searched through), globs, or - for standard input");
  add_formats(app, words.formats);
  add_listing(app, words.listing);
  add_sarif_notes(app, words.sarif_notes);
  app.add_flag("--timings", words.timings, "Record how long each file took (junit, jsonl)");
  declare_checks(app, words);
  add_word(app, "--write-baseline", words.write_baseline, "FILE",
           "Record all findings in FILE and exit with 0 for them");
  add_word(app, "--diff-base", words.diff_base, "REVISION",
           "Only findings on lines that changed since then (git), all of new and binary files");
  app.add_flag("-q,--quiet", words.quiet, "Findings only: no summary, no notes");
  add_configuration(app, words.configuration);
  add_decoders(app, words.common);
  add_common(app, words.common);
}

void declare_report(CLI::App& app, PageWords& words) {
  describe_positional(app, "PATH", "Files, folders (searched through) or globs");
  add_word(app, "-o,--output", words.output, "FILE",
           "The page, one .html file; - for standard output");
  add_word(app, "--title", words.title, "TEXT", "Of the page (default: the paths)");
  app.add_flag("--no-thumbnails", words.no_thumbnails,
               "Draw no pictures, which takes most of the time");
  add_word(app, "--thumbnail-size", words.thumbnail_size, "PIXELS",
           "From 32 to 1024 (default: 160)");
  declare_checks(app, words.validate);
  app.add_flag("-q,--quiet", words.validate.quiet, "Problems only: no progress, no summary");
  add_configuration(app, words.validate.configuration);
  add_decoders(app, words.validate.common);
  add_common(app, words.validate.common);
}

}  // namespace gltfx::tool

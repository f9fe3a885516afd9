// SPDX-License-Identifier: Apache-2.0
// The verbs that validate: into formats, or into a page.
#include <CLI/CLI.hpp>

#include "command_line_parts.hpp"

namespace gltfx::tool {
namespace {

void declare_outputs(CLI::App& app, RawBakeOptions& words) {
  add_word(app, "-o,--output", words.output, "FILE|DIR",
           "Output .png, .webp, .jpg or .exr file, or a folder");
  add_word(app, "-f,--format", words.format, "NAME",
           "Format in a folder: png (default), webp, jpeg, exr");
  add_word(app, "--sheet", words.sheet, "FILE", "Contact sheet (default: DIR/contact-sheet.png)");
  add_list(app, "--size", words.sizes, "N|WxH", "Size in pixels (default: 512; repeatable)");
  add_word(app, "--turntable", words.turntable, "N", "Number of pictures of a full rotation");
  add_list(app, "--layer", words.layers, "NAME", "Extra layer: albedo, normal, depth, material");
  app.add_flag("--transparent", words.transparent, "Transparent background");
  app.add_flag("--embed", words.embed, "Embed the picture as the thumbnail of the asset");
  add_word(app, "--compare", words.compare, "PATH",
           "Compare with PATH; write the difference to -o");
}

void declare_scene(CLI::App& app, RawBakeOptions& words) {
  add_word(app, "--camera", words.camera, "NAME|N|AZ,EL",
           "Asset camera, front, top, iso or azimuth,elevation");
  add_word(app, "--projection", words.projection, "NAME", "perspective (default) or orthographic");
  add_word(app, "--interior", words.interior, "WHEN", "View from inside: auto (default), on, off");
  add_word(app, "--frame", words.frame, "NODE", "Frame this node: name, index or /nodes/N");
  add_word(app, "--lights", words.lights, "WHICH", "Lights: asset, studio or both (default)");
  add_word(app, "--environment", words.environment, "FILE",
           "Equirectangular environment map, .hdr or .exr");
  add_word(app, "--exposure", words.exposure, "STOPS", "Exposure in stops (default: 0)");
  add_word(app, "--scene", words.scene, "NAME|N", "Scene (default: that of the asset)");
  add_word(app, "--animation", words.animation, "NAME|N", "Animation to pose the asset with");
  add_word(app, "--time", words.time, "SECONDS", "Time in the animation (default: 0)");
  add_word(app, "--variant", words.variant, "NAME|N", "Material variant");
  app.add_flag("--strict", words.strict, "Refuse every asset that has errors");
}

void declare_quality(CLI::App& app, RawBakeOptions& words) {
  add_word(app, "--quality", words.quality, "NAME", "Quality: draft, standard (default) or final");
  add_word(app, "--samples", words.samples, "N",
           "Samples per pixel (4, up to 44 or 256 by --quality)");
  add_word(app, "--bounces", words.bounces, "N", "Maximum path depth (default: 6; final 12)");
  add_word(app, "--seed", words.seed, "N", "Random seed (default: 0)");
  add_word(app, "--denoise", words.denoise, "on|off", "Denoise the picture (default: on)");
  add_word(app, "--noise", words.noise, "TARGET",
           "Target error per pixel, 0 to 1 (default: 0, off)");
  add_word(app, "--time-budget", words.time_budget, "SECONDS",
           "Time limit per picture; not reproducible");
  add_word(app, "--shader", words.shader, "NAME", "Shading: conserving (default) or spec");
}

void declare_filters(CLI::App& app, RawValidateOptions& words) {
  add_selection(app, words);
  add_word(app, "--max-issues", words.max_issues, "N",
           "Maximum findings per file (default: 0, no limit)");
}

void declare_budgets(CLI::App& app, RawValidateOptions& words) {
  add_word(app, "--max-texture-size", words.max_texture_size, "PIXELS",
           "Maximum image width and height (default: 0, off)");
  add_word(app, "--max-total-pixels", words.max_total_pixels, "PIXELS",
           "Maximum pixels of all images (default: 0, off)");
  add_word(app, "--max-triangles", words.max_triangles, "N",
           "Maximum triangles of all meshes (default: 0, off)");
  add_word(app, "--max-draw-calls", words.max_draw_calls, "N",
           "Maximum primitives of all meshes (default: 0, off)");
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
  add_targets(app, words.targets, words.target_files);
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

void declare_bake(CLI::App& app, RawBakeOptions& words) {
  describe_positional(app, "PATH", "Files, folders (recursive) or globs");
  declare_outputs(app, words);
  declare_scene(app, words);
  declare_quality(app, words);
  add_inputs(app, words.inputs);
  add_word(app, "--cache", words.cache, "DIR",
           "Skip pictures that are up to date, as noted in DIR");
  add_word(app, "--cache-key", words.cache_key, "FILE",
           "Key of --cache (default: $GLTFX_CACHE_KEY)");
  add_root(app, words.root);
  add_schema_sources(app, words.schema_files, words.schema_folders);
  app.add_flag("-q,--quiet", words.quiet, "Print errors only, no progress and no files");
  add_configuration(app, words.configuration);
  add_decoders(app, words.common);
  add_common(app, words.common);
}

void declare_validate(CLI::App& app, RawValidateOptions& words) {
  describe_positional(app, "PATH", "Files, folders (recursive), globs, or - for stdin");
  add_formats(app, words.formats);
  add_listing(app, words.listing);
  add_sarif_notes(app, words.sarif_notes);
  app.add_flag("--timings", words.timings, "Report the time per file (junit, jsonl)");
  declare_checks(app, words);
  add_word(app, "--write-baseline", words.write_baseline, "FILE",
           "Record all findings in FILE, list none, exit 0");
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
  add_word(app, "--quality", words.quality, "NAME",
           "Previews: draft (above 200 assets), standard, final");
  declare_checks(app, words.validate);
  app.add_flag("-q,--quiet", words.validate.quiet, "Print errors only, no progress and no summary");
  add_configuration(app, words.validate.configuration);
  add_decoders(app, words.validate.common);
  add_common(app, words.validate.common);
}

void declare_config(CLI::App& app, RawConfigOptions& words) {
  describe_positional(app, "PATH", "Path, or import FILE of the Khronos validator");
  add_configuration(app, words.configuration);
  add_color(app, words.common);
}

void declare_inspect(CLI::App& app, RawInspectOptions& words) {
  describe_positional(app, "PATH", "Files, folders (recursive) or globs");
  add_word(app, "-f,--format", words.format, "NAME", "Output format: text (default) or json");
  add_word(app, "--top", words.top, "N", "Rows per table, largest first (default: 10, 0: all)");
  add_search(app, words.exclude, words.no_ignore, words.allow_empty);
  add_root(app, words.root);
  add_schema_sources(app, words.schema_files, words.schema_folders);
  app.add_flag("-q,--quiet", words.quiet, "Print no notes");
  add_configuration(app, words.configuration);
  add_common(app, words.common);
}

void declare_merge(CLI::App& app, RawMergeOptions& words) {
  describe_positional(app, "REPORT", "Files of validate --format jsonl, or report pages");
  add_formats(app, words.formats);
  add_word(app, "-o,--output", words.output, "FILE", "Page of the pages of report --shard");
  add_listing(app, words.listing);
  add_sarif_notes(app, words.sarif_notes);
  add_fail_on(app, words.fail_on, "Exit 1 at error, warning, info, never (else as run)");
  app.add_flag("-q,--quiet", words.quiet, "Print findings only, no summary and no notes");
  add_color(app, words.common);
}

void declare_explain(CLI::App& app, RawExplainOptions& words) {
  describe_positional(app, "CODE", "Codes of rules, in any case");
  add_color(app, words.common);
}

void declare_rules(CLI::App& app, RawRulesOptions& words) {
  add_word(app, "-f,--format", words.format, "NAME", "Output format: text (default) or json");
  add_color(app, words.common);
}

void declare_targets(CLI::App& app, RawTargetsOptions& words) {
  describe_positional(app, "NAME[@VERSION]", "Engines and versions (default: the newest of each)");
  add_word(app, "-f,--format", words.format, "NAME",
           "Output format: text (default), json or markdown");
  add_list(app, "--target", words.targets, "NAME[@VERSION]", "An engine, as without the option");
  add_target_files(app, words.target_files);
  add_color(app, words.common);
}

void declare_schema(CLI::App& app, RawSchemaOptions& words) {
  describe_positional(app, "NAME", "Extension or core type (default: list them)");
  add_word(app, "-f,--format", words.format, "NAME", "Output format: text (default) or json");
  add_list(app, "--status", words.statuses, "NAME", "Extensions of this status only (repeatable)");
  add_word(app, "--new", words.new_name, "NAME", "Print a schema to start with");
  add_list(app, "--check", words.check_files, "FILE", "Check a schema file (repeatable)");
  add_list(app, "--test", words.test_files, "FILE", "Run the tests of a schema file (repeatable)");
  add_schema_sources(app, words.schema_files, words.schema_folders);
  add_configuration(app, words.configuration);
  add_color(app, words.common);
}

}  // namespace gltfx::tool

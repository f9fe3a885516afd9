// SPDX-License-Identifier: Apache-2.0
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
           "Camera of the asset, or azimuth,elevation in degrees");
  add_word(app, "--lights", words.lights, "WHICH", "Lights: asset, studio or both (default)");
  add_word(app, "--environment", words.environment, "FILE",
           "Equirectangular environment map, .hdr or .exr");
  add_word(app, "--exposure", words.exposure, "STOPS", "Exposure in stops (default: 0)");
  add_word(app, "--scene", words.scene, "NAME|N", "Scene (default: that of the asset)");
  add_word(app, "--animation", words.animation, "NAME|N", "Animation to pose the asset with");
  add_word(app, "--time", words.time, "SECONDS", "Time in the animation (default: 0)");
  add_word(app, "--variant", words.variant, "NAME|N", "Material variant");
  app.add_flag("--force", words.force, "Render invalid assets as far as possible");
}

void declare_quality(CLI::App& app, RawBakeOptions& words) {
  add_word(app, "--samples", words.samples, "N", "Samples per pixel (default: 32)");
  add_word(app, "--bounces", words.bounces, "N", "Maximum path depth (default: 6)");
  add_word(app, "--seed", words.seed, "N", "Random seed (default: 0)");
  add_word(app, "--denoise", words.denoise, "on|off", "Denoise the picture (default: on)");
  add_word(app, "--noise", words.noise, "TARGET",
           "Target error per pixel, 0 to 1 (default: 0, off)");
  add_word(app, "--time-budget", words.time_budget, "SECONDS",
           "Time limit per picture; not reproducible");
  add_word(app, "--shader", words.shader, "NAME", "Shading: conserving (default) or spec");
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

}  // namespace gltfx::tool

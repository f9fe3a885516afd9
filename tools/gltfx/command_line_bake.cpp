// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "command_line_parts.hpp"

namespace gltfx::tool {
namespace {

void declare_outputs(CLI::App& app, BakeWords& words) {
  add_word(app, "-o,--output", words.output, "FILE|DIR",
           "Write there: .png, .webp, .jpg or .exr; a folder for several assets");
  add_word(app, "-f,--format", words.format, "NAME",
           "Of files in a folder: png, webp, jpeg or exr (default: png)");
  add_word(app, "--sheet", words.sheet, "FILE",
           "All pictures on one (default with several assets: DIR/contact-sheet.png)");
  add_list(app, "--size", words.sizes, "N|WxH", "Pixels (default: 512); repeatable, 256,512");
  add_word(app, "--turntable", words.turntable, "N", "N pictures, once around");
  add_list(app, "--layer", words.layers, "NAME",
           "Beside the picture: albedo, normal, depth or material (repeatable)");
  app.add_flag("--transparent", words.transparent, "No backdrop");
  app.add_flag("--embed", words.embed, "Put the picture into the asset, as its thumbnail");
  add_word(app, "--compare", words.compare, "PATH",
           "Draw PATH alike, say how much they differ; -o gets the difference");
}

void declare_scene(CLI::App& app, BakeWords& words) {
  add_word(app, "--camera", words.camera, "NAME|N|AZ,EL",
           "A camera of the asset, or degrees around it (default: three quarters)");
  add_word(app, "--lights", words.lights, "WHICH",
           "asset, studio or both; its lamps get the studio's brightness (default: both)");
  add_word(app, "--environment", words.environment, "FILE",
           "Light and background: .hdr or .exr, equirectangular");
  add_word(app, "--exposure", words.exposure, "STOPS", "1 doubles the light (default: 0)");
  add_word(app, "--scene", words.scene, "NAME|N", "Not the default scene");
  add_word(app, "--animation", words.animation, "NAME|N", "Pose the asset as it says");
  add_word(app, "--time", words.time, "SECONDS", "At that moment (default: 0)");
  add_word(app, "--variant", words.variant, "NAME|N", "Materials of a variant");
  app.add_flag("--force", words.force, "Draw also what is not valid, as far as it goes");
}

void declare_quality(CLI::App& app, BakeWords& words) {
  add_word(app, "--samples", words.samples, "N",
           "Paths through each pixel, on average with --denoise on (default: 32)");
  add_word(app, "--bounces", words.bounces, "N", "Surfaces along a path (default: 6)");
  add_word(app, "--seed", words.seed, "N", "Another noise (default: 0)");
  add_word(app, "--denoise", words.denoise, "on|off", "Smooth away the noise (default: on)");
  add_word(app, "--noise", words.noise, "TARGET",
           "Stop where the error is below, 0 to 1 (default: 0, all samples)");
  add_word(app, "--time-budget", words.time_budget, "SECONDS",
           "For each picture; the result depends on the machine then");
  add_word(app, "--shader", words.shader, "NAME",
           "conserving, or spec: the sample implementations to the letter");
}

}  // namespace

void declare_bake(CLI::App& app, BakeWords& words) {
  describe_positional(app, "PATH", "Files, folders (searched through) or globs");
  declare_outputs(app, words);
  declare_scene(app, words);
  declare_quality(app, words);
  add_inputs(app, words.inputs);
  add_word(app, "--cache", words.cache, "DIR",
           "Note there what was drawn, and leave pictures that are there and as they should be");
  add_word(app, "--cache-key", words.cache_key, "FILE",
           "File with the key of --cache (default: $GLTFX_CACHE_KEY or your own)");
  add_root(app, words.root);
  add_schema_sources(app, words.schema_files, words.schema_folders);
  app.add_flag("-q,--quiet", words.quiet, "Problems only: no progress, no list of files");
  add_configuration(app, words.configuration);
  add_decoders(app, words.common);
  add_common(app, words.common);
}

}  // namespace gltfx::tool

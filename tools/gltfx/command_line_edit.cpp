// SPDX-License-Identifier: Apache-2.0
// The verbs that change assets.
#include <CLI/CLI.hpp>

#include "command_line_parts.hpp"

namespace gltfx::tool {
namespace {

void declare_destination(CLI::App& app, RawEditOptions& words) {
  describe_positional(app, "PATH", "Files, folders (recursive) or globs");
  add_word(app, "-f,--format", words.format, "NAME", "Output format: text (default) or json");
  app.add_flag("--in-place", words.in_place, "Replace the files; each one is written atomically");
  add_word(app, "-o,--output", words.output, "FILE|DIR",
           "Output file; a folder if it ends in / or exists");
  app.add_flag("--backup", words.backup, "With --in-place: keep the old file as NAME.bak");
  app.add_flag("--restore", words.restore, "Restore the files that --backup kept");
  app.add_flag("--check", words.check, "Write nothing; exit 1 if there is work to do");
  app.add_flag("--diff", words.diff, "Print the changes as a unified diff");
  app.add_flag("--raw", words.raw, "With --diff: print all characters as they are");
}

void declare_sources(CLI::App& app, RawEditOptions& words) {
  add_root(app, words.root);
  add_inputs(app, words.inputs);
  add_schema_sources(app, words.schema_files, words.schema_folders);
  app.add_flag("-q,--quiet", words.quiet, "Print errors only, no plan and no summary");
  add_configuration(app, words.configuration);
  add_decoders(app, words.common);
  add_common(app, words.common);
}

}  // namespace

void declare_upgrade(CLI::App& app, RawUpgradeOptions& words) {
  declare_destination(app, words);
  app.add_flag("--verify", words.verify, "Refuse upgrades that change the rendered picture");
  app.add_flag("--unsafe", words.unsafe, "Allow lossy upgrades");
  app.add_flag("--strict", words.strict, "Skip files that cannot be upgraded without loss");
  add_list(app, "--only", words.only, "NAME", "Upgrade only this extension (repeatable)");
  add_list(app, "--to", words.to, "NAME", "Upgrade only to this extension (repeatable)");
  add_word(app, "--ior", words.ior, "N", "ior for specular-glossiness: 0 (default) or 1000");
  app.add_flag("--pack", words.pack, "Pack color and factor into one image if exact");
  app.add_flag("--prune", words.prune, "Remove textures and images left unused");
  add_word(app, "--generation", words.generation, "NAME",
           "Draft of legacy objects: auto (default), v1, v2, v3");
  add_targets(app, words.targets, words.target_files);
  declare_sources(app, words);
}

void declare_fix(CLI::App& app, RawFixOptions& words) {
  declare_destination(app, words);
  add_list(app, "--only", words.only, "CODES",
           "Fix only these codes (comma-separated, repeatable)");
  add_list(app, "--skip", words.skip, "CODES",
           "Leave these codes alone (comma-separated, repeatable)");
  app.add_flag("--unsafe", words.unsafe, "With --only: allow fixes that lose something");
  add_selection(app, words.validate);
  add_fail_on(app, words.validate.fail_on,
              "With --check: exit 1 at error, warning, info or never (default: any fix)");
  declare_sources(app, words);
}

void declare_edit(CLI::App& app, RawDeleteOptions& words) {
  add_list(app, "--delete", words.pointers, "POINTER",
           "Delete what a JSON pointer names (repeatable)");
  app.add_flag("--cascade", words.cascade, "Delete what refers to it, too");
  declare_destination(app, words);
  declare_sources(app, words);
}

}  // namespace gltfx::tool

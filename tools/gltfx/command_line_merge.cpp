// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "command_line_parts.hpp"

namespace gltfx::tool {

void declare_merge(CLI::App& app, RawMergeOptions& words) {
  describe_positional(app, "REPORT", "Files written by validate with --format jsonl=FILE");
  add_formats(app, words.formats);
  add_listing(app, words.listing);
  add_sarif_notes(app, words.sarif_notes);
  add_fail_on(app, words.fail_on, "Exit 1 at error, warning, info, never (else as run)");
  app.add_flag("-q,--quiet", words.quiet, "Print findings only, no summary and no notes");
  add_common(app, words.common);
}

}  // namespace gltfx::tool

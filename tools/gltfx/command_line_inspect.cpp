// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "command_line_parts.hpp"

namespace gltfx::tool {

void declare_inspect(CLI::App& app, InspectWords& words) {
  describe_positional(app, "PATH", "Files, folders (searched through) or globs");
  add_word(app, "-f,--format", words.format, "NAME", "text or json (default: text)");
  add_word(app, "--top", words.top, "N",
           "Text: rows of each table, the largest first; 0 for all (default: 10)");
  add_search(app, words.exclude, words.no_ignore, words.allow_empty);
  add_root(app, words.root);
  add_schema_sources(app, words.schema_files, words.schema_folders);
  app.add_flag("-q,--quiet", words.quiet, "No notes about folders without assets");
  add_configuration(app, words.configuration);
  add_common(app, words.common);
}

}  // namespace gltfx::tool

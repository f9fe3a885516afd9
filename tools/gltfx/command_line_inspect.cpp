// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "command_line_parts.hpp"

namespace gltfx::tool {

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

}  // namespace gltfx::tool

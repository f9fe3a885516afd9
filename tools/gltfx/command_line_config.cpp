// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>

#include "command_line_parts.hpp"

namespace gltfx::tool {

void declare_config(CLI::App& app, RawConfigOptions& words) {
  describe_positional(app, "PATH", "Path, or import FILE of the Khronos validator");
  add_configuration(app, words.configuration);
  add_common(app, words.common);
}

}  // namespace gltfx::tool

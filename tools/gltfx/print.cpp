// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <unistd.h>

#include "commands.hpp"
#include "output.hpp"

namespace gltfx::tool {

ExitCode print(std::string_view text) {
  Output out{std::string()};
  out.write(text);
  if (out.problem().empty()) return ExitCode::ok;
  complain(out.problem());
  return ExitCode::internal;
}

void complain(std::string_view message) {
  std::string line = "gltfx: ";
  line.append(message).append("\n");
  static_cast<void>(write_all(STDERR_FILENO, line));
}

}  // namespace gltfx::tool

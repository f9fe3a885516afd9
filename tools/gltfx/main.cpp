// SPDX-License-Identifier: Apache-2.0
/// gltfx: validates glTF 2.0 assets.
#include <csignal>
#include <exception>
#include <string>
#include <variant>

#include <fcntl.h>
#include <unistd.h>

#include "command_line.hpp"
#include "commands.hpp"
#include "output.hpp"

namespace gltfx::tool {
namespace {

// A closed standard stream would hand its number to the next file that is opened.
void keep_standard_streams() {
  int fd = ::open("/dev/null", O_RDWR);
  while (fd >= 0 && fd <= STDERR_FILENO) fd = ::dup(fd);
  if (fd > STDERR_FILENO) ::close(fd);
}

ExitCode run_command(int argc, char** argv) {
  const CommandLine command = read_command_line(argc, argv);
  if (const auto* answer = std::get_if<Answer>(&command)) {
    static_cast<void>(write_all(STDERR_FILENO, answer->error));
    return worse(answer->code, print(answer->output));
  }
  return std::visit([](const auto& request) { return run(request); }, std::get<Request>(command));
}

}  // namespace
}  // namespace gltfx::tool

int main(int argc, char** argv) {
  using gltfx::tool::ExitCode;
  // A reader that goes away is seen where we write, so that files being written are still
  // completed.
  static_cast<void>(std::signal(SIGPIPE, SIG_IGN));
  gltfx::tool::keep_standard_streams();
  ExitCode code = ExitCode::internal;
  try {
    code = gltfx::tool::run_command(argc, argv);
  } catch (const std::exception& error) {
    gltfx::tool::complain(std::string("internal error: ") + error.what());
  }
  return static_cast<int>(code);
}

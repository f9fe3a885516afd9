// SPDX-License-Identifier: Apache-2.0
/// gltfx: validates glTF 2.0 assets.
#include <gltfx/mapping.hpp>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <variant>

#include <fcntl.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "base/temporary_file.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "output.hpp"
#include "progress.hpp"

namespace gltfx::tool {
namespace {

// The descriptor of a closed standard stream would be reused by the next opened file.
void keep_standard_streams() {
  int fd = ::open("/dev/null", O_RDWR);
  while (fd >= 0 && fd <= STDERR_FILENO) fd = ::dup(fd);
  if (fd > STDERR_FILENO) ::close(fd);
}

// glibc raises its mmap threshold with the largest freed array; later arrays then leave holes in
// the heap, which double the memory of a verb for a large asset. Its "fast bins" are merged
// whenever a large block is freed, and memory at the end of the heap is returned to the system
// although it is needed again soon. Both take a tenth of the time of a verb for a large asset. Not
// for `bake`: it would take a seventh more memory in about the same time.
void tune_the_heap() {
#ifdef __GLIBC__
  ::mallopt(M_MMAP_THRESHOLD, 4 << 20);
  ::mallopt(M_MXFAST, 0);
  ::mallopt(M_TOP_PAD, 16 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

// A mapped file that is truncated while it is read is a finding. Any other such error ends the
// program as without a handler.
void repair_or_die(int signal, siginfo_t* info, void*) {
  if (!repair_mapping(info->si_addr)) static_cast<void>(std::signal(signal, SIG_DFL));
}

void guard_mappings() {
  struct sigaction action {};
  action.sa_sigaction = repair_or_die;
  action.sa_flags = SA_SIGINFO;
  ::sigaction(SIGBUS, &action, nullptr);
}

// An interrupted program leaves no partly written file.
void clean_up_and_die(int signal) {
  remove_temporaries();
  end_progress_line();
  static_cast<void>(std::signal(signal, SIG_DFL));
  static_cast<void>(std::raise(signal));
}

void clean_up_when_ended() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (std::signal(signal, clean_up_and_die) == SIG_IGN) {
      static_cast<void>(std::signal(signal, SIG_IGN));
    }
  }
}

std::terminate_handler usual_end = nullptr;

// Libraries with noexcept functions end the program if memory is missing.
void explain_and_die() {
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    remove_temporaries();
    static_cast<void>(write_all(STDERR_FILENO, "gltfx: there is not enough memory\n"));
    std::_Exit(static_cast<int>(ExitCode::internal));
  } catch (...) {
    // Any other error ends the program as usual.
  }
  usual_end();
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
  // A closed reader is detected when writing, so that files being written are still completed.
  static_cast<void>(std::signal(SIGPIPE, SIG_IGN));
  gltfx::tool::guard_mappings();
  gltfx::tool::clean_up_when_ended();
  gltfx::tool::keep_standard_streams();
  if (argc < 2 || std::string_view(argv[1]) != "bake") gltfx::tool::tune_the_heap();
  gltfx::tool::usual_end = std::set_terminate(gltfx::tool::explain_and_die);
  ExitCode code = ExitCode::internal;
  try {
    code = gltfx::tool::run_command(argc, argv);
  } catch (const std::bad_alloc&) {
    gltfx::tool::complain("there is not enough memory");
  } catch (const std::exception& error) {
    gltfx::tool::complain(std::string("internal error: ") + error.what());
  }
  return static_cast<int>(code);
}

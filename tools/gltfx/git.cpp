// SPDX-License-Identifier: Apache-2.0
#include "git.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/unique_fd.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration): not everywhere in <unistd.h>

namespace gltfx::tool {
namespace {

Error failure(int error) {
  return {"git cannot be started: " + std::error_code(error, std::generic_category()).message()};
}

/// The ends of git's standard input and output.
struct Pipes {
  UniqueFd to, from;         // ours
  UniqueFd its_in, its_out;  // git's
  bool complete() const { return to && from && its_in && its_out; }
};

Pipes open_pipes() {
  Pipes pipes;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return pipes;
  pipes.its_in = UniqueFd(ends[0]);
  pipes.to = UniqueFd(ends[1]);
  // A writer that waits for git while git waits for a reader would wait forever.
  ::fcntl(pipes.to.get(), F_SETFL, O_NONBLOCK);
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return pipes;
  pipes.from = UniqueFd(ends[0]);
  pipes.its_out = UniqueFd(ends[1]);
  return pipes;
}

// The process, or minus an errno.
pid_t spawn(std::vector<std::string> words, const Pipes& pipes) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawnattr_init(&attributes);
  ::posix_spawn_file_actions_adddup2(&actions, pipes.its_in.get(), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, pipes.its_out.get(), STDOUT_FILENO);
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGPIPE);  // this program ignores it
  ::posix_spawnattr_setsigdefault(&attributes, &signals);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t id = -1;
  const int error = ::posix_spawnp(&id, "git", &actions, &attributes, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::posix_spawnattr_destroy(&attributes);
  return error == 0 ? id : -error;
}

// Writes as much as the pipe accepts; closes it when all is written or git has closed its end.
void feed(UniqueFd& to, std::string_view& input) {
  const ssize_t written = ::write(to.get(), input.data(), input.size());
  if (written > 0) input.remove_prefix(static_cast<std::size_t>(written));
  const bool later = written < 0 && (errno == EAGAIN || errno == EINTR);
  if (input.empty() || (written < 0 && !later)) to = UniqueFd();
}

void exchange(Pipes& pipes, std::string_view input,
              const std::function<void(std::string_view)>& consume) {
  std::vector<char> buffer(std::size_t{1} << 16U);
  if (input.empty()) pipes.to = UniqueFd();
  while (true) {
    std::array<pollfd, 2> waits{
        {{pipes.from.get(), POLLIN, 0}, {pipes.to ? pipes.to.get() : -1, POLLOUT, 0}}};
    if (::poll(waits.data(), waits.size(), -1) < 0 && errno != EINTR) return;
    if (waits[1].revents != 0) feed(pipes.to, input);
    if (waits[0].revents == 0) continue;
    const ssize_t got = ::read(pipes.from.get(), buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return;
    consume({buffer.data(), static_cast<std::size_t>(got)});
  }
}

int wait_for(pid_t id) {
  int status = 0;
  while (::waitpid(id, &status, 0) < 0) {
    if (errno != EINTR) return 128;
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

Result<int> Git::stream(const std::vector<std::string>& arguments, std::string_view input,
                        const std::function<void(std::string_view)>& consume) const {
  Pipes pipes = open_pipes();
  if (!pipes.complete()) return failure(errno);
  std::vector<std::string> words{"git", "-C", folder_};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const pid_t id = spawn(std::move(words), pipes);
  if (id < 0) return failure(-id);
  pipes.its_in = UniqueFd();
  pipes.its_out = UniqueFd();
  exchange(pipes, input, consume);
  return wait_for(id);
}

Result<GitOutcome> Git::run(const std::vector<std::string>& arguments,
                            std::string_view input) const {
  GitOutcome outcome;
  const auto code = stream(arguments, input, [&](std::string_view piece) { outcome.out += piece; });
  if (!code) return code.error();
  outcome.code = *code;
  return outcome;
}

}  // namespace gltfx::tool

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

int wait_for(pid_t id) {
  int status = 0;
  while (::waitpid(id, &status, 0) < 0) {
    if (errno != EINTR) return 128;
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

GitProcess::GitProcess(GitProcess&& other) noexcept
    : id_(std::exchange(other.id_, 0)), to_(std::move(other.to_)), from_(std::move(other.from_)) {}

GitProcess::~GitProcess() { wait(); }

int GitProcess::wait() {
  to_ = UniqueFd();
  from_ = UniqueFd();
  const pid_t id = std::exchange(id_, 0);
  return id == 0 ? 0 : wait_for(id);
}

Result<GitProcess> GitProcess::start(const std::string& folder,
                                     const std::vector<std::string>& arguments) {
  Pipes pipes = open_pipes();
  if (!pipes.complete()) return failure(errno);
  std::vector<std::string> words{"git", "-C", folder};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const pid_t id = spawn(std::move(words), pipes);
  if (id < 0) return failure(-id);
  return GitProcess(id, std::move(pipes.to), std::move(pipes.from));
}

int GitProcess::exchange(std::string_view input,
                         const std::function<void(std::string_view)>& consume) {
  std::vector<char> buffer(std::size_t{1} << 16U);
  if (input.empty()) to_ = UniqueFd();
  while (true) {
    std::array<pollfd, 2> waits{{{from_.get(), POLLIN, 0}, {to_ ? to_.get() : -1, POLLOUT, 0}}};
    if (::poll(waits.data(), waits.size(), -1) < 0 && errno != EINTR) break;
    if (waits[1].revents != 0) feed(to_, input);
    if (waits[0].revents == 0) continue;
    const std::size_t got = read(buffer.data(), buffer.size());
    if (got == 0) break;
    consume({buffer.data(), got});
  }
  return wait();
}

bool GitProcess::ask(std::string_view text) {
  while (to_ && !text.empty()) {
    const ssize_t written = ::write(to_.get(), text.data(), text.size());
    if (written < 0 && errno == EAGAIN) {
      pollfd room{to_.get(), POLLOUT, 0};
      ::poll(&room, 1, -1);
    } else if (written < 0 && errno != EINTR) {
      to_ = UniqueFd();
    } else if (written > 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  return text.empty();
}

std::size_t GitProcess::read(char* to, std::size_t most) {
  ssize_t got = 0;
  do {
    got = ::read(from_.get(), to, most);
  } while (got < 0 && errno == EINTR);
  return got < 0 ? 0 : static_cast<std::size_t>(got);
}

Result<int> Git::stream(const std::vector<std::string>& arguments, std::string_view input,
                        const std::function<void(std::string_view)>& consume) const {
  auto process = GitProcess::start(folder_, arguments);
  if (!process) return process.error();
  return process->exchange(input, consume);
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

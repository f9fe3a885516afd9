// SPDX-License-Identifier: Apache-2.0
#include "codec/process.hpp"

#include <array>
#include <cerrno>
#include <csignal>

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;  // NOLINT(readability-redundant-declaration): not everywhere in <unistd.h>

namespace gltfx::codec {
namespace {

// Above all descriptors that a worker is given, so that giving it one does not close another.
UniqueFd moved_up(int fd) {
  const UniqueFd low(fd);
  return UniqueFd(::fcntl(fd, F_DUPFD_CLOEXEC, 16));
}

// A worker's ends, and those that stay here.
struct Ends {
  UniqueFd socket, lifeline;                // ours
  UniqueFd worker_socket, worker_lifeline;  // the worker's
  bool complete() const { return socket && lifeline && worker_socket && worker_lifeline; }
};

Ends create_ends() {
  Ends ends;
  std::array<int, 2> pair{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair.data()) != 0) return ends;
  ends.socket = UniqueFd(pair[0]);
  ends.worker_socket = moved_up(pair[1]);
  if (::pipe2(pair.data(), O_CLOEXEC) != 0) return ends;
  ends.worker_lifeline = moved_up(pair[0]);
  ends.lifeline = UniqueFd(pair[1]);
  return ends;
}

// What the new process does before it becomes the worker.
class Preparation {
 public:
  explicit Preparation(const Ends& ends) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawnattr_init(&attributes_);
    ::posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDWR, 0);
    ::posix_spawn_file_actions_adddup2(&actions_, 0, 1);
    ::posix_spawn_file_actions_adddup2(&actions_, 0, 2);
    ::posix_spawn_file_actions_adddup2(&actions_, ends.worker_socket.get(), kSocketDescriptor);
    ::posix_spawn_file_actions_adddup2(&actions_, ends.worker_lifeline.get(), kLifelineDescriptor);
    sigset_t signals;
    ::sigfillset(&signals);
    ::posix_spawnattr_setsigdefault(&attributes_, &signals);
    ::sigemptyset(&signals);
    ::posix_spawnattr_setsigmask(&attributes_, &signals);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  }
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;
  ~Preparation() {
    ::posix_spawn_file_actions_destroy(&actions_);
    ::posix_spawnattr_destroy(&attributes_);
  }

  pid_t spawn(const std::string& program) const {
    std::array<char*, 2> arguments{const_cast<char*>(program.c_str()), nullptr};
    pid_t id = -1;
    const int fault =
        ::posix_spawn(&id, program.c_str(), &actions_, &attributes_, arguments.data(), environ);
    return fault == 0 ? id : -1;
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

Process::Process(const std::string& program) {
  Ends ends = create_ends();
  if (!ends.complete()) return;
  id_ = Preparation(ends).spawn(program);
  socket_ = std::move(ends.socket);
  lifeline_ = std::move(ends.lifeline);
}

bool Process::has_ended() const {
  siginfo_t info{};
  const int flags = WEXITED | WNOHANG | WNOWAIT;
  return ::waitid(P_PID, static_cast<id_t>(id_), &info, flags) != 0 || info.si_pid != 0;
}

int Process::cause_of_death() {
  if (id_ <= 0) return 0;
  int status = 0;
  pid_t done = ::waitpid(id_, &status, WNOHANG);
  for (int i = 0; done == 0 && i < 20; ++i) {
    ::usleep(1000);
    done = ::waitpid(id_, &status, WNOHANG);
  }
  if (done == 0) return 0;
  const bool known = done == id_;
  id_ = -1;
  return known && WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

void Process::end() {
  if (id_ <= 0) return;
  ::kill(id_, SIGKILL);
  while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
  }
  id_ = -1;
}

}  // namespace gltfx::codec

// SPDX-License-Identifier: Apache-2.0
#include "codec/process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "codec/packet.hpp"

namespace gltfx::codec {
namespace {

// Moves a descriptor above all descriptors of a worker, so that assigning one does not close
// another.
int moved_up(int fd) {
  const UniqueFd low(fd);
  return ::fcntl(fd, F_DUPFD_CLOEXEC, 16);
}

// The actions of the new process before it becomes the worker.
class Preparation {
 public:
  explicit Preparation(const Ends& ends) {
    ::posix_spawn_file_actions_init(&actions_);
    ::posix_spawnattr_init(&attributes_);
    if (::access("/dev/null", R_OK | W_OK) == 0) {
      ::posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDWR, 0);
    } else {  // a minimal system has none; an unwritable pipe is a replacement
      ::posix_spawn_file_actions_adddup2(&actions_, ends.worker_lifeline.get(), 0);
    }
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

  // Returns 0, or the number of the error.
  int spawn(const std::string& program, pid_t& id) const {
    std::array<char*, 2> arguments{const_cast<char*>(program.c_str()), nullptr};
    char* const environment[] = {nullptr};
    return ::posix_spawn(&id, program.c_str(), &actions_, &attributes_, arguments.data(),
                         environment);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

using std::chrono::nanoseconds;

std::optional<nanoseconds> processor_time(pid_t process) {
  clockid_t clock{};
  timespec time{};
  if (::clock_getcpuclockid(process, &clock) != 0) return std::nullopt;
  if (::clock_gettime(clock, &time) != 0) return std::nullopt;
  return std::chrono::seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
}

// Counts polls, not time: while this process is stopped, the other one may be stopped too.
Watch watch(int socket, pid_t process, const Patience& patience) {
  constexpr std::chrono::milliseconds kLook{250};
  // A process that waits forever may still use some microseconds occasionally.
  constexpr std::chrono::milliseconds kProgress{10};
  const std::chrono::milliseconds look = std::min(kLook, patience.standstill);
  const nanoseconds begin = processor_time(process).value_or(nanoseconds::zero());
  nanoseconds last = begin;
  for (std::chrono::milliseconds still{0}; still < patience.standstill;) {
    if (wait_for_packet(socket, look) == Wait::ready) return Watch::ready;
    const nanoseconds now = processor_time(process).value_or(last);
    if (now - begin > patience.processor_time) return Watch::overrun;
    const bool progress = now - last >= kProgress;
    still = progress ? std::chrono::milliseconds::zero() : still + look;
    if (progress) last = now;
  }
  return Watch::standstill;
}

Ends Ends::create() {
  Ends ends;
  const NoFork now;
  std::array<int, 2> pair{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair.data()) != 0) return ends;
  ends.socket = now.own(pair[0]);
  ends.worker_socket = now.own(moved_up(pair[1]));
  if (::pipe2(pair.data(), O_CLOEXEC) != 0) return ends;
  ends.worker_lifeline = now.own(moved_up(pair[0]));
  ends.lifeline = now.own(pair[1]);
  return ends;
}

Process::Process(const std::string& program) {
  Ends ends = Ends::create();
  if (!ends.complete()) {
    start_error_ = errno;
    return;
  }
  start_error_ = Preparation(ends).spawn(program, id_);
  if (start_error_ != 0) id_ = -1;
  socket_ = std::move(ends.socket);
  lifeline_ = std::move(ends.lifeline);
}

std::string Process::start_error() const {
  return std::error_code(start_error_, std::generic_category()).message();
}

bool Process::lacked_resources() const {
  return start_error_ == EAGAIN || start_error_ == ENOMEM || start_error_ == EMFILE ||
         start_error_ == ENFILE;
}

// The signal has no effect on a process that is ending.
std::string Process::end() {
  if (id_ <= 0) return "it exited";
  ::kill(id_, SIGKILL);
  int status = 0;
  pid_t done = -1;
  do {
    done = ::waitpid(id_, &status, 0);
  } while (done < 0 && errno == EINTR);
  id_ = -1;
  if (done > 0 && WIFEXITED(status)) {
    return fmt::format("it exited with code {}", WEXITSTATUS(status));
  }
  if (done > 0 && WIFSIGNALED(status)) {
    return fmt::format("it was terminated by signal {}", WTERMSIG(status));
  }
  return "it exited";
}

}  // namespace gltfx::codec

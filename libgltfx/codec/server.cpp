// SPDX-License-Identifier: Apache-2.0
#include "codec/server.hpp"

#include <algorithm>
#include <csignal>

#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include "codec/packet.hpp"
#include "codec/process.hpp"
#include "codec/sandbox.hpp"
#include "codec/shared_memory.hpp"

namespace gltfx::codec {
namespace {

constexpr std::uint64_t kMostResultBytes = std::uint64_t{8} << 30U;

Answer answer_to(const Job& job, const Packet& packet, const Decode& decode) {
  const Mapping input(packet.descriptors[0].get(), job.input_bytes, Mapping::Access::read);
  if (input.bytes().size() != job.input_bytes) {
    return DecodeError{ErrorKind::out_of_memory, "There is not enough memory for the payload."};
  }
  Mapping result;
  return decode_safely(decode, job, input.bytes(), [&](std::uint64_t size) {
    result = Mapping(packet.descriptors[1].get(), size, Mapping::Access::write);
    return result.bytes();
  });
}

// Keeps freed memory for the next payload: requesting new pages from the system takes 10 % of the
// time of a job.
// NOLINTBEGIN(concurrency-mt-unsafe): called before there are threads
void keep_memory() {
  ::mallopt(M_ARENA_MAX, 1);  // arenas of threads reserve address space
  ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
  ::mallopt(M_TRIM_THRESHOLD, 128 << 20);
}
// NOLINTEND(concurrency-mt-unsafe)

// False if the client has closed or breaks the protocol.
bool serve_one(const Decode& decode, const JobLimits& limits) {
  const auto packet = receive_packet(kSocketDescriptor);
  if (!packet || packet->descriptors.size() != 2) return false;
  const auto job = read_job(packet->bytes);
  if (!job) return false;
  limits.begin(job->memory_bytes, job->milliseconds);
  const Answer answer = answer_to(*job, *packet, decode);
  JobLimits::end();
  return send_packet(kSocketDescriptor, write_answer(answer), {});
}

// The main loop of a worker. Returns the exit code.
int work(const Decode& decode, std::uint64_t most_memory_bytes) {
  close_descriptors_from(kLifelineDescriptor + 1);
  end_with(kLifelineDescriptor);
  const JobLimits limits(most_memory_bytes);
  const Hello hello{lock_in(kMostResultBytes)};
  if (!send_packet(kSocketDescriptor, write_hello(hello), {})) return 1;
  while (serve_one(decode, limits)) {
  }
  return 0;
}

// Returns the id of the new process, or 0 on failure.
pid_t fork_worker(const Decode& decode, const Packet& packet, std::uint64_t most_memory_bytes) {
  if (packet.descriptors.size() != 2) return 0;
  const pid_t id = ::fork();
  if (id != 0) return std::max(id, 0);
  int code = 1;
  if (::dup2(packet.descriptors[0].get(), kSocketDescriptor) >= 0 &&
      ::dup2(packet.descriptors[1].get(), kLifelineDescriptor) >= 0) {
    code = work(decode, most_memory_bytes);
  }
  ::_exit(code);  // exit() would wait for threads that this process does not have
}

// Ends a worker. The signal has no effect on a worker that is ending. Returns the signal that ended
// it, or 0.
int finish_worker(pid_t id) {
  int status = 0;
  pid_t done = ::waitpid(id, &status, WNOHANG);
  if (done == 0) {  // the worker still runs
    ::kill(id, SIGKILL);
    done = ::waitpid(id, &status, 0);
  }
  return done == id && WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

// False if the client has closed or breaks the protocol.
bool launch_one(const Decode& decode) {
  const auto packet = receive_packet(kSocketDescriptor);
  const auto asked = packet ? read_control(packet->bytes) : std::nullopt;
  if (!asked) return false;
  Control answer;
  if (asked->kind == Control::Kind::start) {
    const pid_t id = fork_worker(decode, *packet, asked->value);
    answer = {Control::Kind::started, static_cast<std::uint64_t>(id)};
  } else if (asked->kind == Control::Kind::finish && asked->value > 0) {
    const int signal = finish_worker(static_cast<pid_t>(asked->value));
    answer = {Control::Kind::ended, static_cast<std::uint64_t>(signal)};
  } else {
    return false;
  }
  return send_packet(kSocketDescriptor, write_control(answer), {});
}

}  // namespace

int serve(const std::function<void()>& prepare, const Decode& decode) {
  close_descriptors_from(kLifelineDescriptor + 1);
  end_with(kLifelineDescriptor);
  std::signal(SIGINT, SIG_IGN);  // a terminal sends it to all programs; the client decides
  keep_memory();
  prepare();
  if (!send_packet(kSocketDescriptor, write_control({}), {})) return 1;
  while (launch_one(decode)) {
  }
  return 0;
}

}  // namespace gltfx::codec

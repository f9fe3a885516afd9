// SPDX-License-Identifier: Apache-2.0
#include "codec/sandbox.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <vector>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/capability.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#define GLTFX_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GLTFX_ADDRESS_SANITIZER
#endif
#endif

namespace gltfx::codec {
namespace {

#if defined(__x86_64__) || defined(__aarch64__)
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#else
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#endif

// No open, no stat, no exec, no socket, no fork, no signal to others. Threads that libraries
// started earlier may still be starting.
constexpr std::uint32_t kAllowed[] = {
    SYS_recvmsg,
    SYS_sendmsg,
    SYS_read,
    SYS_write,
    SYS_close,
    SYS_lseek,
    SYS_ftruncate,
    SYS_munmap,
    SYS_mremap,
    SYS_madvise,
    SYS_brk,
    SYS_futex,
    SYS_sched_yield,
    SYS_exit,
    SYS_exit_group,
    SYS_rt_sigreturn,
    SYS_rt_sigaction,
    SYS_rt_sigprocmask,
    SYS_sigaltstack,
    SYS_getpid,
    SYS_gettid,
    SYS_clock_gettime,
    SYS_gettimeofday,
    SYS_getrandom,
    SYS_setitimer,
    SYS_sched_getaffinity,
    SYS_getrusage,
    SYS_restart_syscall,
    SYS_clock_nanosleep,
    SYS_nanosleep,
    SYS_rseq,
    SYS_set_robust_list,
    SYS_writev,
#if defined(__x86_64__)
    SYS_time,
#endif
#ifdef GLTFX_ADDRESS_SANITIZER
    SYS_pipe2,  // UBSan writes memory into a pipe to check whether it is readable
#if defined(__x86_64__)
    SYS_pipe,
#endif
#endif
};
constexpr std::uint32_t kAllowedWithoutExecution[] = {SYS_mmap, SYS_mprotect};

using Program = std::vector<sock_filter>;

constexpr std::uint32_t kForbid = SECCOMP_RET_ERRNO | EPERM;

void load(Program& program, std::size_t offset) {
  program.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
}
// Runs the next statement if the loaded value is `value`, otherwise skips it.
void if_equal(Program& program, std::uint32_t value) {
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1));
}
void answer(Program& program, std::uint32_t action) {
  program.push_back(BPF_STMT(BPF_RET | BPF_K, action));
}

// Forbids the call `number` unless `jump` accepts its argument; other calls continue after this
// check.
void check_argument(Program& program, std::uint32_t number, int argument, const sock_filter& jump) {
  // The kernel uses only the low half of the 64 bits, which comes first in memory.
  const std::size_t offset = offsetof(seccomp_data, args) +
                             static_cast<std::size_t>(argument) * sizeof(seccomp_data::args[0]);
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 4));
  load(program, offset);
  program.push_back(jump);
  answer(program, SECCOMP_RET_ALLOW);
  answer(program, kForbid);
}

// `self`: the id of the calling process.
Program filter_program(std::uint32_t self) {
  Program program;
  load(program, offsetof(seccomp_data, arch));
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0));
  answer(program, SECCOMP_RET_KILL_PROCESS);
  load(program, offsetof(seccomp_data, nr));
  for (const std::uint32_t number : kAllowed) {
    if_equal(program, number);
    answer(program, SECCOMP_RET_ALLOW);
  }
  for (const std::uint32_t number : kAllowedWithoutExecution) {
    check_argument(program, number, 2, BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, PROT_EXEC, 1, 0));
  }
  // Allowed are signals to its own threads, which abort() uses, and changes of its own limits
  // (process 0), which stay below the hard limits.
  check_argument(program, SYS_tgkill, 0, BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, self, 0, 1));
  check_argument(program, SYS_prlimit64, 0, BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 0, 0, 1));
  answer(program, kForbid);
  return program;
}

}  // namespace

// Limits all threads of the process to the calls for memory, one socket and the end of the process;
// others fail with EPERM. Precondition: no_new_privs. False if the system has no such filters or
// the processor is not supported.
bool filter_syscalls() {
  Program program = filter_program(static_cast<std::uint32_t>(::getpid()));
  sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  return ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &filter) == 0;
}
#else
bool filter_syscalls() { return false; }
#endif

#ifdef GLTFX_ADDRESS_SANITIZER
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif

// Sets a limit, never above the inherited one; `for_good`: it cannot be raised later.
void set_limit(__rlimit_resource_t resource, std::uint64_t value, bool for_good) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(value, limit.rlim_max);
  if (for_good) limit.rlim_max = limit.rlim_cur;
  ::setrlimit(resource, &limit);
}

// Turns the current limits into hard limits. The memory limit changes with each job and is set
// separately.
void keep_limits() {
  for (int i = 0; i < static_cast<int>(RLIM_NLIMITS); ++i) {
    const auto resource = static_cast<__rlimit_resource_t>(i);
    rlimit limit{};
    if (resource == RLIMIT_AS || ::getrlimit(resource, &limit) != 0) continue;
    set_limit(resource, limit.rlim_cur, true);
  }
}

// With capabilities, root could raise its limits again.
void drop_capabilities() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  const __user_cap_data_struct none[_LINUX_CAPABILITY_U32S_3] = {};
  ::syscall(SYS_capset, &header, none);
}

std::uint64_t address_space() {
  unsigned long pages = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr) return 0;
  const bool read = std::fscanf(file, "%lu", &pages) == 1;
  std::fclose(file);
  return read ? pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) : 0;
}

void set_timer(std::uint64_t duration_ms) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(duration_ms / 1000);
  timer.it_value.tv_usec = static_cast<suseconds_t>(duration_ms % 1000 * 1000);
  ::setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace

void close_descriptors_from(int first) {
  if (::syscall(SYS_close_range, static_cast<unsigned>(first), ~0U, 0U) == 0) return;
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  const auto most = static_cast<int>(std::min<rlim_t>(limit.rlim_cur, 65536));
  for (int fd = first; fd < most; ++fd) ::close(fd);
}

void end_with(int lifeline) {
  // SIGIO ends a process that does not handle it; a pipe raises it when its last writer has closed.
  ::fcntl(lifeline, F_SETOWN, ::getpid());
  const int flags = ::fcntl(lifeline, F_GETFL);
  if (flags >= 0) ::fcntl(lifeline, F_SETFL, flags | O_ASYNC);
}

bool lock_in(std::uint64_t most_file_bytes) {
  set_limit(RLIMIT_CORE, 0, true);
  set_limit(RLIMIT_FSIZE, most_file_bytes, true);
  set_limit(RLIMIT_NOFILE, 64, true);
  set_limit(RLIMIT_NPROC, 0, true);
  keep_limits();
  drop_capabilities();
  if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return false;
  return filter_syscalls();
}

JobLimits::JobLimits(std::uint64_t most_memory_bytes)
    : baseline_(kLimitsMemory ? address_space() : 0) {
  if (baseline_ != 0) set_limit(RLIMIT_AS, baseline_ + most_memory_bytes, true);
}

void JobLimits::begin(std::uint64_t memory_bytes, std::uint64_t milliseconds) const {
  if (baseline_ != 0) set_limit(RLIMIT_AS, baseline_ + memory_bytes, false);
  set_timer(std::max<std::uint64_t>(milliseconds, 1));
}

void JobLimits::end() {
  set_timer(0);
  if (kLimitsMemory) set_limit(RLIMIT_AS, RLIM_INFINITY, false);
}

}  // namespace gltfx::codec

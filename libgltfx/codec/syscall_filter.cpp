// SPDX-License-Identifier: Apache-2.0
// A program for the kernel's packet filter (seccomp(2)): an allow-list of numbers, with a look at
// one argument of the calls that could make memory executable or reach another process.
#include "codec/syscall_filter.hpp"

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace gltfx::codec {

#if defined(__x86_64__) || defined(__aarch64__)
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#else
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#endif

// No open, no stat, no exec, no socket, no fork, no signal to others. Threads that libraries
// started before may still be on their way into life.
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
};
constexpr std::uint32_t kAllowedWithoutExecution[] = {SYS_mmap, SYS_mprotect};

using Program = std::vector<sock_filter>;

constexpr std::uint32_t kForbid = SECCOMP_RET_ERRNO | EPERM;

void load(Program& program, std::size_t offset) {
  program.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
}
// The next statement is taken when the loaded value is `value`, else the one behind it.
void if_equal(Program& program, std::uint32_t value) {
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1));
}
void answer(Program& program, std::uint32_t action) {
  program.push_back(BPF_STMT(BPF_RET | BPF_K, action));
}

// The call `number` is forbidden unless `jump` finds its argument; else it goes on behind this.
void check_argument(Program& program, std::uint32_t number, int argument, const sock_filter& jump) {
  // Of the 64 bits the low half, which comes first in memory, holds all that the kernel looks at.
  const std::size_t offset = offsetof(seccomp_data, args) +
                             static_cast<std::size_t>(argument) * sizeof(seccomp_data::args[0]);
  program.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 4));
  load(program, offset);
  program.push_back(jump);
  answer(program, SECCOMP_RET_ALLOW);
  answer(program, kForbid);
}

// `self`: the process that calls.
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
  // Signals to its own threads, which end a process that aborts, and its own limits (process 0),
  // which hard limits keep from being raised.
  check_argument(program, SYS_tgkill, 0, BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, self, 0, 1));
  check_argument(program, SYS_prlimit64, 0, BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, 0, 0, 1));
  answer(program, kForbid);
  return program;
}

}  // namespace

bool filter_syscalls() {
  Program program = filter_program(static_cast<std::uint32_t>(::getpid()));
  sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  return ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &filter) == 0;
}
#else
bool filter_syscalls() { return false; }
#endif

}  // namespace gltfx::codec

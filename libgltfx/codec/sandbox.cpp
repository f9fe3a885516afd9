// SPDX-License-Identifier: Apache-2.0
#include "codec/sandbox.hpp"

#include <algorithm>
#include <cstdio>

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include "codec/syscall_filter.hpp"

#if defined(__SANITIZE_ADDRESS__)
#define GLTFX_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GLTFX_ADDRESS_SANITIZER
#endif
#endif

namespace gltfx::codec {
namespace {

#ifdef GLTFX_ADDRESS_SANITIZER
constexpr bool kLimitsMemory = false;
#else
constexpr bool kLimitsMemory = true;
#endif

// Sets a limit, never above what the process was given; `for_good`: nor will it be raised again.
void set_limit(__rlimit_resource_t resource, std::uint64_t value, bool for_good) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(value, limit.rlim_max);
  if (for_good) limit.rlim_max = limit.rlim_cur;
  ::setrlimit(resource, &limit);
}

// What a limit is now, it stays at most. That of memory changes with each job and has its own.
void keep_limits() {
  for (int i = 0; i < static_cast<int>(RLIM_NLIMITS); ++i) {
    const auto resource = static_cast<__rlimit_resource_t>(i);
    rlimit limit{};
    if (resource == RLIMIT_AS || ::getrlimit(resource, &limit) != 0) continue;
    set_limit(resource, limit.rlim_cur, true);
  }
}

// With them, root could raise its limits again.
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
  // SIGIO ends a process that does not handle it; a pipe sends it when its last writer has gone.
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

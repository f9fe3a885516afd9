// SPDX-License-Identifier: Apache-2.0
#include "failing_calls.hpp"

#include <cerrno>
#include <cstdarg>
#include <cstdio>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/xattr.h>
#include <unistd.h>

namespace gltfx::test {
namespace {

struct Plan {
  bool armed = false;
  Call call = Call::open;
  int left = 0;  // calls until the one that fails; 0: it has failed
  int error = 0;
};
thread_local Plan plan;

// Whether the call fails this time; then errno is set.
bool fails(Call call) {
  if (!plan.armed || plan.call != call || plan.left == 0 || --plan.left > 0) return false;
  errno = plan.error;
  return true;
}

}  // namespace

FailingCall::FailingCall(Call call, int number, int error) { plan = {true, call, number, error}; }

FailingCall::~FailingCall() { plan.armed = false; }

bool FailingCall::stop() {
  plan.armed = false;
  return plan.left == 0;
}

}  // namespace gltfx::test

using gltfx::test::Call;
using gltfx::test::fails;

namespace {

template <typename... Arguments>
int call_system(Call call, long number, Arguments... arguments) {
  return fails(call) ? -1 : static_cast<int>(::syscall(number, arguments...));
}

template <typename... Arguments>
ssize_t transfer(Call call, long number, Arguments... arguments) {
  return fails(call) ? -1 : ::syscall(number, arguments...);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const unsigned mode = (flags & O_CREAT) != 0 ? va_arg(more, unsigned) : 0;
  va_end(more);
  return call_system(Call::open, SYS_openat, AT_FDCWD, path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
  return call_system(Call::openat, SYS_openat, folder, path, flags, 0);
}

int stat(const char* path, struct stat* status) noexcept {
  return call_system(Call::stat, SYS_newfstatat, AT_FDCWD, path, status, 0);
}

int fstat(int fd, struct stat* status) noexcept {
  return call_system(Call::fstat, SYS_newfstatat, fd, "", status, AT_EMPTY_PATH);
}

int fstatat(int folder, const char* path, struct stat* status, int flags) noexcept {
  return call_system(Call::fstatat, SYS_newfstatat, folder, path, status, flags);
}

ssize_t readlinkat(int folder, const char* path, char* to, size_t size) noexcept {
  return transfer(Call::readlinkat, SYS_readlinkat, folder, path, to, size);
}

ssize_t read(int fd, void* to, size_t size) { return transfer(Call::read, SYS_read, fd, to, size); }

ssize_t pread(int fd, void* to, size_t size, off_t at) {
  return transfer(Call::pread, SYS_pread64, fd, to, size, at);
}

ssize_t write(int fd, const void* from, size_t size) {
  return transfer(Call::write, SYS_write, fd, from, size);
}

void* mmap(void* at, size_t size, int protection, int flags, int fd, off_t offset) noexcept {
  if (fails(Call::mmap)) return MAP_FAILED;
  return reinterpret_cast<void*>(::syscall(SYS_mmap, at, size, protection, flags, fd, offset));
}

int access(const char* path, int mode) noexcept {
  return call_system(Call::access, SYS_faccessat, AT_FDCWD, path, mode);
}

int fchmod(int fd, mode_t mode) noexcept { return call_system(Call::fchmod, SYS_fchmod, fd, mode); }

int fchown(int fd, uid_t user, gid_t group) noexcept {
  return call_system(Call::fchown, SYS_fchown, fd, user, group);
}

int fsync(int fd) { return call_system(Call::fsync, SYS_fsync, fd); }

int rename(const char* from, const char* to) noexcept {
  return call_system(Call::rename, SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  return call_system(Call::renameat2, SYS_renameat2, from_folder, from, to_folder, to, flags);
}

int link(const char* from, const char* to) noexcept {
  return call_system(Call::link, SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0);
}

ssize_t listxattr(const char* path, char* to, size_t size) noexcept {
  return transfer(Call::listxattr, SYS_listxattr, path, to, size);
}

ssize_t getxattr(const char* path, const char* name, void* to, size_t size) noexcept {
  return transfer(Call::getxattr, SYS_getxattr, path, name, to, size);
}

int fsetxattr(int fd, const char* name, const void* value, size_t size, int flags) noexcept {
  return call_system(Call::fsetxattr, SYS_fsetxattr, fd, name, value, size, flags);
}

int fremovexattr(int fd, const char* name) noexcept {
  return call_system(Call::fremovexattr, SYS_fremovexattr, fd, name);
}

}  // extern "C"

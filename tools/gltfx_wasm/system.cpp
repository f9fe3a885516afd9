// SPDX-License-Identifier: Apache-2.0
// System calls that emscripten does not have: files in memory have no attributes, nothing is loaded
// beside the module, and no other program can be started.
#include <cerrno>

#include <link.h>
#include <spawn.h>
#include <sys/xattr.h>

namespace {

int unsupported() {
  errno = ENOTSUP;
  return -1;
}

}  // namespace

extern "C" {

ssize_t getxattr(const char*, const char*, void*, size_t) { return unsupported(); }
ssize_t fgetxattr(int, const char*, void*, size_t) { return unsupported(); }
ssize_t listxattr(const char*, char*, size_t) { return unsupported(); }
int fsetxattr(int, const char*, const void*, size_t, int) { return unsupported(); }
int fremovexattr(int, const char*) { return unsupported(); }

int dl_iterate_phdr(int (*)(dl_phdr_info*, size_t, void*), void*) { return 0; }

int posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                 char* const*, char* const*) {
  return ENOSYS;
}

}  // extern "C"

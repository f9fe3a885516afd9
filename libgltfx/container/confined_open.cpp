// SPDX-License-Identifier: Apache-2.0
#include "container/confined_open.hpp"

#include <cerrno>
#include <climits>
#include <utility>

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace gltfx::container {
namespace {

/// glibc has no wrapper for openat2(2).
UniqueFd open_by_kernel(int root, const char* path) {
  open_how how{};
  how.flags = O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  return UniqueFd(static_cast<int>(::syscall(SYS_openat2, root, path, &how, sizeof how)));
}

/// What the kernel and the walk are certain to agree on. Everything else is asked again by hand:
/// old kernels and sandboxes refuse the call (ENOSYS, EPERM), renames disturb it (EAGAIN), and it
/// refuses absolute links that lead back inside (EXDEV).
bool is_final(int error) { return error == ENOENT || error == ENOTDIR || error == ENAMETOOLONG; }

}  // namespace

File open_beneath(int root, const std::string& path, Confinement confinement) {
  if (path.find('\0') != std::string::npos) return file_error(ENOENT);
  if (path.size() >= PATH_MAX) return file_error(ENAMETOOLONG);
  const std::string named = path.empty() ? "." : path;
  if (confinement == Confinement::by_hand) return walk_beneath(root, named);
  UniqueFd fd = open_by_kernel(root, named.c_str());
  if (fd) return adopt_regular(std::move(fd));
  return is_final(errno) ? file_error(errno) : walk_beneath(root, named);
}

}  // namespace gltfx::container

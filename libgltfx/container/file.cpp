// SPDX-License-Identifier: Apache-2.0
#include "container/file.hpp"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <limits>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#ifdef __linux__
#include <linux/openat2.h>
#endif

#include "container/mapped_files.hpp"

namespace gltfx::container {
namespace {

constexpr int kOpenFlags = O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY;
constexpr std::size_t kReadAtOnce = std::size_t{1} << 30U;  // Linux reads at most 2 GiB a call

std::string_view kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "it is a folder";
  if (S_ISFIFO(mode)) return "it is a pipe";
  if (S_ISSOCK(mode)) return "it is a socket";
  return "it is a device";
}

ssize_t pread_again(int fd, char* to, std::size_t length, std::uint64_t offset) {
  ssize_t got = -1;
  do {
    got = ::pread(fd, to, std::min(length, kReadAtOnce), static_cast<off_t>(offset));
  } while (got < 0 && errno == EINTR);
  return got;
}

Copied copy_error(ResolveError error, std::string problem) {
  return {error, {}, std::move(problem)};
}

/// glibc has no wrapper for openat2(2), and other systems lack this call.
UniqueFd open_by_kernel(int root, const char* path) {
#ifdef __linux__
  open_how how{};
  how.flags = O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY;
  how.resolve = RESOLVE_BENEATH | RESOLVE_NO_MAGICLINKS;
  return UniqueFd(static_cast<int>(::syscall(SYS_openat2, root, path, &how, sizeof how)));
#else
  static_cast<void>(root);
  static_cast<void>(path);
  errno = ENOSYS;
  return {};
#endif
}

/// Errors on which the kernel and the walk always agree. After any other error the walk is tried:
/// old kernels and sandboxes refuse the call (ENOSYS, EPERM), renames disturb it (EAGAIN), and it
/// refuses absolute links that lead back inside (EXDEV).
bool is_final(int error) { return error == ENOENT || error == ENOTDIR || error == ENAMETOOLONG; }

constexpr int kLinkBudget = 40;  // as many as the kernel follows
constexpr int kPass = O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

struct Identity {
  dev_t device = 0;
  ino_t inode = 0;
  bool operator==(const Identity&) const = default;
};

Identity identity_of(const struct stat& status) { return {status.st_dev, status.st_ino}; }

// The folders above `root`, up to "/".
std::vector<Identity> folders_above(int root) {
  std::vector<Identity> above;
  struct stat status {};
  for (std::string way = ".."; ::fstatat(root, way.c_str(), &status, 0) == 0; way += "/..") {
    const Identity next = identity_of(status);
    if (!above.empty() && above.back() == next) break;
    above.push_back(next);
  }
  return above;
}

// RESOLVE_BENEATH in user space, with one difference: an absolute link that leads back into the
// root is followed. Nothing outside is opened except the folders above the root (O_PATH: passed
// through, not read); links are read by name.
class Walk {
 public:
  explicit Walk(int root) : root_(root) {}

  File run(std::string_view path) {
    struct stat status {};
    if (::fstat(root_, &status) != 0) return file_error(errno);
    root_identity_ = identity_of(status);
    push_components(path);
    if (path.starts_with('/') && !start_at_slash()) return file_error(EXDEV);
    File file;
    while (!todo_.empty()) {
      const std::string name = std::move(todo_.back());
      todo_.pop_back();
      if (step(name, file)) return outside_ ? file_error(EXDEV) : std::move(file);
    }
    return file_error(outside_ ? EXDEV : EISDIR);
  }

 private:
  /// The current folder of the walk. The root itself is not on the stack.
  int here() const { return folders_.empty() ? root_ : folders_.back().get(); }

  /// The first component is on top. Empty ones are kept: "file/" must not find a file.
  void push_components(std::string_view path) {
    while (true) {
      const std::size_t slash = path.rfind('/');
      if (slash == std::string_view::npos) break;
      todo_.emplace_back(path.substr(slash + 1));
      path = path.substr(0, slash);
    }
    if (!path.empty()) todo_.emplace_back(path);
  }

  /// Returns whether the walk has ended, with the result in `file`.
  bool step(const std::string& name, File& file) {
    if (name.empty() || name == ".") return false;
    if (name == "..") return step_up(file);
    struct stat status {};
    if (::fstatat(here(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
      return end(file, file_error(errno));
    }
    if (S_ISLNK(status.st_mode)) return follow(name, file);
    if (outside_ && !leads_to_root(identity_of(status))) return end(file, file_error(EXDEV));
    if (S_ISDIR(status.st_mode)) return enter(name, file);
    if (!todo_.empty()) return end(file, file_error(ENOTDIR));
    // A link that replaces the name meanwhile is refused by O_NOFOLLOW.
    return end(file, open_regular(here(), name.c_str(), O_NOFOLLOW));
  }

  bool leads_to_root(const Identity& folder) const {
    return folder == root_identity_ ||
           std::find(above_.begin(), above_.end(), folder) != above_.end();
  }

  static bool end(File& file, File result) {
    file = std::move(result);
    return true;
  }

  bool step_up(File& file) {
    if (!outside_ && folders_.empty()) return end(file, file_error(EXDEV));
    if (folders_.size() > (outside_ ? 1U : 0U)) folders_.pop_back();  // "/.." is "/"
    return false;
  }

  bool enter(const std::string& name, File& file) {
    UniqueFd folder(::openat(here(), name.c_str(), kPass));
    struct stat status {};
    if (!folder || ::fstat(folder.get(), &status) != 0) return end(file, file_error(errno));
    keep(std::move(folder), identity_of(status));
    return false;
  }

  void keep(UniqueFd folder, const Identity& identity) {
    if (identity == root_identity_) {
      folders_.clear();
      outside_ = false;
    } else {
      folders_.push_back(std::move(folder));
    }
  }

  bool follow(const std::string& link, File& file) {
    if (++links_ > kLinkBudget) return end(file, file_error(ELOOP));
    std::string target(PATH_MAX, '\0');
    const ssize_t length = ::readlinkat(here(), link.c_str(), target.data(), target.size());
    if (length < 0) return end(file, file_error(errno));
    target.resize(static_cast<std::size_t>(length));
    push_components(target);
    if (target.starts_with('/') && !start_at_slash()) return end(file, file_error(EXDEV));
    return false;
  }

  bool start_at_slash() {
    UniqueFd slash(::open("/", O_PATH | O_DIRECTORY | O_CLOEXEC));
    struct stat status {};
    if (!slash || ::fstat(slash.get(), &status) != 0) return false;
    folders_.clear();
    outside_ = true;
    above_ = folders_above(root_);
    keep(std::move(slash), identity_of(status));
    return true;
  }

  int root_;
  Identity root_identity_;
  std::vector<Identity> above_;    ///< filled by the first absolute link
  std::vector<UniqueFd> folders_;  ///< below the root; while outside: from "/" on
  std::vector<std::string> todo_;  ///< components still to walk, the next one last
  bool outside_ = false;
  int links_ = 0;
};

}  // namespace

File file_error(int error) {
  File file;
  file.error = error_of_errno(error);
  const bool said_already = error == ENOENT || file.error == ResolveError::no_permission ||
                            file.error == ResolveError::outside_root;
  if (!said_already) file.problem = error == EISDIR ? "it is a folder" : errno_text(error);
  return file;
}

File open_regular(int folder, const char* path, int flags) {
  UniqueFd fd(::openat(folder, path, kOpenFlags | flags));
  if (!fd) return file_error(errno);
  return adopt_regular(std::move(fd));
}

File adopt_regular(UniqueFd fd) {
  struct stat status {};
  if (::fstat(fd.get(), &status) != 0) return file_error(errno);
  File file;
  if (!S_ISREG(status.st_mode)) {
    file.error = ResolveError::not_regular;
    file.problem = kind_of(status.st_mode);
    return file;
  }
  file.size = static_cast<std::uint64_t>(status.st_size);
  file.state = state_of(status);
  file.fd = std::move(fd);
  return file;
}

Copied copy_range(int fd, std::uint64_t offset, std::uint64_t length) {
  TextRoom room(length);
  if (!room) {
    return copy_error(ResolveError::too_large,
                      fmt::format("there is not enough memory for {} bytes", length));
  }
  std::size_t done = 0;
  while (done < room.size()) {
    const ssize_t got = pread_again(fd, room.data() + done, room.size() - done, offset + done);
    if (got < 0) return copy_error(error_of_errno(errno), errno_text(errno));
    if (got == 0) {
      return copy_error(ResolveError::truncated, fmt::format("it ends at byte {}, expected {}",
                                                             offset + done, offset + length));
    }
    done += static_cast<std::size_t>(got);
  }
  return {ResolveError::none, std::move(room).share(), {}};
}

Loaded map_file(int fd, std::uint64_t size) {
  if (size == 0) return {};
  if (size > std::numeric_limits<std::size_t>::max()) {
    return {ResolveError::too_large, {}, "it does not fit in the address space"};
  }
  const std::size_t length = size;
  void* start = ::mmap(nullptr, length, PROT_READ, MAP_PRIVATE, fd, 0);
  if (start == MAP_FAILED) return {error_of_errno(errno), {}, errno_text(errno)};
  return {ResolveError::none,
          {{static_cast<const std::byte*>(start), length}, own_mapping(start, length)},
          {}};
}

Loaded load_file(const File& file) {
  if (file.error != ResolveError::none) return {file.error, {}, file.problem};
  if (file.size > kCopyBelow) return map_file(file.fd.get(), file.size);
  Copied copy = copy_range(file.fd.get(), 0, file.size);
  return {copy.error, Bytes::from_text(copy.text), std::move(copy.problem)};
}

File open_beneath(int root, const std::string& path, Confinement confinement) {
  if (path.find('\0') != std::string::npos) return file_error(ENOENT);
  if (path.size() >= PATH_MAX) return file_error(ENAMETOOLONG);
  const std::string named = path.empty() ? "." : path;
  if (confinement == Confinement::by_hand) return walk_beneath(root, named);
  UniqueFd fd = open_by_kernel(root, named.c_str());
  if (fd) return adopt_regular(std::move(fd));
  return is_final(errno) ? file_error(errno) : walk_beneath(root, named);
}

File walk_beneath(int root, const std::string& path) { return Walk(root).run(path); }

}  // namespace gltfx::container

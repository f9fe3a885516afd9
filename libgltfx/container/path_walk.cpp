// SPDX-License-Identifier: Apache-2.0
// RESOLVE_BENEATH done by hand, and more generous in one point: an absolute link that leads back
// into the root is followed. Outside the root folders are only passed through (O_PATH), never read.
#include <cerrno>
#include <climits>
#include <string_view>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "container/confined_open.hpp"

namespace gltfx::container {
namespace {

constexpr int kLinkBudget = 40;  // as many as the kernel follows
constexpr int kPeek = O_PATH | O_NOFOLLOW | O_CLOEXEC;

struct Identity {
  dev_t device = 0;
  ino_t inode = 0;
};

class Walk {
 public:
  explicit Walk(int root) : root_(root) {}

  File run(std::string_view path) {
    struct stat status {};
    if (::fstat(root_, &status) != 0) return file_fault(errno);
    root_identity_ = {status.st_dev, status.st_ino};
    push_components(path);
    if (path.starts_with('/') && !start_at_slash()) return file_fault(EXDEV);
    File file;
    while (!todo_.empty()) {
      const std::string name = std::move(todo_.back());
      todo_.pop_back();
      if (step(name, file)) return outside_ ? file_fault(EXDEV) : std::move(file);
    }
    return file_fault(outside_ ? EXDEV : EISDIR);
  }

 private:
  /// Where the walk stands. The root itself is not on the stack.
  int here() const { return folders_.empty() ? root_ : folders_.back().get(); }

  /// The first component comes to lie on top. Empty ones stay: "file/" must not find a file.
  void push_components(std::string_view path) {
    while (true) {
      const std::size_t slash = path.rfind('/');
      if (slash == std::string_view::npos) break;
      todo_.emplace_back(path.substr(slash + 1));
      path = path.substr(0, slash);
    }
    if (!path.empty()) todo_.emplace_back(path);
  }

  /// Returns whether the walk has come to its end, with the result in `file`.
  bool step(const std::string& name, File& file) {
    if (name.empty() || name == ".") return false;
    if (name == "..") return step_up(file);
    UniqueFd next(::openat(here(), name.c_str(), kPeek));
    struct stat status {};
    if (!next || ::fstat(next.get(), &status) != 0) return end(file, file_fault(errno));
    if (S_ISLNK(status.st_mode)) return follow(next.get(), file);
    if (S_ISDIR(status.st_mode)) {
      enter(std::move(next), status);
      return false;
    }
    if (!todo_.empty()) return end(file, file_fault(ENOTDIR));
    if (outside_) return end(file, file_fault(EXDEV));
    if (!S_ISREG(status.st_mode)) return end(file, adopt_regular(std::move(next)));
    // A link that takes the name's place meanwhile is refused by O_NOFOLLOW.
    return end(file, open_regular(here(), name.c_str(), O_NOFOLLOW));
  }

  static bool end(File& file, File result) {
    file = std::move(result);
    return true;
  }

  bool step_up(File& file) {
    if (!outside_ && folders_.empty()) return end(file, file_fault(EXDEV));
    if (folders_.size() > (outside_ ? 1U : 0U)) folders_.pop_back();  // "/.." is "/"
    return false;
  }

  void enter(UniqueFd folder, const struct stat& status) {
    if (status.st_dev == root_identity_.device && status.st_ino == root_identity_.inode) {
      folders_.clear();
      outside_ = false;
    } else {
      folders_.push_back(std::move(folder));
    }
  }

  bool follow(int link, File& file) {
    if (++links_ > kLinkBudget) return end(file, file_fault(ELOOP));
    std::string target(PATH_MAX, '\0');
    const ssize_t length = ::readlinkat(link, "", target.data(), target.size());
    if (length < 0) return end(file, file_fault(errno));
    if (length == 0) return end(file, file_fault(ENOENT));
    target.resize(static_cast<std::size_t>(length));
    push_components(target);
    if (target.front() == '/' && !start_at_slash()) return end(file, file_fault(EXDEV));
    return false;
  }

  bool start_at_slash() {
    UniqueFd slash(::open("/", O_PATH | O_DIRECTORY | O_CLOEXEC));
    struct stat status {};
    if (!slash || ::fstat(slash.get(), &status) != 0) return false;
    folders_.clear();
    outside_ = true;
    enter(std::move(slash), status);
    return true;
  }

  int root_;
  Identity root_identity_;
  std::vector<UniqueFd> folders_;  ///< below the root; while outside: from "/" on
  std::vector<std::string> todo_;  ///< components still to walk, the next one last
  bool outside_ = false;
  int links_ = 0;
};

}  // namespace

File walk_beneath(int root, const std::string& path) { return Walk(root).run(path); }

}  // namespace gltfx::container

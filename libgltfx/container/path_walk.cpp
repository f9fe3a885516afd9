// SPDX-License-Identifier: Apache-2.0
// RESOLVE_BENEATH done by hand, and more generous in one point: an absolute link that leads back
// into the root is followed. Nothing outside is opened on the way but the folders above the root
// (O_PATH: passed through, not read); links are read by name.
#include <algorithm>
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
    struct stat status {};
    if (::fstatat(here(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
      return end(file, file_error(errno));
    }
    if (S_ISLNK(status.st_mode)) return follow(name, file);
    if (outside_ && !leads_to_root(identity_of(status))) return end(file, file_error(EXDEV));
    if (S_ISDIR(status.st_mode)) return enter(name, file);
    if (!todo_.empty()) return end(file, file_error(ENOTDIR));
    // A link that takes the name's place meanwhile is refused by O_NOFOLLOW.
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

File walk_beneath(int root, const std::string& path) { return Walk(root).run(path); }

}  // namespace gltfx::container

// SPDX-License-Identifier: Apache-2.0
#include "base/replace_file.hpp"

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/temporary_files.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

namespace fs = std::filesystem;
using Trouble = std::optional<Error>;

constexpr mode_t kNewFile = 0666;
constexpr mode_t kPermissions = 07777;
constexpr mode_t kWritable = 0222;

std::string system_words(int error) {
  return std::error_code(error, std::generic_category()).message();
}

Error failure(std::string_view action, const fs::path& path, int error) {
  return {fmt::format("cannot {} {}: {}", action, quoted(path.native(), 200), system_words(error))};
}

Error refusal(const fs::path& path, std::string_view why) {
  return {fmt::format("{} {}", quoted(path.native(), 200), why)};
}

std::int64_t nanoseconds(const timespec& time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return static_cast<std::int64_t>(time.tv_sec) * kSecond + time.tv_nsec;
}

FileState state_of(const struct stat& status) {
  FileState state;
  state.device = status.st_dev;
  state.inode = status.st_ino;
  state.size = static_cast<std::uint64_t>(status.st_size);
  state.modified = nanoseconds(status.st_mtim);
  state.status_change = nanoseconds(status.st_ctim);
  return state;
}

// Why a file must not be replaced, or nothing.
Trouble objection(const fs::path& path, const struct stat& status, const FileState& seen) {
  if (!S_ISREG(status.st_mode)) return refusal(path, "is not a regular file");
  if (!(state_of(status) == seen)) {
    return refusal(path, "was changed by another program since it was read; run again");
  }
  if (status.st_nlink > 1) {
    return refusal(path, "has other hard links, which would keep the old bytes; copy it first");
  }
  if ((status.st_mode & kWritable) == 0 || ::access(path.c_str(), W_OK) != 0) {
    return refusal(path, "is read-only");
  }
  return std::nullopt;
}

/// A file beside its place, gone at the end of its life unless it was moved there.
class Temporary {
 public:
  explicit Temporary(const fs::path& target) : target_(target) {
    for (int attempt = 0; attempt < 1000 && fd_ < 0; ++attempt) {
      name_ = fmt::format("{}.{}-{}.part", target.native(), ::getpid(), attempt);
      kept_.emplace(name_);
      fd_ = ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, kNewFile);
      error_ = errno;
      if (fd_ < 0 && error_ != EEXIST) break;
    }
  }
  ~Temporary() {
    if (fd_ < 0) return;
    ::close(fd_);
    if (!moved_) ::unlink(name_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  Trouble fill(std::string_view bytes) {
    if (fd_ < 0) return failure("create a file beside", target_, error_);
    while (!bytes.empty()) {
      const ssize_t written = ::write(fd_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return failure("write", target_, errno);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return std::nullopt;
  }

  // The owner first: changing it takes special bits of the mode away.
  Trouble dress_as(const struct stat& old) {
    struct stat own {};
    if (::fstat(fd_, &own) != 0) return failure("look at", target_, errno);
    const bool same = own.st_uid == old.st_uid && own.st_gid == old.st_gid;
    if (!same && ::fchown(fd_, old.st_uid, old.st_gid) != 0) {
      return failure("keep the owner of", target_, errno);
    }
    if (::fchmod(fd_, old.st_mode & kPermissions) != 0) {
      return failure("keep the mode of", target_, errno);
    }
    return std::nullopt;
  }

  // EINVAL: a file system that cannot make anything durable.
  Trouble make_durable() {
    if (::fsync(fd_) != 0 && errno != EINVAL) return failure("write", target_, errno);
    return std::nullopt;
  }

  Trouble move_over() {
    if (std::rename(name_.c_str(), target_.c_str()) != 0) return failure("replace", target_, errno);
    moved_ = true;
    return sync_folder();
  }

  // Refused where there is something already. File systems that cannot rename so can link so.
  Trouble move_to_free_place() {
    const char* name = name_.c_str();
    moved_ = ::renameat2(AT_FDCWD, name, AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) == 0;
    const bool unknown = !moved_ && (errno == EINVAL || errno == ENOSYS);
    if (!moved_ && !(unknown && ::link(name, target_.c_str()) == 0)) {
      return failure("create", target_, errno);
    }
    return sync_folder();
  }

 private:
  Trouble sync_folder() const {
    const fs::path parent = target_.parent_path();
    const int folder =
        ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return failure("open the folder of", target_, errno);
    const int synced = ::fsync(folder);
    const int error = errno;
    ::close(folder);
    if (synced != 0 && error != EINVAL) return failure("make durable", target_, error);
    return std::nullopt;
  }

  const fs::path& target_;
  std::string name_;
  std::optional<TemporaryName> kept_;
  int fd_ = -1;
  int error_ = 0;
  bool moved_ = false;
};

}  // namespace

Result<FileState> file_state(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return failure("look at", path, errno);
  if (!S_ISREG(status.st_mode)) return refusal(path, "is not a regular file");
  return state_of(status);
}

std::optional<Error> replace_file(const fs::path& path, std::string_view bytes,
                                  const FileState& seen) {
  std::error_code fault;
  const fs::path target = fs::canonical(path, fault);
  if (fault) return failure("look at", path, fault.value());
  struct stat old {};
  const auto still_as_seen = [&]() -> Trouble {
    if (::stat(target.c_str(), &old) != 0) return failure("look at", path, errno);
    return objection(target, old, seen);
  };
  if (auto trouble = still_as_seen()) return trouble;
  Temporary file(target);
  if (auto trouble = file.fill(bytes)) return trouble;
  if (auto trouble = file.dress_as(old)) return trouble;
  if (auto trouble = file.make_durable()) return trouble;
  // Writing takes time in which somebody else may have saved the file.
  if (auto trouble = still_as_seen()) return trouble;
  return file.move_over();
}

std::optional<Error> create_file(const fs::path& path, std::string_view bytes) {
  Temporary file(path);
  if (auto trouble = file.fill(bytes)) return trouble;
  if (auto trouble = file.make_durable()) return trouble;
  return file.move_to_free_place();
}

std::optional<Error> write_file(const fs::path& path, std::string_view bytes) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 && errno == ENOENT) return create_file(path, bytes);
  const auto seen = file_state(path);
  if (!seen) return seen.error();
  return replace_file(path, bytes, *seen);
}

}  // namespace gltfx

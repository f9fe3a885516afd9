// SPDX-License-Identifier: Apache-2.0
#include "base/temporary_file.hpp"

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/stale_files.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

using Trouble = std::optional<Error>;

}  // namespace

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

Error file_error(std::string_view action, const std::filesystem::path& path, int error) {
  return {fmt::format("cannot {} {}: {}", action, quoted(path.native(), 200),
                      std::error_code(error, std::generic_category()).message())};
}

TemporaryFile::TemporaryFile(std::filesystem::path target, unsigned mode)
    : target_(std::move(target)) {
  remove_stale_files(target_);
  for (int attempt = 0; attempt < 1000 && !fd_; ++attempt) {
    name_ = temporary_name(target_, attempt);
    kept_.emplace(name_);
    constexpr int kFlags = O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW;
    fd_ = UniqueFd(::open(name_.c_str(), kFlags, mode));
    error_ = errno;
    if (!fd_ && error_ != EEXIST) break;
  }
}

TemporaryFile::~TemporaryFile() {
  if (fd_ && !moved_) ::unlink(name_.c_str());
}

Trouble TemporaryFile::write(std::string_view bytes) {
  if (!fd_) return file_error("create a file beside", target_, error_);
  if (write_all(fd_.get(), bytes)) return std::nullopt;
  if (errno != EFAULT) return file_error("write", target_, errno);
  return Error{fmt::format("cannot write {}: the file that it copies became shorter; run again",
                           quoted(target_.native(), 200))};
}

// EINVAL: a file system that cannot make anything durable.
Trouble TemporaryFile::make_durable() {
  if (::fsync(fd_.get()) == 0 || errno == EINVAL) return std::nullopt;
  return file_error("write", target_, errno);
}

UniqueFd TemporaryFile::reader() const { return UniqueFd(::fcntl(fd_.get(), F_DUPFD_CLOEXEC, 0)); }

// The folder is opened before the file moves: once it has moved, nothing may fail but the disk.
Result<UniqueFd> TemporaryFile::open_folder() const {
  const std::filesystem::path parent = target_.parent_path();
  UniqueFd folder(
      ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder) return file_error("open the folder of", target_, errno);
  return folder;
}

Trouble TemporaryFile::move_over() {
  const auto folder = open_folder();
  if (!folder) return folder.error();
  if (std::rename(name_.c_str(), target_.c_str()) != 0) {
    return file_error("replace", target_, errno);
  }
  moved_ = true;
  return sync(*folder);
}

// Refused where there is something already. File systems that cannot rename so can link so.
Trouble TemporaryFile::move_to_free_place() {
  const auto folder = open_folder();
  if (!folder) return folder.error();
  const char* name = name_.c_str();
  moved_ = ::renameat2(AT_FDCWD, name, AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) == 0;
  const bool unknown = !moved_ && (errno == EINVAL || errno == ENOSYS);
  if (!moved_ && !(unknown && ::link(name, target_.c_str()) == 0)) {
    return file_error("create", target_, errno);
  }
  return sync(*folder);
}

Trouble TemporaryFile::sync(const UniqueFd& folder) const {
  if (::fsync(folder.get()) == 0 || errno == EINVAL) return std::nullopt;
  return file_error("make durable", target_, errno);
}

}  // namespace gltfx

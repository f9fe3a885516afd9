// SPDX-License-Identifier: Apache-2.0
#include "base/file_state.hpp"

#include <cerrno>

#include <fmt/format.h>
#include <sys/stat.h>

#include "base/temporary_file.hpp"
#include "base/text.hpp"

namespace gltfx {
namespace {

std::int64_t nanoseconds(const timespec& time) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  return static_cast<std::int64_t>(time.tv_sec) * kSecond + time.tv_nsec;
}

}  // namespace

FileState state_of(const struct stat& status) {
  FileState state;
  state.device = status.st_dev;
  state.inode = status.st_ino;
  state.size = static_cast<std::uint64_t>(status.st_size);
  state.modified = nanoseconds(status.st_mtim);
  state.status_change = nanoseconds(status.st_ctim);
  return state;
}

Result<FileState> file_state(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return file_error("look at", path, errno);
  if (S_ISREG(status.st_mode)) return state_of(status);
  return Error{fmt::format("{} is not a regular file", quoted(path.native(), 200))};
}

}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
#include "container/file.hpp"

#include <algorithm>
#include <cerrno>
#include <limits>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "container/mapping.hpp"

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

}  // namespace gltfx::container

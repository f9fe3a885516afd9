// SPDX-License-Identifier: Apache-2.0
/// Lower bound of a run over a folder: walks it and reads every file once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gltfx::bench {

/// Reads a file into `buffer`, which only ever grows. Returns its size in bytes, 0 when it cannot
/// be read.
inline std::uint64_t read_file(const char* path, std::vector<char>& buffer) {
  const int fd = open(path, O_RDONLY | O_CLOEXEC);
  if (fd < 0) return 0;
  struct stat status {};
  std::uint64_t total = 0;
  if (fstat(fd, &status) == 0) {
    const auto size = static_cast<std::size_t>(status.st_size);
    if (buffer.size() < size) buffer.resize(size);
    for (ssize_t n = 1; n > 0 && total < size; total += static_cast<std::uint64_t>(n)) {
      n = read(fd, buffer.data() + total, size - total);
      if (n < 0) n = 0;
    }
  }
  close(fd);
  return total;
}

/// Bytes of all regular files below `folder`.
inline std::uint64_t read_all(const std::string& folder) {
  std::vector<char> buffer;
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) bytes += read_file(entry.path().c_str(), buffer);
  }
  return bytes;
}

}  // namespace gltfx::bench

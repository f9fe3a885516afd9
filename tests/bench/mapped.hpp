// SPDX-License-Identifier: Apache-2.0
/// A whole file, mapped read-only until the program ends.
#pragma once

#include <string_view>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gltfx::bench {

/// Empty when the file cannot be mapped.
inline std::string_view mapped(const char* path) {
  const int fd = ::open(path, O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (fd < 0 || ::fstat(fd, &status) != 0) return {};
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0);
  ::close(fd);
  return start == MAP_FAILED ? std::string_view()
                             : std::string_view(static_cast<char*>(start), size);
}

}  // namespace gltfx::bench

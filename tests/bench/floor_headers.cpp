// SPDX-License-Identifier: Apache-2.0
// Floor of a check of image headers: maps a GLB and touches the first bytes of its images, one
// every `step` bytes of the file.
//
//   floor_headers FILE.glb IMAGES
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const int fd = ::open(argv[1], O_RDONLY | O_CLOEXEC);
  struct stat status {};
  if (fd < 0 || ::fstat(fd, &status) != 0) return 3;
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const start = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0);
  if (start == MAP_FAILED) return 3;
  const std::size_t step = size / static_cast<std::size_t>(std::max(1, std::atoi(argv[2])));
  unsigned sum = 0;
  for (std::size_t at = 0; at < size; at += std::max<std::size_t>(step, 1)) {
    sum += static_cast<const unsigned char*>(start)[at];
  }
  std::printf("%u\n", sum);
  return 0;
}

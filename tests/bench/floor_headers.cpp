// SPDX-License-Identifier: Apache-2.0
// Floor of a check of image headers: maps a GLB and touches the first bytes of its images, one
// every `step` bytes of the file.
//
//   floor_headers FILE.glb IMAGES
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "mapped.hpp"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::string_view file = gltfx::bench::mapped(argv[1]);
  if (file.empty()) return 3;
  const std::size_t step = file.size() / static_cast<std::size_t>(std::max(1, std::atoi(argv[2])));
  unsigned sum = 0;
  for (std::size_t at = 0; at < file.size(); at += std::max<std::size_t>(step, 1)) {
    sum += static_cast<unsigned char>(file[at]);
  }
  std::printf("%u\n", sum);
  return 0;
}

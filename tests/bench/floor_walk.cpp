// SPDX-License-Identifier: Apache-2.0
// Floor of a run over many files: walks a folder and reads every file, as a whole process.
#include <cstdio>

#include "read_all.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  std::printf("%llu bytes\n", static_cast<unsigned long long>(gltfx::bench::read_all(argv[1])));
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// Lower bound of a validation of JSON text: reads the file and builds the flat document.
//
//   floor_json FILE.gltf
#include <cstdio>

#include "container/container.hpp"
#include "json/parse.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: floor_json FILE.gltf\n", stderr);
    return 2;
  }
  const auto opened = gltfx::container::open_file(argv[1]);
  if (!opened) return 3;
  return gltfx::json::parse(opened->json).document.empty() ? 1 : 0;
}

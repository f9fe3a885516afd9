// SPDX-License-Identifier: Apache-2.0
/// tinygltf IN OUT: reads an asset as a model of tinygltf and writes it again.
#include <gltfx/tinygltf.hpp>

#include <iostream>

#include <tiny_gltf.h>

int main(int count, char** words) {
  if (count != 3) return 2;
  tinygltf::Model model;
  const gltfx::TinygltfReport in = gltfx::to_tinygltf(std::string(words[1]), model);
  for (const gltfx::TinygltfNote& note : in.notes) {
    std::cout << note.pointer << ' ' << note.message << '\n';
  }
  const gltfx::TinygltfReport out = gltfx::from_tinygltf(model, std::string(words[2]));
  std::cout << model.meshes.size() << " meshes. " << in.error << out.error << '\n';
  return in.done && out.done ? 0 : 1;
}

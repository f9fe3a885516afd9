// SPDX-License-Identifier: Apache-2.0
// Draws an asset and measures the memory of this process:
//   bake_memory ASSET SIZE SAMPLES JOBS
// prints bytes of what is drawn (vertices with all attributes that are used, indices, decoded
// texels: each once, packed as the scene holds them), and the peak above an idle process when the
// scene is there, and when the picture is.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

#include "base/pages.hpp"
#include "pipeline/bake_picture.hpp"
#include "pipeline/bake_scene.hpp"
#include "pipeline/bake_views.hpp"

namespace {

using namespace gltfx;

std::size_t bytes_of(const render::Scene& scene) {
  std::size_t bytes = 0;
  std::set<const void*> counted;  // meshes share arrays, and textures images
  const auto add = [&](const auto& values) {
    if (values.empty() || !counted.insert(&*values.begin()).second) return;
    bytes += values.size() * sizeof(*values.begin());
  };
  for (const render::Mesh& mesh : scene.meshes) {
    add(mesh.triangles);
    add(mesh.positions);
    add(mesh.normals);
    add(mesh.tangents);
    add(mesh.colors);
    for (const auto& set : mesh.uvs) add(set);
  }
  for (const render::Texture& texture : scene.textures) add(texture.pixels);
  return bytes;
}

// Not by getrusage(), whose peak begins with that of the process that started this one.
std::size_t peak() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return std::stoull(line.substr(6)) * 1024;
  }
  std::exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const std::size_t idle = peak();
  BakeOptions options;
  const auto size = static_cast<std::uint32_t>(std::atoi(argv[2]));
  options.samples = static_cast<std::uint32_t>(std::atoi(argv[3]));
  options.jobs = static_cast<unsigned>(std::atoi(argv[4]));
  BakeScene loaded = load_bake_scene(argv[1], options);
  if (!loaded.ready()) return 1;
  const std::size_t loading = peak() - idle;
  const render::View view = choose_views(loaded, options, 1)->front();
  loaded.subject->forget_faces();
  give_back_memory();
  const render::Framebuffer drawn =
      draw_picture(loaded, view, {size, size}, options, layers_of(options), {});
  std::printf("%zu %zu %zu\n", bytes_of(*loaded.scene), loading, peak() - idle);
  return 0;
}

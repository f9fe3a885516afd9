// SPDX-License-Identifier: Apache-2.0
#include "bake/bvh_groups.hpp"

#include <algorithm>
#include <cmath>

#include "bake/coverage.hpp"
#include "bake/storage.hpp"

namespace gltfx::bake {

Treatment treatment_of(const SceneMaterial& material) {
  if (has_holes(material)) return Treatment::holed;
  return is_culled(material) ? Treatment::culled : Treatment::solid;
}

Groups group_instances(const Scene& scene) {
  Groups result;
  constexpr std::size_t kMostFlattened = 1U << 20U;
  std::size_t flattened = 0;  // triangles
  std::vector<std::uint32_t> uses(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances) ++uses[instance.mesh];
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    result.facing.push_back(determinant(instance.to_world) < 0 ? -1 : 1);
    if (mesh.triangles.empty()) continue;
    result.triangles += mesh.triangles.size();
    const double stretch = uses[instance.mesh] > 1 ? stretch_into(instance.to_world) : 0;
    if (stretch > 0 && std::isfinite(stretch)) {
      result.instanced.push_back(i);
      result.farthest = std::min(result.farthest, kFarthest / stretch);
      continue;
    }
    // What is flattened lies in the world, as long as there is not too much of it.
    flattened += stretch > 0 ? mesh.triangles.size() : 0;
    if (flattened > kMostFlattened) continue;
    Group& group = result.flat[static_cast<std::size_t>(treatment_of(material_of(scene, mesh)))];
    group.instances.push_back(i);
    group.first.push_back(group.triangles);
    group.triangles += mesh.triangles.size();
    group.vertices += mesh.positions.size();
    group.mirrored = group.mirrored || result.facing.back() < 0;
  }
  return result;
}

}  // namespace gltfx::bake

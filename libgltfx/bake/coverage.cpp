// SPDX-License-Identifier: Apache-2.0
#include "bake/coverage.hpp"

#include <algorithm>

#include "bake/texture.hpp"

namespace gltfx::bake {
namespace {

template <std::size_t N>
std::array<float, N> interpolate(const std::vector<std::array<float, N>>& values, const Mesh& mesh,
                                 const Hit& hit) {
  const auto& [a, b, c] = mesh.triangles[hit.triangle];
  std::array<float, N> sum{};
  for (std::size_t i = 0; i < N; ++i) {
    sum[i] = values[a][i] * (1 - hit.u - hit.v) + values[b][i] * hit.u + values[c][i] * hit.v;
  }
  return sum;
}

}  // namespace

const SceneMaterial& material_of(const Scene& scene, const Mesh& mesh) {
  static const SceneMaterial kDefault;
  return mesh.material == kNone ? kDefault : scene.materials[mesh.material];
}

bool has_holes(const SceneMaterial& material) { return material.alpha_mode != AlphaMode::opaque; }

bool is_culled(const SceneMaterial& material) {
  return !material.double_sided && !material.factors.volumetric();
}

Float2 uv_at(const Mesh& mesh, std::uint32_t set, const Hit& hit) {
  if (set >= mesh.uvs.size() || mesh.uvs[set].empty()) return {0, 0};
  return interpolate(mesh.uvs[set], mesh, hit);
}

Float4 color_at(const Mesh& mesh, const Hit& hit) {
  if (mesh.colors.empty()) return {1, 1, 1, 1};
  return interpolate(mesh.colors, mesh, hit);
}

float coverage_at(const Scene& scene, const Mesh& mesh, const SceneMaterial& material,
                  const Hit& hit) {
  float alpha = material.alpha * color_at(mesh, hit)[3];
  const TextureUse& use = material.use(Slot::base_color);
  if (use.texture != kNone) {
    const Float2 uv = transform_uv(use, uv_at(mesh, use.uv_set, hit));
    alpha *= sample_channel(scene.textures[use.texture], uv[0], uv[1], 3);
  }
  if (material.alpha_mode == AlphaMode::mask) return alpha < material.alpha_cutoff ? 0.0F : 1.0F;
  return std::clamp(alpha, 0.0F, 1.0F);
}

}  // namespace gltfx::bake

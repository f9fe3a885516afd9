// SPDX-License-Identifier: Apache-2.0
#include "pipeline/scene_detail.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/packed.hpp"
#include "render/surface.hpp"
#include "render/texture.hpp"
#include "render/transform.hpp"

namespace gltfx {
namespace {

constexpr int kMostHalvings = 8;
constexpr std::size_t kMostTriangles = 4096;  // of a mesh that are looked at
constexpr double kStretched = 0.02;           // part of the surface that may have fewer texels

/// The areas of a texture's surface, by the number of texels for each pixel.
class TexelDensity {
 public:
  /// `texels`: along a side of a pixel.
  void add(double texels, double area) {
    if (!(area > 0) || !std::isfinite(area) || !std::isfinite(texels)) return;
    const double level = texels > 0 ? std::floor(std::log2(texels)) : 0;
    areas_[static_cast<std::size_t>(std::clamp(level, 0.0, double{kMostHalvings}))] += area;
    all_ += area;
  }
  std::uint32_t halvings() const {
    std::uint32_t level = 0;
    double fewer = 0;  // area with less than 2^(level + 1) texels a pixel
    while (level < kMostHalvings) {
      fewer += areas_[level];
      if (all_ <= 0 || fewer > kStretched * all_) break;
      ++level;
    }
    return level > 0 ? level - 1 : 0;
  }

 private:
  std::array<double, kMostHalvings + 1> areas_{};
  double all_ = 0;
};

/// One mesh in one place.
class PlacedMesh {
 public:
  PlacedMesh(const render::Mesh& mesh, const render::Matrix34& to_world, double pixel)
      : mesh_(mesh), to_world_(to_world), pixel_(pixel) {}

  void add_to(TexelDensity& density, const render::TextureUse& use, const ImageSize& image) const {
    if (use.uv_set >= mesh_.uvs.size() || mesh_.uvs[use.uv_set].empty()) return;
    const std::size_t step = mesh_.triangles.size() / kMostTriangles + 1;
    for (std::size_t i = 0; i < mesh_.triangles.size(); i += step) {
      const double area = world_area(mesh_.triangles[i]);
      const double texels =
          double{1} * image.width * image.height * image_area(use, mesh_.triangles[i]) / area;
      density.add(std::sqrt(texels) * pixel_, area);
    }
  }

 private:
  using Corners = std::array<std::uint32_t, 3>;

  double world_area(const Corners& corners) const {
    const auto at = [&](std::size_t i) { return to_vec(mesh_.positions[corners[i]]); };
    const Vec3d u = render::transform_vector(to_world_, at(1) - at(0));
    const Vec3d v = render::transform_vector(to_world_, at(2) - at(0));
    return length(cross(u, v)) / 2;
  }

  double image_area(const render::TextureUse& use, const Corners& corners) const {
    const auto at = [&](std::size_t i) {
      const Float2 uv = render::transform_uv(use, mesh_.uvs[use.uv_set][corners[i]]);
      return Vec3d(uv[0], uv[1], 0);
    };
    return std::fabs(cross(at(1) - at(0), at(2) - at(0)).z) / 2;
  }

  const render::Mesh& mesh_;
  const render::Matrix34& to_world_;
  double pixel_;
};

}  // namespace

std::vector<std::uint32_t> find_halvings(const render::Scene& scene,
                                         const std::vector<ImageSize>& images, double pixel) {
  std::vector<TexelDensity> densities(images.size());
  for (const render::Instance& instance : scene.instances) {
    for (std::uint32_t i = 0; i < instance.count; ++i) {
      const render::Mesh& mesh = scene.meshes[instance.mesh + i];
      const PlacedMesh placed(mesh, instance.to_world, pixel);
      for (const render::TextureUse& use : render::material_of(scene, mesh).textures) {
        if (use.texture == render::kNone || images[use.texture].width == 0) continue;
        placed.add_to(densities[use.texture], use, images[use.texture]);
      }
    }
  }
  std::vector<std::uint32_t> halvings;
  for (const TexelDensity& density : densities) halvings.push_back(density.halvings());
  return halvings;
}

}  // namespace gltfx

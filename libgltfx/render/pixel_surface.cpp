// SPDX-License-Identifier: Apache-2.0
#include "render/pixel_surface.hpp"

#include "base/packed.hpp"
#include "render/feature_recorder.hpp"
#include "render/material_at.hpp"
#include "render/surface.hpp"
#include "render/transform.hpp"
#include "shader/directions.hpp"

namespace gltfx::render {
namespace {

bool is_plain(const Mesh& mesh, const SceneMaterial& material) {
  return mesh.colors.empty() && !mesh.unlit && !material.factors.unlit && !has_holes(material) &&
         !(max_value(material.factors.emissive) > 0);
}

}  // namespace

void PixelSurface::add(const Float2& point, const std::optional<Hit>& hit,
                       const PathSample& sample) {
  if (!hit || count_ == kRays || (count_ > 0 && hit->body() != seen_[0].hit.body())) {
    missed_ = true;
    return;
  }
  seen_[count_++] = {point, *hit};
  middle_ += Vec3d(point[0], point[1], 0) / kRays;
  normal_ += sample.features.normal / kRays;
  depth_ += sample.features.depth / kRays;
}

Vec3d PixelSurface::from_middle(const Float2& point) const {
  return Vec3d(point[0], point[1], 0) - middle_;
}

Float2 PixelSurface::uv_at(std::size_t set, const Float2& point) const {
  const Vec3d p = from_middle(point);
  const auto at = [&p](const Affine& along) {
    return static_cast<float>(along.middle + along.along_x * p.x + along.along_y * p.y);
  };
  return {at(sets_[set][0]), at(sets_[set][1])};
}

bool PixelSurface::fit(std::size_t set) {
  constexpr double kMostApart = 0.25;  // of the standard deviation within the pixel
  const Mesh& mesh = scene_.meshes[seen_[0].hit.mesh];
  std::array<Float2, kRays> uvs;
  for (std::size_t i = 0; i < kRays; ++i) {
    uvs[i] = render::uv_at(mesh, static_cast<std::uint32_t>(set), seen_[i].hit);
    for (std::size_t k = 0; k < 2; ++k) {
      sets_[set][k].middle += static_cast<double>(uvs[i][k]) / kRays;
    }
  }
  double xx = 0;
  double xy = 0;
  double yy = 0;
  double spread = 0;
  for (std::size_t i = 0; i < kRays; ++i) {
    const Vec3d p = from_middle(seen_[i].point);
    xx += p.x * p.x;
    xy += p.x * p.y;
    yy += p.y * p.y;
    for (std::size_t k = 0; k < 2; ++k) {
      Affine& along = sets_[set][k];
      const double apart = static_cast<double>(uvs[i][k]) - along.middle;
      along.along_x += apart * p.x;
      along.along_y += apart * p.y;
      spread += apart * apart / kRays;
    }
  }
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0)) return false;
  for (Affine& along : sets_[set]) {
    along = {along.middle, (along.along_x * yy - along.along_y * xy) / determinant,
             (along.along_y * xx - along.along_x * xy) / determinant};
  }
  for (std::size_t i = 0; i < kRays; ++i) {
    const Float2 found = uv_at(set, seen_[i].point);
    const auto u = static_cast<double>(found[0] - uvs[i][0]);
    const auto v = static_cast<double>(found[1] - uvs[i][1]);
    if (!(u * u + v * v <= spread * shader::square(kMostApart))) return false;
  }
  return true;
}

bool PixelSurface::fit() {
  if (missed_ || count_ < kRays) return false;
  const Mesh& mesh = scene_.meshes[seen_[0].hit.mesh];
  const std::size_t sets = mesh.uvs.size();
  if (sets == 0 || sets > kMostSets || !is_plain(mesh, material_of(scene_, mesh))) return false;
  for (std::size_t set = 0; set < sets; ++set) {
    if (!fit(set)) return false;
  }
  return true;
}

PathSample PixelSurface::at(const Float2& point) const {
  const Hit& hit = seen_[0].hit;
  const Mesh& mesh = scene_.meshes[hit.mesh];
  std::array<Float2, kMostSets> uvs{};
  for (std::size_t set = 0; set < mesh.uvs.size(); ++set) uvs[set] = uv_at(set, point);
  const SlotReader reader(scene_, mesh, material_of(scene_, mesh), hit, uvs);
  PathSample sample;
  sample.features = features_of(material_at(reader), normal_, depth_, mesh.material);
  sample.alpha = 1;
  return sample;
}

}  // namespace gltfx::render

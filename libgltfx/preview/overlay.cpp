// SPDX-License-Identifier: Apache-2.0
#include "preview/overlay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "base/packed.hpp"
#include "base/parallel.hpp"
#include "render/background.hpp"
#include "render/camera_packet.hpp"
#include "render/film.hpp"
#include "render/surface.hpp"
#include "render/texture.hpp"
#include "render/transform.hpp"

namespace gltfx::preview {
namespace {

constexpr std::uint32_t kSamples = 16;  // of a pixel

// A triangle in the world.
struct Corners {
  std::array<Vec3d, 3> points;
  double side = 1;  ///< -1: the instance mirrors it
  Vec3d area() const { return cross(points[1] - points[0], points[2] - points[0]) * (side / 2); }
};

Corners corners_of(const render::Scene& scene, const render::Hit& hit) {
  const render::Mesh& mesh = scene.meshes[hit.mesh];
  const render::Matrix34& to_world = scene.instances[hit.instance].to_world;
  Corners corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = mesh.triangles[hit.triangle][i];
    corners.points[i] = render::transform_point(to_world, to_vec(mesh.positions[vertex]));
  }
  if (render::determinant(to_world) < 0) corners.side = -1;
  return corners;
}

// Runs draw(x, y) for all pixels of some rows.
void for_each_pixel(std::uint32_t width, const render::Rows& rows, unsigned jobs,
                    const std::function<void(std::uint32_t, std::uint32_t)>& draw) {
  parallel_ordered(
      rows.last - rows.first, jobs,
      [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(rows.first + row);
        for (std::uint32_t x = 0; x < width; ++x) draw(x, y);
      },
      [](std::size_t) {});
}

// The distance of a ray from the nearest edge, as part of the size of a pixel.
double pixels_to_edge(const Corners& corners, const render::Ray& ray, double pixel) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d& from = corners.points[i];
    const Vec3d across = cross(ray.direction, corners.points[(i + 1) % 3] - from);
    const double size = length(across);
    if (!(size > 0)) continue;  // seen as a point
    nearest = std::min(nearest, std::fabs(dot(from - ray.origin, across)) / size);
  }
  return nearest / pixel;
}

// The extent of a pixel at a hit.
double pixel_at(const render::View& view, const render::Ray& ray, const render::Hit& hit,
                std::uint32_t height) {
  const double pixel = 2 * view.half_height / height;
  return view.perspective ? pixel * hit.distance * dot(ray.direction, -view.backward) : pixel;
}

Rgb hue_of(double position) {  // 0 blue, 0.25 cyan, 0.5 green, 0.75 yellow, 1 red
  const double at = std::clamp(position, 0.0, 1.0) * 4;
  return {std::clamp(at - 2, 0.0, 1.0), std::clamp(std::min(at, 4 - at), 0.0, 1.0),
          std::clamp(2 - at, 0.0, 1.0)};
}

const Rgb kUnmapped(0.25);

Rgb uv_color(const render::Scene& scene, const render::Hit& hit) {
  const render::Mesh& mesh = scene.meshes[hit.mesh];
  const auto& use = render::material_of(scene, mesh).use(render::Slot::base_color);
  if (use.uv_set >= mesh.uvs.size() || mesh.uvs[use.uv_set].empty()) return kUnmapped;
  const Float2 uv = render::uv_at(mesh, use.uv_set, hit);
  const double u = static_cast<double>(uv[0]);
  const double v = static_cast<double>(uv[1]);
  const bool even = std::remainder(std::floor(u * 8) + std::floor(v * 8), 2) == 0;
  return Rgb(u - std::floor(u), v - std::floor(v), 0.4) * (even ? 1.0 : 0.45);
}

// Twice the area of a triangle in texels of a texture.
double texels_of(const render::Mesh& mesh, const render::Hit& hit, const render::TextureUse& use,
                 const render::Texture& texture) {
  std::array<Vec3d, 3> at;
  for (std::size_t i = 0; i < 3; ++i) {
    const Float2 uv =
        render::transform_uv(use, mesh.uvs[use.uv_set][mesh.triangles[hit.triangle][i]]);
    at[i] = {static_cast<double>(uv[0]) * texture.width,
             static_cast<double>(uv[1]) * texture.height, 0};
  }
  return length(cross(at[1] - at[0], at[2] - at[0]));
}

Rgb density_color(const render::Scene& scene, const render::Hit& hit) {
  const render::Mesh& mesh = scene.meshes[hit.mesh];
  const render::SceneMaterial& material = render::material_of(scene, mesh);
  const render::TextureUse* use = &material.use(render::Slot::base_color);
  if (use->texture == render::kNone && !material.textures.empty()) use = &material.textures[0];
  if (use->texture == render::kNone || use->uv_set >= mesh.uvs.size() ||
      mesh.uvs[use->uv_set].empty() || scene.textures[use->texture].missing) {
    return kUnmapped;
  }
  const double texels = texels_of(mesh, hit, *use, scene.textures[use->texture]);
  const double area = length(corners_of(scene, hit).area()) * 2;
  if (!(area > 0 && texels > 0)) return kUnmapped;
  constexpr double kLeast = 6;  // 2^6 texels a metre are blue, 2^14 red
  constexpr double kRange = 8;
  return hue_of((std::log2(texels / area) / 2 - kLeast) / kRange);
}

Rgb facing_color(bool front) { return front ? Rgb(0.1, 0.3, 0.9) : Rgb(0.9, 0.1, 0.06); }

Rgb color_at(const render::Scene& scene, Diagram diagram, const render::Hit& hit, bool front) {
  switch (diagram) {
    case Diagram::uv:
      return uv_color(scene, hit);
    case Diagram::density:
      return density_color(scene, hit);
    case Diagram::facing:
      break;
  }
  return facing_color(front);
}

// `surfaces`: with the features that need the material.
render::PathSample diagram_sample(const render::TraceContext& context, Diagram diagram,
                                  bool surfaces, const render::CameraSample& camera,
                                  const std::optional<render::Hit>& hit) {
  if (!hit) {
    render::PathSample beside;
    beside.background = render::background(context, camera.ray.direction, camera.point);
    return beside;
  }
  render::PathSample sample;
  sample.alpha = 1;
  if (surfaces) {
    const render::Surface surface = render::surface_at(context.scene, *hit, camera.ray);
    sample.features.albedo = surface.material.base_color;
    sample.features.normal = surface.frame.normal;
  }
  sample.features.depth = hit->distance;
  sample.features.material = context.scene.meshes[hit->mesh].material;
  const Vec3d area = corners_of(context.scene, *hit).area();
  const double facing = length(area) > 0 ? dot(area, -camera.ray.direction) / length(area) : 0.0;
  sample.emitted =
      color_at(context.scene, diagram, *hit, facing >= 0) * (0.35 + 0.65 * std::fabs(facing));
  return sample;
}

}  // namespace

void make_clay(render::Scene& scene) {
  if (scene.materials.empty()) scene.materials.emplace_back();
  for (render::SceneMaterial& material : scene.materials) {
    render::SceneMaterial clay;
    clay.name = std::move(material.name);
    clay.double_sided = material.double_sided;
    clay.factors.base_color = Rgb(0.6);
    clay.factors.metallic = 0;
    clay.factors.roughness = 0.9;
    material = std::move(clay);
  }
  for (render::Mesh& mesh : scene.meshes) {
    mesh.colors.clear();
    mesh.unlit = false;
    if (mesh.material == render::kNone) mesh.material = 0;
  }
}

void draw_wireframe(const render::TraceContext& context, const render::View& view, unsigned jobs,
                    render::Framebuffer& picture) {
  constexpr double kHalfWidth = 0.6;  // pixels
  constexpr float kInk = 0.02F;
  const render::Rows all{0, picture.height};
  for_each_pixel(picture.width, all, jobs, [&](std::uint32_t x, std::uint32_t y) {
    std::uint32_t inked = 0;
    const render::PixelSamples samples(picture.width, picture.height, 0, x, y);
    render::visit_camera_samples(
        context.bvh, 0, kSamples, view, samples,
        [&](const render::CameraSample& camera, const std::optional<render::Hit>& hit) {
          if (!hit) return;
          const double pixel = pixel_at(view, camera.ray, *hit, picture.height);
          const Corners corners = corners_of(context.scene, *hit);
          inked += pixels_to_edge(corners, camera.ray, pixel) < kHalfWidth ? 1U : 0U;
        });
    const float part = static_cast<float>(inked) / kSamples;
    Float3& color = picture.radiance[std::size_t{y} * picture.width + x];
    for (float& channel : color) channel = channel * (1 - part) + kInk * part;
  });
}

render::Framebuffer draw_diagram(const render::TraceContext& context, const render::View& view,
                                 Diagram diagram, const render::PictureOptions& options) {
  constexpr std::uint32_t kAtOnce = 64;  // rows
  const std::uint32_t width = options.render.width;
  const std::uint32_t height = options.render.height;
  render::Framebuffer picture(width, height, options.layers);
  render::Film film(width, height, {});
  const bool surfaces = options.layers.albedo || options.layers.normal;
  const auto draw = [&](std::uint32_t x, std::uint32_t y) {
    const std::size_t pixel = std::size_t{y} * width + x;
    const render::PixelSamples samples(width, height, options.render.seed, x, y);
    const auto add = [&](const render::CameraSample& camera,
                         const std::optional<render::Hit>& hit) {
      film.add(pixel, diagram_sample(context, diagram, surfaces, camera, hit));
    };
    if (diagram != Diagram::facing) {
      render::visit_camera_samples(context.bvh, 0, kSamples, view, samples, add);
      return;
    }
    std::array<render::CameraSample, kSamples> cameras;  // see the backs of single-sided surfaces
    samples.fill(view, 0, cameras);
    for (const render::CameraSample& camera : cameras) {
      add(camera, context.bvh.intersect(camera.ray, camera.random.key(), render::Backs::solid));
    }
  };
  for (std::uint32_t row = 0; row < height; row += kAtOnce) {
    const render::Rows rows{row, std::min(row + kAtOnce, height)};
    film.hold(rows);
    for_each_pixel(width, rows, options.render.jobs, draw);
    render::resolve(film, rows, picture);
    if (options.render.progress) {
      options.render.progress(static_cast<double>(rows.last) / height);
    }
  }
  return picture;
}

}  // namespace gltfx::preview

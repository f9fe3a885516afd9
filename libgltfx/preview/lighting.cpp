// SPDX-License-Identifier: Apache-2.0
#include "preview/lighting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/packed.hpp"
#include "preview/interior.hpp"
#include "render/background.hpp"
#include "render/environment.hpp"
#include "render/light.hpp"
#include "render/surface.hpp"
#include "shader/directions.hpp"

namespace gltfx::preview {
namespace {

constexpr std::uint32_t kStudioWidth = 256;
constexpr std::uint32_t kStudioHeight = 128;
constexpr double kDegree = std::numbers::pi / 180;

// A lamp behind a screen: a rectangle of directions with soft edges.
struct SoftBox {
  double azimuth, elevation;  // degrees; azimuth to the right of the camera
  double width, height;       // degrees, half
  Rgb radiance;
};

// The usual set of a product photographer; ratios are chosen for their look; scale_to_white() sets
// the brightness.
constexpr std::array<SoftBox, 4> kBoxes{{
    {-42, 46, 24, 20, {9.6, 9.3, 8.8}},   // key
    {62, 18, 20, 34, {1.9, 2.0, 2.2}},    // fill
    {158, 40, 26, 16, {6.2, 6.4, 6.8}},   // rim
    {-120, 20, 10, 40, {2.4, 2.4, 2.4}},  // edge
}};

// White and grey squares differ from the dim backdrop by 22 steps of CIE L* at least; from the
// usual one, by 1.6 to 6.5.
constexpr double kDimBackdrop = 0.4;

// Ambient light: bright above, and reflected by the ground below.
Rgb ambient(double elevation) {
  const double above = render::smooth_step(-8, 70, elevation);
  const double below = render::smooth_step(-2, -60, elevation);
  const Rgb horizon(0.50, 0.51, 0.53);
  return horizon + Rgb(0.55, 0.56, 0.58) * above - Rgb(0.20, 0.22, 0.25) * below;
}

double within(const SoftBox& box, double azimuth, double elevation) {
  constexpr double kEdge = 6;  // degrees
  double across = std::fabs(azimuth - box.azimuth);
  if (across > 180) across = 360 - across;
  across *= std::cos(elevation * kDegree);
  const double upwards = std::fabs(elevation - box.elevation);
  return render::smooth_step(box.width + kEdge, box.width, across) *
         render::smooth_step(box.height + kEdge, box.height, upwards);
}

// The remaining fraction of the light from a direction. With kPlainWhite, the sides of a cube of
// the default material then differ: CIE L* 76, 52 and 90.
double modelling_share(double azimuth) {
  return 1 - 0.6 * render::smooth_step(20, 80, azimuth) * render::smooth_step(175, 150, azimuth);
}

// A white surface that faces the camera becomes as bright as this.
constexpr double kWhite = 1.0;

// The same for assets of the default material alone, a rough white metal: no side of a cube then
// reaches the shoulder of the tone curve, where they would look alike.
constexpr double kPlainWhite = 0.6;

// In the studio, surfaces that are no brighter are found by paths, like lit surfaces.
constexpr double kDim = 1.5 * kWhite;

void scale_to_white(render::EnvironmentImage& image, const Vec3d& normal, double white) {
  const Rgb light = irradiance(image, normal);
  const auto scale = static_cast<float>(white * std::numbers::pi / luminance(light));
  for (Float3& texel : image.radiance) {
    for (float& part : texel) part *= scale;
  }
}

// Lux at which a white surface is white.
constexpr double kFull = std::numbers::pi;

// The illumination of the subject by its lights: the mean over the middle and corners of its box.
double lux_on(const Subject& subject, const std::vector<render::Light>& lights) {
  double sum = 0;
  constexpr std::size_t kMost = 4096;
  for (std::uint32_t corner = 0; corner < 9; ++corner) {
    Vec3d point = subject.middle();
    if (corner < 8) {
      point = {(corner & 1U) != 0 ? subject.least.x : subject.greatest.x,
               (corner & 2U) != 0 ? subject.least.y : subject.greatest.y,
               (corner & 4U) != 0 ? subject.least.z : subject.greatest.z};
    }
    for (std::size_t i = 0; i < std::min(lights.size(), kMost); ++i) {
      // A light at a corner does not represent the others.
      sum += std::min(luminance(render::illuminate(lights[i], point).irradiance), 1e6 * kFull);
    }
  }
  return sum / 9;
}

void scale(Float3& color, double factor) {
  for (float& part : color) part = static_cast<float>(static_cast<double>(part) * factor);
}

std::vector<render::Light> brought_to_studio(const render::Scene& scene, const Subject& subject,
                                             Lamps lamps) {
  if (lamps == Lamps::studio) return {};
  std::vector<render::Light> lights = scene.lights;
  const double lux = lux_on(subject, lights);
  if (!(lux > 0) || !std::isfinite(lux)) return lights;
  const double factor = lamps == Lamps::asset ? kFull / lux : std::min(1.0, kFull / lux);
  for (render::Light& light : lights) scale(light.intensity, factor);
  return lights;
}

// Turned around y as azimuths count, with linear interpolation between columns.
render::EnvironmentImage rotated(const render::EnvironmentImage& image, double degrees) {
  const double turns = degrees / 360 - std::floor(degrees / 360);
  const double columns = turns * image.width;
  const auto whole = static_cast<std::uint32_t>(columns);
  const auto part = static_cast<float>(columns - whole);
  render::EnvironmentImage result = image;
  for (std::uint32_t y = 0; y < image.height; ++y) {
    const Float3* row = &image.radiance[std::size_t{y} * image.width];
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const Float3& left = row[(std::uint64_t{x} + whole) % image.width];
      const Float3& right = row[(std::uint64_t{x} + whole + 1) % image.width];
      Float3& texel = result.radiance[std::size_t{y} * image.width + x];
      for (std::size_t c = 0; c < 3; ++c) texel[c] = left[c] * (1 - part) + right[c] * part;
    }
  }
  return result;
}

bool is_emissive(const render::Scene& scene) {
  if (!scene.lights.empty()) return true;
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const auto& material) {
    return max_value(material.factors.emissive) > 0 || material.factors.unlit;
  });
}

}  // namespace

Rgb irradiance(const render::EnvironmentImage& image, const Vec3d& normal) {
  Rgb sum;
  const double texel =
      2 * std::numbers::pi * std::numbers::pi / (double{1} * image.width * image.height);
  for (std::uint32_t y = 0; y < image.height; ++y) {
    const float v = (static_cast<float>(y) + 0.5F) / static_cast<float>(image.height);
    const double solid = texel * std::sin(static_cast<double>(v) * std::numbers::pi);
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(image.width);
      const double cosine = dot(render::direction_of({u, v}), normal);
      if (cosine <= 0) continue;
      sum += to_vec(image.radiance[std::size_t{y} * image.width + x]) * (cosine * solid);
    }
  }
  return sum;
}

bool is_plain(const render::Scene& scene) {
  return std::all_of(scene.meshes.begin(), scene.meshes.end(), [&](const render::Mesh& mesh) {
    const render::SceneMaterial& material = render::material_of(scene, mesh);
    const Material& m = material.factors;
    const bool textured =
        std::any_of(material.textures.begin(), material.textures.end(),
                    [](const render::TextureUse& use) { return use.texture != render::kNone; });
    return mesh.colors.empty() && !mesh.unlit && !textured && m.base_color == Rgb(1) &&
           m.metallic == 1 && m.roughness == 1 && m.emissive == Rgb() && !m.unlit &&
           m.transmission == 0 && m.diffuse_transmission == 0 && m.clearcoat == 0 &&
           m.sheen_color == Rgb() && !material.specular_glossiness;
  });
}

render::EnvironmentImage studio_environment(const Vec3d& backward, bool modelling) {
  render::EnvironmentImage image;
  image.width = kStudioWidth;
  image.height = kStudioHeight;
  const double own = std::atan2(backward.x, backward.z) / kDegree;
  for (std::uint32_t y = 0; y < kStudioHeight; ++y) {
    for (std::uint32_t x = 0; x < kStudioWidth; ++x) {
      const Vec3d d = render::direction_of({(static_cast<float>(x) + 0.5F) / kStudioWidth,
                                            (static_cast<float>(y) + 0.5F) / kStudioHeight});
      const double elevation = std::asin(std::clamp(d.y, -1.0, 1.0)) / kDegree;
      const double azimuth = std::remainder(std::atan2(d.x, d.z) / kDegree - own, 360.0);
      Rgb radiance = ambient(elevation);
      for (const SoftBox& box : kBoxes) {
        radiance += box.radiance * within(box, azimuth, elevation);
      }
      if (modelling) radiance *= modelling_share(azimuth);
      image.radiance.push_back(to_float3(radiance));
    }
  }
  scale_to_white(image, backward, modelling ? kPlainWhite : kWhite);
  return image;
}

render::World make_world(const render::Scene& scene, const Subject& subject,
                         const render::View& view, const LightingOptions& options) {
  render::World world;
  const double exposure = std::exp2(options.exposure);
  const bool own = scene.environment != nullptr;
  const bool studio = !own && (options.lamps != Lamps::asset || !is_emissive(scene));
  world.background = options.background.value_or(own ? render::Background::environment
                                                     : render::Background::backdrop);
  if (own || studio) {
    render::EnvironmentImage image =
        own ? *scene.environment : studio_environment(view.backward, is_plain(scene));
    for (Float3& texel : image.radiance) scale(texel, exposure);
    if (options.rotation != 0) image = rotated(image, options.rotation);
    if (world.background == render::Background::backdrop) {
      world.shadow_catcher = {subject.least.y, luminance(irradiance(image, {0, 1, 0}))};
    }
    world.environment.emplace(image);
  }
  world.emitters = render::Emitters(scene, studio && !options.enclosed ? kDim * exposure : 0);
  world.lights = brought_to_studio(scene, subject, options.lamps);
  for (render::Light& light : world.lights) scale(light.intensity, exposure);
  if (view.inside) world.sky_occlusion = shadow_reach(subject);
  if (options.dim_backdrop) world.backdrop = kDimBackdrop;
  return world;
}

std::optional<render::Eye> eye_of(const render::View& view, const render::Bvh& bvh) {
  constexpr int kProbes = 256;
  constexpr int kWaysOut = kProbes / 16;
  int ways_out = 0;
  for (int i = 0; i < kProbes && ways_out <= kWaysOut; ++i) {
    const render::Ray look{view.origin, shader::even_direction(i, kProbes)};
    ways_out += bvh.intersect(look, 0) ? 0 : 1;
  }
  return ways_out > kWaysOut ? std::optional(render::Eye(view)) : std::nullopt;
}

}  // namespace gltfx::preview

// SPDX-License-Identifier: Apache-2.0
#include "render/direct_light.hpp"

#include <array>
#include <cmath>

#include "base/packed.hpp"
#include "render/light.hpp"

namespace gltfx::render {

bool DirectLight::is_consistent(const Vec3d& direction, const Vec3d& l) const {
  return (dot(direction, surface_.flat_normal) > 0) == (l.z > 0);
}

bool DirectLight::is_inwards(const Vec3d& l) const {
  return l.z < 0 && surface_.material.volumetric();
}

Vec3d DirectLight::start(const Vec3d& l) const {
  return start_at(surface_, l.z > 0, context_.scene_size);
}

Rgb DirectLight::transmittance(const Vec3d& l, double distance) const {
  if (is_inwards(l)) return shader::medium_of(surface_.material).transmittance(distance);
  return around_ != nullptr ? around_->transmittance(distance) : Rgb(1);
}

Candidate DirectLight::candidate(const Ray& shadow_ray, const Vec3d& l, const Rgb& light,
                                 double pdf) const {
  const shader::Evaluation bsdf = bsdf_.evaluate(l);
  const double scale = pdf > 0 ? power_heuristic(pdf, bsdf.pdf) / pdf : 1.0;
  const Rgb contribution =
      bsdf.f * light * transmittance(l, shadow_ray.far) * (std::fabs(l.z) * scale);
  return {shadow_ray, bsdf, contribution, luminance(contribution)};
}

Candidate DirectLight::candidate(const EnvironmentSample& light, const SkyPdf& pdf) const {
  if (!(light.pdf > 0)) return {};
  const Vec3d l = surface_.frame.to_local(light.direction);
  if (!is_consistent(light.direction, l) || is_inwards(l)) return {};
  const shader::Evaluation bsdf = bsdf_.evaluate(l);
  const double light_pdf = pdf ? pdf(light.direction, light.radiance) : light.pdf;
  const double weight = power_heuristic(light_pdf, bsdf.pdf);
  const double scale = std::fabs(l.z) * weight * light.scale;
  const Ray shadow_ray{start(l), light.direction, context_.world.sky_occlusion};
  const Rgb contribution = bsdf.f * light.radiance * transmittance(l, Ray().far) * scale;
  return {shadow_ray, bsdf, contribution, luminance(contribution)};
}

// First all directions, then all values: independent operations run in parallel in a processor.
void DirectLight::sample_environment(std::span<const Float2> random, const SkyPdf& pdf,
                                     std::span<Candidate> candidates) const {
  std::array<EnvironmentSample, Bvh::kShadowPacket> lights;
  for (std::size_t i = 0; i < random.size(); ++i) {
    lights[i] = context_.world.sample_sky(pdf.receiver, random[i]);
  }
  for (std::size_t i = 0; i < random.size(); ++i) candidates[i] = candidate(lights[i], pdf);
}

Candidate DirectLight::sample_emitter(const Float2& random) const {
  const EmissiveTriangle light =
      context_.world.emitters.sample(context_.scene, surface_.position, random);
  if (!(max_value(light.radiance) > 0)) return {};
  const Vec3d l = surface_.frame.to_local(light.direction);
  if (!is_consistent(light.direction, l) || is_inwards(l)) return {};
  const Vec3d from = start(l);
  const Vec3d way = beside(light.position, light.normal, context_.scene_size) - from;
  const double distance = length(way);
  if (!(distance > 0)) return {};
  return candidate({from, way / distance, distance}, l, light.radiance, light.pdf);
}

Candidate DirectLight::sample_punctual(const Float2& random) const {
  const LightChoice choice = choose_light(context_.world.lights, surface_.position, random);
  if (!(choice.probability > 0)) return {};
  const Vec3d l = surface_.frame.to_local(choice.light.direction);
  if (!is_consistent(choice.light.direction, l)) return {};
  return candidate({start(l), choice.light.direction, choice.light.distance}, l,
                   choice.light.irradiance / Rgb(choice.probability), 0);
}

Candidate sample_punctual(const TraceContext& context, const shader::Medium& medium, const Ray& ray,
                          const Float2& random) {
  if (context.world.lights.empty()) return {};
  const LightChoice choice = choose_light(context.world.lights, ray.origin, random);
  if (!(choice.probability > 0)) return {};
  const Ray shadow_ray{ray.origin, choice.light.direction, choice.light.distance};
  const double phase =
      shader::henyey_greenstein(medium.anisotropy, -dot(ray.direction, shadow_ray.direction));
  const Rgb contribution =
      choice.light.irradiance * medium.transmittance(shadow_ray.far) * (phase / choice.probability);
  return {shadow_ray, {}, contribution, luminance(contribution)};
}

}  // namespace gltfx::render

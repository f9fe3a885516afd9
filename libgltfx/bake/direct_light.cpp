// SPDX-License-Identifier: Apache-2.0
#include "bake/direct_light.hpp"

#include <cmath>

#include "bake/light.hpp"
#include "bake/storage.hpp"

namespace gltfx::bake {

bool DirectLight::is_consistent(const Vec3d& direction, const Vec3d& l) const {
  return (dot(direction, surface_.flat_normal) > 0) == (l.z > 0);
}

bool DirectLight::leads_in(const Vec3d& l) const {
  return l.z < 0 && surface_.material.volumetric();
}

Vec3d DirectLight::start(const Vec3d& l) const {
  return start_at(surface_, l.z > 0, context_.scene_size);
}

Rgb DirectLight::dimming(const Vec3d& l, double far) const {
  if (leads_in(l)) return medium_of(surface_.material).transmittance(far);
  return around_ != nullptr ? around_->transmittance(far) : Rgb(1);
}

Candidate DirectLight::candidate(const Ray& towards, const Vec3d& l, const Rgb& light,
                                 double pdf) const {
  const Evaluation value = bsdf_.evaluate(l);
  const double scale = pdf > 0 ? power_weight(pdf, value.pdf) / pdf : 1.0;
  const Rgb share = value.f * light * dimming(l, towards.far) * (std::fabs(l.z) * scale);
  return {towards, value, {}, share, luminance(share)};
}

Candidate DirectLight::from_environment(const Float2& random) const {
  const EnvironmentSample light = context_.world.environment->sample(random);
  if (!(light.pdf > 0)) return {};
  const Vec3d l = surface_.frame.to_local(light.direction);
  if (!is_consistent(light.direction, l) || leads_in(l)) return {};
  const Evaluation value = bsdf_.evaluate(l);
  const double scale = std::fabs(l.z) * power_weight(light.pdf, value.pdf);
  const Ray towards{start(l), light.direction};
  const Rgb share = value.f * dimming(l, towards.far) * scale;
  return {towards, value, light.point, share / light.pdf, luminance(share)};
}

void DirectLight::finish_environment(Candidate& chosen) const {
  chosen.share *= context_.world.environment->radiance_at(chosen.point);
}

Candidate DirectLight::from_emitter(const Float2& random) const {
  const EmissiveTriangle light =
      context_.world.emitters.sample(context_.scene, surface_.position, random);
  if (!(max_value(light.radiance) > 0)) return {};
  const Vec3d l = surface_.frame.to_local(light.direction);
  if (!is_consistent(light.direction, l) || leads_in(l)) return {};
  const Vec3d from = start(l);
  const Vec3d way = beside(light.position, light.normal, context_.scene_size) - from;
  const double distance = length(way);
  if (!(distance > 0)) return {};
  return candidate({from, way / distance, distance}, l, light.radiance, light.pdf);
}

Candidate DirectLight::from_lamp(const Float2& random) const {
  const LightChoice lamp = choose_light(context_.world.lights, surface_.position, random);
  if (!(lamp.probability > 0)) return {};
  const Vec3d l = surface_.frame.to_local(lamp.light.direction);
  if (!is_consistent(lamp.light.direction, l)) return {};
  return candidate({start(l), lamp.light.direction, lamp.light.distance}, l,
                   lamp.light.irradiance / Rgb(lamp.probability), 0);
}

Candidate lamp_inside(const TraceContext& context, const Medium& medium, const Ray& ray,
                      const Float2& random) {
  if (context.world.lights.empty()) return {};
  const LightChoice lamp = choose_light(context.world.lights, ray.origin, random);
  if (!(lamp.probability > 0)) return {};
  const Ray towards{ray.origin, lamp.light.direction, lamp.light.distance};
  const double phase = henyey_greenstein(medium.anisotropy, -dot(ray.direction, towards.direction));
  const Rgb share =
      lamp.light.irradiance * medium.transmittance(towards.far) * (phase / lamp.probability);
  return {towards, {}, {}, share, luminance(share)};
}

}  // namespace gltfx::bake

// SPDX-License-Identifier: Apache-2.0
#include "simple_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/packed.hpp"
#include "render/light.hpp"
#include "render/light_through.hpp"
#include "render/surface.hpp"
#include "shader/medium.hpp"
#include "shader/microfacet.hpp"

namespace gltfx::render {
namespace {

constexpr double kSphere = 4 * std::numbers::pi;
constexpr std::uint32_t kSteps = 1024;  // of a path, in media and on surfaces

// Evenly over all directions.
Vec3d any_direction(const Float2& random) {
  const double z = 1 - 2 * static_cast<double>(random[0]);
  const double ring = std::sqrt(std::fmax(0.0, 1 - z * z));
  const double turn = 2 * std::numbers::pi * static_cast<double>(random[1]);
  return {ring * std::cos(turn), ring * std::sin(turn), z};
}

// Whether light continues in few directions only: mirrors, refraction, clear walls.
bool is_narrow(const Material& m) {
  const auto smooth = [](double roughness) {
    return shader::square(roughness) <= shader::kSmoothAlpha;
  };
  return m.transmission > 0 || smooth(m.roughness) ||
         (m.clearcoat > 0 && smooth(m.clearcoat_roughness));
}

bool is_consistent(const Surface& surface, const Vec3d& direction, const Vec3d& l) {
  return (dot(direction, surface.flat_normal) > 0) == (l.z > 0);
}

class SimplePath {
 public:
  SimplePath(const TraceContext& context, const Ray& ray, const SampleStream& random)
      : context_(context), ray_(ray), random_(random) {}

  Rgb run() {
    for (; step_ < kSteps; ++step_) {
      const auto hit = context_.bvh.intersect(ray_, key(), viewing_ ? Backs::culled : Backs::solid);
      if (!media_.empty()) {
        const double far = hit ? hit->distance : std::numeric_limits<double>::infinity();
        const double distance = free_flight();
        if (distance < far) {
          if (!turn(distance)) return result_;
          continue;
        }
      }
      if (!hit) {
        add_far_light(Rgb(1));
        return result_;
      }
      if (!meet(*hit)) return result_;
    }
    return result_;
  }

 private:
  enum Draw : std::uint32_t { lobe, direction, reach, turning, kDraws };
  std::uint32_t key() const { return random_.key() + step_ + 1; }
  Float2 pair(Draw draw) const { return random_.pair(step_ * kDraws + draw); }

  // Media and dispersion are of one colour at a time.
  void follow_one_color() {
    if (color_ >= 0) return;
    color_ = std::min(static_cast<int>(random_.single(kSteps * kDraws) * 3), 2);
    throughput_ *= Rgb(color_ == 0 ? 3 : 0, color_ == 1 ? 3 : 0, color_ == 2 ? 3 : 0);
  }

  double free_flight() const {
    const double extinction = media_.top().extinction()[color_];
    if (extinction <= 0) return std::numeric_limits<double>::infinity();
    return -std::log1p(-static_cast<double>(pair(Draw::reach)[0])) / extinction;
  }

  // In a medium, if nothing absorbs it.
  bool turn(double distance) {
    const shader::Medium& medium = media_.top();
    const double albedo = medium.scattering[color_] / medium.extinction()[color_];
    if (static_cast<double>(pair(Draw::reach)[1]) >= albedo) return false;
    ray_.origin += ray_.direction * distance;
    for (const Light& each : context_.world.lights) {
      const Illumination lamp = illuminate(each, ray_.origin);
      const double phase =
          shader::henyey_greenstein(medium.anisotropy, dot(-ray_.direction, lamp.direction));
      result_ += throughput_ * phase *
                 from_lamp(lamp, {ray_.origin, lamp.direction, lamp.distance}, &medium);
    }
    const Vec3d onwards = any_direction(pair(Draw::turning));
    throughput_ *=
        shader::henyey_greenstein(medium.anisotropy, dot(-ray_.direction, onwards)) * kSphere;
    ray_ = {ray_.origin, onwards};
    viewing_ = false;
    return true;
  }

  void add_far_light(const Rgb& through) {
    if (!context_.world.environment || lit_through_) return;
    result_ += throughput_ * through * context_.world.environment->radiance(ray_.direction);
  }

  // A medium continues behind the wall.
  void look_through(const Hit& hit, const Surface& wall) {
    if (viewing_) return;
    const auto transmittance = [this](double distance) {
      return media_.empty() ? Rgb(1) : media_.top().transmittance(distance);
    };
    const auto add_emitter = [&](const Hit& behind, const Surface& surface) {
      const Vec3d v = surface.frame.to_local(-ray_.direction);
      result_ += throughput_ * transmittance(behind.distance - hit.distance) *
                 emitted(surface.material, v);
    };
    const bool open = light_through(context_, ray_, hit, wall, key(), add_emitter);
    if (!open || !context_.world.environment) return;
    add_far_light(transmittance(std::numeric_limits<double>::infinity()));
    lit_through_ = true;
  }

  bool meet(const Hit& hit) {
    Surface surface = surface_at(context_.scene, hit, ray_);
    if (context_.mode == ShaderMode::conserving) raise_reflections(surface, -ray_.direction);
    const Vec3d v = surface.frame.to_local(-ray_.direction);
    look_through(hit, surface);
    const bool outshone = lit_through_ && surface.material.unlit;
    if (!outshone && !is_unseen_back(context_.scene, hit, surface)) {
      result_ += throughput_ * emitted(surface.material, v);
    }
    if (surfaces_ == context_.max_depth || surface.material.unlit) return false;
    ++surfaces_;
    surface.material.outside_ior = media_.ior_around(hit.body());
    if (surface.material.volumetric()) follow_one_color();
    result_ += throughput_ * from_lamps(hit, surface, v);
    const auto next = onwards(surface, v);
    return next && go_on(hit, surface, v, *next);
  }

  Vec3d start(const Surface& surface, bool outside) const {
    return beside(surface.position, outside ? surface.flat_normal : -surface.flat_normal,
                  context_.scene_size);
  }

  Rgb from_lamp(const Illumination& lamp, const Ray& towards, const shader::Medium* medium) const {
    if (max_value(lamp.irradiance) <= 0) return {};
    const Rgb through = medium != nullptr ? medium->transmittance(lamp.distance) : Rgb(1);
    return through * lamp.irradiance * context_.bvh.transmittance(towards, context_.world.eye);
  }

  Rgb from_lamps(const Hit& hit, const Surface& surface, const Vec3d& v) const {
    const shader::Medium behind = shader::medium_of(surface.material);
    Rgb sum;
    for (const Light& each : context_.world.lights) {
      const Illumination lamp = illuminate(each, surface.position);
      const Vec3d l = surface.frame.to_local(lamp.direction);
      if (!is_consistent(surface, lamp.direction, l)) continue;
      const shader::Medium* medium =
          l.z < 0 && surface.material.volumetric() ? &behind : media_.around(hit.body());
      sum += evaluate(surface.material, v, l, {context_.mode, color_}) * std::fabs(l.z) *
             from_lamp(lamp, {start(surface, l.z > 0), lamp.direction, lamp.distance}, medium);
    }
    return sum;
  }

  // A local direction: any, where that has a chance.
  std::optional<Vec3d> onwards(const Surface& surface, const Vec3d& v) {
    const Material& material = surface.material;
    const ShaderOptions options{context_.mode, color_};
    const Float2 point = pair(Draw::direction);
    if (is_narrow(material)) {
      const Random3 random{static_cast<double>(pair(Draw::lobe)[0]), static_cast<double>(point[0]),
                           static_cast<double>(point[1])};
      const auto next = sample(material, v, random, options);
      if (!next) return std::nullopt;
      throughput_ *= next->weight;
      viewing_ = viewing_ && next->delta;
      return next->l;
    }
    viewing_ = false;
    const Vec3d l = surface.frame.to_local(any_direction(point));
    throughput_ *= evaluate(material, v, l, options) * (std::fabs(l.z) * kSphere);
    return l;
  }

  bool go_on(const Hit& hit, const Surface& surface, const Vec3d& v, const Vec3d& l) {
    const Vec3d towards = surface.frame.to_world(l);
    if (!(max_value(throughput_) > 0) || !is_consistent(surface, towards, l)) return false;
    if (surface.material.volumetric() && (l.z > 0) != (v.z > 0)) {
      if (l.z > 0) {
        media_.leave(hit.body());
      } else {
        media_.enter(surface.material, hit.body());
      }
    }
    ray_ = {start(surface, l.z > 0), normalize(towards)};
    return true;
  }

  const TraceContext& context_;
  Ray ray_;
  const SampleStream& random_;
  Rgb result_, throughput_{1, 1, 1};
  shader::MediaStack media_;
  std::uint32_t step_ = 0;
  int surfaces_ = 0;          // that scattered
  int color_ = -1;            // that the path follows
  bool viewing_ = true;       // nothing but mirrors and clear glass so far
  bool lit_through_ = false;  // by the environment, through a wall
};

}  // namespace

Rgb trace_simply(const TraceContext& context, const Ray& ray, const SampleStream& random) {
  return SimplePath(context, ray, random).run();
}

}  // namespace gltfx::render

// SPDX-License-Identifier: Apache-2.0
/// incident_radiance(), preceded by its steps as free functions: they change the PathState, and add
/// light to a PathSample, called L, which transport never reads.
#include "render/radiance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/packed.hpp"
#include "render/background.hpp"
#include "render/direct_light.hpp"
#include "render/light_through.hpp"
#include "render/next_event.hpp"
#include "render/surface.hpp"
#include "shader/material.hpp"

namespace gltfx::render {
namespace {

constexpr std::uint32_t kRouletteFrom = 3;  // step
constexpr double kSharp = 0.5;              // roughness below which gloss shows a picture

// The hit of a path on a surface.
struct SurfaceVertex {
  const Hit& hit;
  Surface surface;
  Vec3d v;  // to the start of the ray, in the frame of the surface
};

// The weight of light that the BSDF or phase function found, beside light sampling.
double mis_weight(const TraceContext& context, const PathState& path, const Hit& hit,
                  const Surface& surface) {
  if (!(path.pdf > 0) || context.world.emitters.empty()) return 1;
  const double cosine = std::fabs(dot(surface.flat_normal, path.ray.direction));
  return power_heuristic(path.pdf, context.world.emitters.pdf(hit, cosine));
}

void add_environment(const World& world, const PathState& path, const Rgb& transmittance,
                     PathSample& L) {
  const EnvironmentValue seen = world.evaluate_sky(path.ray.direction, path.sky_pdf);
  const double weight = path.pdf > 0 ? power_heuristic(path.pdf, seen.pdf) : 1.0;
  L.add_light(path.throughput * transmittance * seen.radiance * weight, path.reflected_share);
}

// Beyond the scene: straight on the backdrop, else the environment as a light.
void add_infinite_light(const TraceContext& context, const PathState& path, const Float2& point,
                        FeatureRecorder& features, PathSample& L) {
  if (path.prefix.straight) {
    L.alpha = 1 - luminance(path.throughput);
    L.background = path.throughput * background(context, path.ray.direction, point);
    L.shadow = catcher_shadow(context, path.ray, path.sampler.pair(Dimension::environment), L.rays);
  } else if (sees_environment(context, path)) {
    features.record(path, Rgb(1), -path.ray.direction, 0);
    add_environment(context.world, path, Rgb(1), L);
  }
}

// A wall that lets light in is a window for the emitters and the environment behind it; one that is
// too far away to occlude the environment, for the environment only. A medium continues behind it.
void add_light_through_wall(const TraceContext& context, const SurfaceVertex& wall, PathState& path,
                            PathSample& L) {
  if (path.prefix.specular) return;
  const auto transmittance = [&](double distance) {
    return path.media.empty() ? Rgb(1) : path.media.top().transmittance(distance);
  };
  const auto add_emitter = [&](const Hit& hit, const Surface& surface) {
    const Rgb light = emitted(surface.material, surface.frame.to_local(-path.ray.direction));
    const double weight = mis_weight(context, path, hit, surface);
    const Rgb through = transmittance(hit.distance - wall.hit.distance) * weight;
    L.add_light(path.throughput * light * through, path.reflected_share);
  };
  const bool beyond = wall.hit.distance > context.world.sky_occlusion;
  const auto key = path.sampler.key();
  if (!light_through(context, path.ray, wall.hit, wall.surface, key, add_emitter) && !beyond)
    return;
  if (!sees_environment(context, path)) return;
  add_environment(context.world, path, transmittance(Ray().far), L);
  path.prefix.environment_in = true;
}

void add_emission(const TraceContext& context, const PathState& path, const SurfaceVertex& vertex,
                  PathSample& L) {
  const Material& material = vertex.surface.material;
  const bool outshone = path.prefix.environment_in && material.unlit;
  if (outshone || is_unseen_back(context.scene, vertex.hit, vertex.surface)) return;
  const Rgb light = path.throughput * emitted(material, vertex.v) *
                    mis_weight(context, path, vertex.hit, vertex.surface);
  if (path.prefix.straight) {
    L.emitted += light;
  } else {
    L.add_light(light, path.reflected_share);
  }
}

// Whether the path ends here, with the light of the sky instead of that of paths.
bool end_with_sky(const TraceContext& context, const PathState& path, const SurfaceVertex& vertex,
                  PathSample& L) {
  const Material& m = vertex.surface.material;
  if (!context.effort.sky_ends_paths || path.depth == 0 || is_transmissive(m)) return false;
  if (!context.world.sky || !sees_environment(context, path)) return false;
  // The nearer a surface, the less of the sky both see.
  const double near = 0.05 * context.scene_size;
  const double open = vertex.hit.distance / (vertex.hit.distance + near);
  const Rgb light =
      context.world.sky->irradiance(vertex.surface.frame.normal) * (open * shader::inv_pi);
  L.add_light(path.throughput * m.base_color * light, path.reflected_share);
  return true;
}

// The least roughness of all gloss.
double sharpest(const Material& m) {
  return m.clearcoat > 0 ? std::min(m.roughness, m.clearcoat_roughness) : m.roughness;
}

// A dispersive volume refracts each colour differently: from there on a path carries one of them.
void choose_channel(const Material& material, PathState& path) {
  if (path.channel >= 0 || material.dispersion <= 0 || material.transmission <= 0) return;
  if (!material.volumetric()) return;
  path.channel = std::min(static_cast<int>(path.sampler.single(Dimension::color) * 3), 2);
  Rgb carried;
  (path.channel == 0 ? carried.x : path.channel == 1 ? carried.y : carried.z) = 3;
  path.throughput *= carried;
}

// The next surface, or nothing if the medium scatters before it. The ray ends at the scattering
// point, so that few triangles are tested in dense media.
std::optional<Hit> find_surface(const TraceContext& context, PathState& path, PathSample& L) {
  path.ray.far = path.media.empty()
                     ? std::numeric_limits<double>::infinity()
                     : shader::sample_distance(path.media.top(), path.throughput,
                                               path.sampler.pair(Dimension::free_flight));
  const Backs backs = path.prefix.specular ? Backs::culled : Backs::solid;
  ++L.rays;
  return context.bvh.intersect(path.ray, path.sampler.key(), backs);
}

// Whether any lamp shines into a medium: light from infinity is absorbed.
bool lamps_reach(const std::vector<Light>& lights, const shader::Medium& medium) {
  const Rgb extinction = medium.extinction();
  const bool clear = std::min({extinction.x, extinction.y, extinction.z}) <= 0;
  return std::any_of(lights.begin(), lights.end(), [clear](const Light& light) {
    return clear || light.kind != Light::Kind::directional;
  });
}

// Scatters the path where its ray ends; false if a surface comes first, to which the medium only
// absorbs.
bool sample_medium(const TraceContext& context, const std::optional<Hit>& hit, PathState& path,
                   FeatureRecorder& features, PathSample& L) {
  const double distance = hit ? hit->distance : path.ray.far;
  const bool scattered = !hit && std::isfinite(distance);
  path.throughput *=
      shader::distance_weight(path.media.top(), path.throughput, distance, scattered);
  if (!scattered) return false;
  features.record(path, Rgb(1), -path.ray.direction, distance);
  path.ray.origin += path.ray.direction * distance;
  if (lamps_reach(context.world.lights, path.media.top())) {
    add_direct_light(context, path, L);
  }
  const Float2 u = path.sampler.pair(Dimension::phase);
  path.ray.direction = shader::sample_phase(path.media.top(), path.ray.direction,
                                            static_cast<double>(u[0]), static_cast<double>(u[1]));
  path.prefix.specular = path.prefix.straight = false;
  path.pdf = 0;
  return true;
}

Random3 bsdf_random(const PathSampler& sampler) {
  const Float2 u = sampler.pair(Dimension::direction);
  return {sampler.single(Dimension::lobe), static_cast<double>(u[0]), static_cast<double>(u[1])};
}

// The next direction. False if the path ends.
bool sample_bsdf(const TraceContext& context, const SurfaceVertex& vertex, const shader::Bsdf& bsdf,
                 const Random3& random, PathState& path, FeatureRecorder& features) {
  constexpr double kNarrow = 2;  // per steradian: transmitted light shows a picture
  const auto& [hit, surface, v] = vertex;
  const auto next = bsdf.sample(random);
  const bool transmitted = next && (next->l.z > 0) != (v.z > 0);
  if (!transmitted || !(next->delta || next->pdf > kNarrow)) features.record(path, hit, surface);
  if (!next) return false;
  const Vec3d direction = normalize(surface.frame.to_world(next->l));
  const bool outside = dot(direction, surface.flat_normal) > 0;
  if (outside != (next->l.z > 0)) return false;  // by the shading normal only

  path.throughput *= next->weight;
  if (path.depth == 1) {
    path.reflected_share = transmitted   ? Rgb(0)
                           : next->delta ? Rgb(1)
                                         : share_of(next->reflected, next->weight);
  }
  if (transmitted && surface.material.volumetric()) {
    if (outside) {
      path.media.leave(hit.body());
    } else {
      path.media.enter(surface.material, hit.body());
    }
  }
  path.prefix.specular = path.prefix.specular && next->delta;
  path.prefix.straight = path.prefix.straight && transmitted && next->delta &&
                         dot(direction, path.ray.direction) > 0.99999;
  const bool inwards = next->l.z < 0 && surface.material.volumetric();
  path.pdf = next->delta || inwards ? 0 : next->pdf;
  path.ray = {start_at(surface, outside, context.scene_size), direction};
  features.go_on(path, hit.distance);
  return true;
}

// Ends paths of low throughput with a probability by which the throughput of the others is divided.
bool russian_roulette(PathState& path) {
  const double most = max_value(path.throughput) / path.weight;
  if (!(most > 0)) return false;
  if (path.sampler.step() < kRouletteFrom || most >= 1) return true;
  if (path.sampler.single(Dimension::roulette) >= most) return false;
  path.throughput *= 1 / most;
  return true;
}

// How a path splits at the first surface (J. Arvo and D. Kirk, Particle Transport and Image
// Synthesis, 1990). Mirrors and gloss get a separate branch: reflections are sharp, but would get
// few paths by their albedo. Transmitted light varies most, and gets several branches.
struct Splitting {
  double reflecting;  // probability
  bool apart;         // mirrors and gloss
  std::uint32_t others;

  Splitting(const Material& m, const shader::Bsdf& bsdf, const Effort& effort)
      : reflecting(bsdf.reflection_chance()),
        apart(reflecting > 0 && reflecting < 1 && sharpest(m) < kSharp),
        others(is_transmissive(m) && reflecting < 1 ? effort.transmitted_paths : 1) {}
  std::uint32_t branches() const { return others + (apart ? 1 : 0); }
};

void add_branches(const TraceContext& context, const PathState& path,
                  const FeatureRecorder& features, const SurfaceVertex& vertex,
                  const shader::Bsdf& bsdf, const Splitting& splitting, const Float2& point,
                  PathSample& L) {
  const auto& [reflecting, apart, others] = splitting;
  const std::uint32_t count = splitting.branches();
  L.alpha = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool mirrors = i == others;
    Random3 random = bsdf_random(mirrors ? path.sampler : path.sampler.split(i, others));
    const double from = apart && !mirrors ? reflecting : 0;  // of the number that chooses a lobe
    const double to = apart && mirrors ? reflecting : 1;
    random.lobe = from + random.lobe * (to - from);
    PathState branch = path;
    branch.sampler = path.sampler.split(i, count);
    branch.weight = (to - from) * count / (mirrors ? 1 : others);
    branch.throughput *= branch.weight;
    FeatureRecorder recorder = features.split(!mirrors);
    if (sample_bsdf(context, vertex, bsdf, random, branch, recorder) && russian_roulette(branch)) {
      branch.sampler.next_step();
      L.add(incident_radiance(context, branch, recorder, std::nullopt, point), 1.0 / count);
    } else {
      L.alpha += 1.0 / count;
      L.features.add(recorder.features(), 1.0 / count);
    }
  }
}

}  // namespace

PathSample incident_radiance(const TraceContext& context, PathState& path,
                             FeatureRecorder& features, std::optional<Hit> hit,
                             const Float2& point) {
  PathSample L;
  L.alpha = 1;
  for (; path.sampler.step() < kMaxSteps; path.sampler.next_step()) {
    // Intersect the ray with the scene. The camera does not see the backs of walls.
    if (path.sampler.step() > 0) hit = find_surface(context, path, L);

    // In a medium, the path may scatter before it reaches the surface.
    if (!path.media.empty() && sample_medium(context, hit, path, features, L)) {
      if (!russian_roulette(path)) break;
      continue;
    }

    // Beyond the scene, add the background or the environment.
    if (!hit) {
      add_infinite_light(context, path, point, features, L);
      break;
    }

    // Evaluate the surface, and add the light that it and lights behind it send.
    SurfaceVertex vertex{*hit, surface_at(context.scene, *hit, path.ray), {}};
    Surface& surface = vertex.surface;
    if (context.mode == ShaderMode::conserving) raise_reflections(surface, -path.ray.direction);
    vertex.v = surface.frame.to_local(-path.ray.direction);
    if (path.depth == 0) features.record_first(context.scene, *hit, surface);
    add_light_through_wall(context, vertex, path, L);
    add_emission(context, path, vertex, L);

    // End the path if nothing is reflected, or at its maximum depth.
    if (surface.material.unlit || path.depth >= context.max_depth ||
        surface.flat_normal == Vec3d() || end_with_sky(context, path, vertex, L)) {
      features.record(path, *hit, surface);
      break;
    }
    ++path.depth;

    // Evaluate the material for the outgoing direction.
    surface.material.outside_ior = path.media.ior_around(hit->body());
    choose_channel(surface.material, path);
    const shader::Bsdf bsdf(surface.material, vertex.v, {context.mode, path.channel});
    if (!may_be_clear(surface.material)) features.record(path, *hit, surface);

    // Add direct light.
    if (!bsdf.is_delta()) add_direct_light(context, path, *hit, surface, bsdf, L);

    // Sample the BSDF for the next ray; at the first surface, for the rays of several branches.
    if (path.depth == 1) {
      const Splitting splitting(surface.material, bsdf, context.effort);
      if (splitting.branches() > 1) {
        L.features = features.features();
        add_branches(context, path, features, vertex, bsdf, splitting, point, L);
        return L;
      }
    }
    const Random3 random = bsdf_random(path.sampler);
    if (!sample_bsdf(context, vertex, bsdf, random, path, features)) break;

    // End paths that carry little.
    if (!russian_roulette(path)) break;
  }
  L.features = features.features();
  return L;
}

}  // namespace gltfx::render

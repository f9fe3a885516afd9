// SPDX-License-Identifier: Apache-2.0
#include "render/next_event.hpp"

#include <array>
#include <span>

#include "render/direct_light.hpp"

namespace gltfx::render {
namespace {

// The part of direct light that the first surface of the path reflects.
Rgb reflected_share(const PathState& path, const shader::Evaluation& bsdf) {
  return path.depth == 1 ? share_of(bsdf.reflected, bsdf.f) : path.reflected_share;
}

// Traces the shadow rays of candidates whose light paths can hit, too; `scale`: of their
// contributions.
void add_unoccluded(const TraceContext& context, const PathState& path,
                    std::span<const Candidate> candidates, double scale, PathSample& L) {
  std::array<const Candidate*, Bvh::kShadowPacket> lit{};
  std::array<Ray, Bvh::kShadowPacket> rays;
  std::size_t count = 0;
  for (const Candidate& each : candidates) {
    if (!(max_value(each.contribution) > 0)) continue;
    lit[count] = &each;
    rays[count++] = each.shadow_ray;
  }
  if (count == 0) return;
  L.rays += static_cast<std::uint32_t>(count);
  std::array<float, Bvh::kShadowPacket> visible{};
  context.bvh.find_visibility(std::span(rays).first(count), context.world.eye, visible);
  for (std::size_t i = 0; i < count; ++i) {
    if (visible[i] <= 0) continue;
    L.add_light(path.throughput * lit[i]->contribution * (scale * static_cast<double>(visible[i])),
                reflected_share(path, lit[i]->bsdf));
  }
}

// Traces the shadow ray towards a point or a direction, which no path can hit; `share`: of the
// light that the first surface reflects.
void add_punctual(const TraceContext& context, const PathState& path, const Candidate& light,
                  const Rgb& share, PathSample& L) {
  if (!(max_value(light.contribution) > 0)) return;
  ++L.rays;
  const Rgb visible = context.bvh.transmittance(light.shadow_ray, context.world.eye);
  L.add_light(path.throughput * light.contribution * visible, share);
}

}  // namespace

void add_direct_light(const TraceContext& context, PathState& path, const Hit& hit,
                      const Surface& surface, const shader::Bsdf& bsdf, PathSample& L) {
  const DirectLight light(context, surface, bsdf, path.media.around(hit.body()));
  const bool first = path.depth == 1;
  const std::uint32_t candidates = first ? context.effort.light_candidates : 1;
  const std::uint32_t samples = first ? context.effort.light_samples : 1;
  path.sky_pdf = context.world.sky_pdf(receiver_of(surface), samples);
  static_assert(Bvh::kShadowPacket <= kLanes);
  std::array<Candidate, Bvh::kShadowPacket> chosen;
  for (std::uint32_t from = 0; from < samples; from += Bvh::kShadowPacket) {
    const std::uint32_t count = std::min(samples - from, Bvh::kShadowPacket);
    const auto sampler_of = [&](std::uint32_t i) { return path.sampler.split(from + i, samples); };
    if (sees_environment(context, path)) {
      const auto randoms = path.sampler.pairs(Dimension::environment, from, samples);
      light.sample_environment(std::span(randoms).first(count), path.sky_pdf, chosen);
      add_unoccluded(context, path, std::span(chosen).first(count), 1.0 / samples, L);
    }
    if (context.world.emitters.empty()) continue;
    for (std::uint32_t i = 0; i < count; ++i) {
      const PathSampler sampler = sampler_of(i);
      const double choice = candidates > 1 ? sampler.single(Dimension::emitter_choice) : 0;
      chosen[i] = resample(candidates, choice, [&](std::uint32_t k) {
        return light.sample_emitter(sampler.split(k, candidates).pair(Dimension::emitter));
      });
    }
    add_unoccluded(context, path, std::span(chosen).first(count), 1.0 / samples, L);
  }
  if (context.world.lights.empty()) return;
  const Candidate lamp = light.sample_punctual(path.sampler.pair(Dimension::punctual));
  add_punctual(context, path, lamp, reflected_share(path, lamp.bsdf), L);
}

void add_direct_light(const TraceContext& context, const PathState& path, PathSample& L) {
  const Candidate light =
      sample_punctual(context, path.media.top(), path.ray, path.sampler.pair(Dimension::punctual));
  add_punctual(context, path, light, path.reflected_share, L);
}

}  // namespace gltfx::render

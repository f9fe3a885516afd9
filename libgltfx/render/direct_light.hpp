// SPDX-License-Identifier: Apache-2.0
/// Sampling of lights: candidates for direct light, and the choice among them.
#pragma once

#include <span>

#include "render/integrator.hpp"
#include "render/surface.hpp"
#include "shader/material.hpp"
#include "shader/medium.hpp"

namespace gltfx::render {

/// The power heuristic of two strategies (E. Veach, Robust Monte Carlo Methods, 1997).
inline double power_heuristic(double own, double other) {
  const double a = own * own;
  const double b = other * other;
  return a > 0 ? a / (a + b) : 0.0;
}

/// Light that a surface or medium would send to the viewer if nothing occluded its source.
struct Candidate {
  Ray shadow_ray;
  shader::Evaluation bsdf;
  Rgb contribution;   ///< over the density, with the weight of multiple importance sampling
  double weight = 0;  ///< in the choice among candidates; 0: no light
};

/// The surface for light sampling, which ignores light from inside a volume.
inline Receiver receiver_of(const Surface& surface) {
  const Material& m = surface.material;
  // The share of light that the layers above the base let through, roughly.
  constexpr double kBase = 0.85;
  const double behind = m.transmission + (1 - m.transmission) * m.diffuse_transmission;
  return {surface.frame.normal, m.volumetric() ? 0 : kBase * (1 - m.metallic) * behind};
}

/// Chooses one of `count` candidates by their weights, as an estimate of all: resampled importance
/// sampling (J. Talbot et al., EGSR 2005). `random` is from [0, 1); propose(i) gives a candidate.
template <class Propose>
Candidate resample(std::uint32_t count, double random, const Propose& propose) {
  Candidate chosen;
  double total = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Candidate candidate = propose(i);
    if (!(candidate.weight > 0)) continue;
    total += candidate.weight;
    if (shader::choose(candidate.weight / total, random)) chosen = candidate;
  }
  if (total > 0) chosen.contribution *= total / (chosen.weight * count);
  return chosen;
}

/// Candidates for one surface, by uniform random numbers. The mean contribution is the light of
/// its kind, weighted against BSDF sampling.
class DirectLight {
 public:
  /// References must outlive it. `around`: the medium outside of the surface; null: none.
  DirectLight(const TraceContext& context, const Surface& surface, const shader::Bsdf& bsdf,
              const shader::Medium* around)
      : context_(context), surface_(surface), bsdf_(bsdf), around_(around) {}

  /// One candidate for each pair of numbers: together they take less time.
  void sample_environment(std::span<const Float2> random, const SkyPdf& pdf,
                          std::span<Candidate> candidates) const;
  Candidate sample_emitter(const Float2& random) const;
  Candidate sample_punctual(const Float2& random) const;

 private:
  /// Whether a direction is on the same side of the flat triangle as of the shading normal.
  bool is_consistent(const Vec3d& direction, const Vec3d& l) const;
  /// Whether light from there comes through the volume behind the surface: then only punctual
  /// lights are sampled.
  bool is_inwards(const Vec3d& l) const;
  Candidate candidate(const EnvironmentSample& light, const SkyPdf& pdf) const;
  /// `light`: radiance, or irradiance of a punctual light; `pdf`: of the direction, 0 for those.
  Candidate candidate(const Ray& towards, const Vec3d& l, const Rgb& light, double pdf) const;
  Rgb transmittance(const Vec3d& l, double distance) const;
  Vec3d start(const Vec3d& l) const;

  const TraceContext& context_;
  const Surface& surface_;
  const shader::Bsdf& bsdf_;
  const shader::Medium* around_;
};

/// A candidate where a ray is scattered in a medium; `bsdf` is not set.
Candidate sample_punctual(const TraceContext& context, const shader::Medium& medium, const Ray& ray,
                          const Float2& random);
/// A start for rays, off the surface.
inline Vec3d start_at(const Surface& surface, bool outside, double size) {
  return beside(surface.position, outside ? surface.flat_normal : -surface.flat_normal, size);
}

}  // namespace gltfx::render

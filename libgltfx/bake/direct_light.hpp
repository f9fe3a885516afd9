// SPDX-License-Identifier: Apache-2.0
/// Light that falls onto a surface straight from where it is made.
#pragma once

#include "bake/integrator.hpp"
#include "bake/material.hpp"
#include "bake/medium.hpp"
#include "bake/surface.hpp"

namespace gltfx::bake {

/// The power heuristic of two strategies (E. Veach, Robust Monte Carlo Methods, 1997).
inline double power_weight(double own, double other) {
  const double a = own * own;
  const double b = other * other;
  return a > 0 ? a / (a + b) : 0.0;
}

/// What would come from a direction to the viewer, were nothing in the way.
struct Candidate {
  Ray towards;
  Evaluation value;  ///< of the material for it
  Float2 point{};    ///< of the environment
  Rgb share;
  double weight = 0;  ///< for a choice among its kind; 0: nothing
};

/// One of several candidates, and what it stands for.
struct Reservoir {
  Candidate light;
  double scale = 0;
};

/// Of `tries` candidates one, by what they would give were nothing in the way: resampled importance
/// sampling (J. Talbot et al., EGSR 2005). `random` is from [0, 1); propose(i) gives a candidate.
template <class Propose>
Reservoir choose_one(std::uint32_t tries, double random, const Propose& propose) {
  Candidate chosen;
  double total = 0;
  for (std::uint32_t i = 0; i < tries; ++i) {
    const Candidate each = propose(i);
    if (!(each.weight > 0)) continue;
    total += each.weight;
    if (choose(each.weight / total, random)) chosen = each;
  }
  return {chosen, total > 0 ? total / (chosen.weight * tries) : 0};
}

/// Candidates of one surface. Each takes even random numbers, and its shares' mean is the light of
/// its kind, as far as directions that the material samples do not find it (multiple importance
/// sampling with those).
class DirectLight {
 public:
  /// References must outlive it. `around`: the medium outside of the surface; null: none.
  DirectLight(const TraceContext& context, const Surface& surface, const Bsdf& bsdf,
              const Medium* around)
      : context_(context), surface_(surface), bsdf_(bsdf), around_(around) {}

  /// Its share still wants finish_environment(). Weighed without a look at the environment, which
  /// is sampled by its brightness: what that is over the density is the same everywhere, more or
  /// less.
  Candidate from_environment(const Float2& random) const;
  void finish_environment(Candidate& chosen) const;
  Candidate from_emitter(const Float2& random) const;
  Candidate from_lamp(const Float2& random) const;

 private:
  /// Whether a direction is on the same side of the flat triangle as of the shading normal.
  bool is_consistent(const Vec3d& direction, const Vec3d& l) const;
  /// Whether light from there comes through the volume behind the surface: then only lamps are
  /// looked for.
  bool leads_in(const Vec3d& l) const;
  /// `light`: radiance, or irradiance of a lamp; `pdf`: of the direction, 0 for a lamp.
  Candidate candidate(const Ray& towards, const Vec3d& l, const Rgb& light, double pdf) const;
  /// What media let through on the way.
  Rgb dimming(const Vec3d& l, double far) const;
  Vec3d start(const Vec3d& l) const;

  const TraceContext& context_;
  const Surface& surface_;
  const Bsdf& bsdf_;
  const Medium* around_;
};

/// A lamp that lies in a medium, for where a ray along it is scattered; f and l are not set.
Candidate lamp_inside(const TraceContext& context, const Medium& medium, const Ray& ray,
                      const Float2& random);

/// A start for rays, off the surface.
inline Vec3d start_at(const Surface& surface, bool outside, double size) {
  return beside(surface.position, outside ? surface.flat_normal : -surface.flat_normal, size);
}

}  // namespace gltfx::bake

// SPDX-License-Identifier: Apache-2.0
#include "bake/integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bake/coverage.hpp"
#include "bake/light.hpp"
#include "bake/material.hpp"
#include "bake/media.hpp"
#include "bake/storage.hpp"
#include "bake/studio.hpp"
#include "bake/surface.hpp"

namespace gltfx::bake {
namespace {

constexpr std::uint32_t kSteps = 1024;      // of a path, in media and on surfaces
constexpr std::uint32_t kLayers = 4;        // of alpha, before the camera
constexpr std::uint32_t kTries = 4;         // for a lamp, where the camera looks
constexpr double kLeast = 1.0 / 512;        // of a layer
constexpr std::uint32_t kRouletteFrom = 3;  // step
constexpr double kShadowDepth = 0.7;        // how dark the floor becomes

// Dimensions of the random numbers of one step of a path.
enum Draw : std::uint32_t {
  lobe,
  direction,
  environment,
  emitter,
  lamp,
  roulette,
  reach,
  turn,
  color,
  choice,
  emitter_choice,
  kDraws
};
constexpr std::uint32_t kFirstDraw = 1;  // after the position in the pixel

// The power heuristic of two strategies (E. Veach, Robust Monte Carlo Methods, 1997).
double power_weight(double own, double other) {
  const double a = own * own;
  const double b = other * other;
  return a > 0 ? a / (a + b) : 0.0;
}

// One of several paths with the same beginning.
struct Branch {
  std::uint32_t number = 0, count = 1;
};

// One path, from the camera on.
class Path {
 public:
  Path(const PathSetting& setting, const Ray& ray, const Float2& point, const SampleStream& random,
       std::uint32_t layer, Branch branch)
      : s_(setting),
        ray_(ray),
        point_(point),
        random_(random),
        first_draw_(kFirstDraw + layer * kSteps * kDraws),
        branch_(branch) {}

  // `hit`: what the ray from the camera hits.
  PathSample run(std::optional<Hit> hit) {
    for (; step_ < kSteps; ++step_) {
      if (step_ > 0) {
        hit = s_.bvh.intersect(ray_, key());
        ++result_.rays;
      }
      if (!media_.empty() && scatters_before(hit)) {
        if (!survives()) break;
        continue;
      }
      if (!hit) {
        escape();
        break;
      }
      if (!meet(*hit) || !survives()) break;
    }
    return result_;
  }

 private:
  std::uint32_t dimension(Draw draw) const { return first_draw_ + step_ * kDraws + draw; }
  std::uint32_t key() const { return mix_bits(random_.key(), branch_.number) + step_; }
  Float2 pair(Draw draw) const {
    return random_.pair(dimension(draw), branch_.number, branch_.count);
  }
  double single(Draw draw) const {
    return static_cast<double>(random_.single(dimension(draw), branch_.number, branch_.count));
  }

  // Whether the path turns inside of a medium; else it is only dimmed on its way.
  bool scatters_before(const std::optional<Hit>& hit) {
    const double far = hit ? hit->distance : std::numeric_limits<double>::infinity();
    const MediumStep step = walk(media_.top(), throughput_, far, pair(Draw::reach));
    throughput_ *= step.weight;
    if (!step.scattered) return false;
    const Float2 turn = pair(Draw::turn);
    ray_.origin += ray_.direction * step.distance;
    ray_.direction = sample_phase(media_.top(), ray_.direction, static_cast<double>(turn[0]),
                                  static_cast<double>(turn[1]));
    straight_ = false;
    pdf_ = 0;
    result_.alpha = 1;
    return true;
  }

  // Beyond the scene.
  void escape() {
    if (straight_) {
      see_background();
    } else if (s_.setting.environment) {
      const Environment& light = *s_.setting.environment;
      // What a mirror or a medium sent here is found in no other way.
      const EnvironmentLook seen = light.look(ray_.direction);
      const double weight = pdf_ > 0 ? power_weight(pdf_, seen.pdf) : 1.0;
      result_.scattered += throughput_ * seen.radiance * weight;
    }
  }

  void see_background() {
    result_.alpha = 1 - std::clamp(luminance(throughput_), 0.0, 1.0);
    Rgb behind;
    if (s_.setting.background == Background::environment && s_.setting.environment) {
      behind = s_.setting.environment->radiance(ray_.direction);
    } else if (s_.setting.background == Background::backdrop) {
      behind = backdrop(static_cast<double>(point_[0]), static_cast<double>(point_[1]));
    }
    result_.behind = throughput_ * behind;
    result_.shadow = floor_shadow();
  }

  // What part of the light that falls onto the floor is kept away from it. Only what is kept away
  // is estimated: where nothing stands in the way there is no noise.
  double floor_shadow() {
    const auto& floor = s_.setting.floor;
    if (!floor || !s_.setting.environment || ray_.direction.y >= 0) return 0;
    const double distance = (floor->height - ray_.origin.y) / ray_.direction.y;
    if (!(distance > 0)) return 0;
    const Vec3d point = beside(ray_.origin + ray_.direction * distance, Vec3d(0, 1, 0), s_.size);
    const EnvironmentSample light = s_.setting.environment->sample(pair(Draw::environment));
    if (!(light.pdf > 0) || light.direction.y <= 0) return 0;
    ++result_.rays;
    const double kept = 1 - static_cast<double>(s_.bvh.visibility({point, light.direction}));
    if (kept == 0) return 0;
    const double share =
        luminance(s_.setting.environment->radiance(light)) * light.direction.y / light.pdf;
    return kept * share / floor->irradiance * kShadowDepth;
  }

  // A surface: the light it sends, that of lamps on it, and where the path goes on. False where it
  // ends.
  bool meet(const Hit& hit) {
    Surface surface = surface_at(s_.scene, hit, ray_);
    const Vec3d v = surface.frame.to_local(-ray_.direction);
    if (surfaces_ == 0) note(hit, surface);
    const Rgb own = throughput_ * emitted(surface.material, v) * by_chance(hit, surface);
    (straight_ ? result_.direct : result_.scattered) += own;
    result_.alpha = 1;
    if (surface.material.unlit || surfaces_ >= s_.bounces) return false;
    if (surface.flat_normal == Vec3d()) return false;
    ++surfaces_;
    surface.material.outside_ior = media_.ior_around(hit.instance);
    follow_one_color(surface.material);
    const Bsdf bsdf(surface.material, v, {s_.mode, color_});
    if (!bsdf.is_delta()) {
      gather_light(hit, surface, bsdf, v.z < 0);
    }
    const Float2 towards = pair(Draw::direction);
    const auto next = bsdf.sample(
        {single(Draw::lobe), static_cast<double>(towards[0]), static_cast<double>(towards[1])});
    return next && go_on(hit, surface, v, *next);
  }

  // For the denoiser and the pictures of these.
  void note(const Hit& hit, const Surface& surface) {
    result_.albedo = surface.material.base_color;
    result_.normal = surface.frame.normal;
    result_.depth = hit.distance;
    result_.material = s_.scene.meshes[s_.scene.instances[hit.instance].mesh].material;
  }

  // Colours part in a dispersive volume: from there on the path is of one of them.
  void follow_one_color(const Material& material) {
    if (color_ >= 0 || material.dispersion <= 0 || material.transmission <= 0) return;
    if (!material.volumetric()) return;
    color_ = std::min(static_cast<int>(single(Draw::color) * 3), 2);
    throughput_ *= Rgb(color_ == 0 ? 3 : 0, color_ == 1 ? 3 : 0, color_ == 2 ? 3 : 0);
  }

  // Whether a direction is on the same side of the flat triangle as of the shading normal, and in
  // the open: through a volume lamps are not seen directly.
  static bool leads_out(const Surface& surface, const Vec3d& direction, const Vec3d& l) {
    if ((dot(direction, surface.flat_normal) > 0) != (l.z > 0)) return false;
    return l.z > 0 || !surface.material.volumetric();
  }

  Vec3d start(const Surface& surface, bool outside) const {
    return beside(surface.position, outside ? surface.flat_normal : -surface.flat_normal, s_.size);
  }

  // How much of what a surface sends is found on this way and not by looking for it.
  double by_chance(const Hit& hit, const Surface& surface) const {
    if (!(pdf_ > 0) || s_.setting.emitters.empty()) return 1;
    const double cosine = std::fabs(dot(surface.flat_normal, ray_.direction));
    return power_weight(pdf_, s_.setting.emitters.pdf(hit, cosine));
  }

  // What comes from a direction, and how much that is.
  struct Candidate {
    Ray towards;
    Rgb share;
    double weight = 0;
  };

  Candidate from_environment(const Surface& surface, const Bsdf& bsdf, const Float2& random) const {
    const EnvironmentSample light = s_.setting.environment->sample(random);
    if (!(light.pdf > 0)) return {};
    const Vec3d l = surface.frame.to_local(light.direction);
    if (!leads_out(surface, light.direction, l)) return {};
    const Evaluation value = bsdf.evaluate(l);
    const Rgb share = value.f * s_.setting.environment->radiance(light) *
                      (std::fabs(l.z) / light.pdf * power_weight(light.pdf, value.pdf));
    return {{start(surface, l.z > 0), light.direction}, share, luminance(share)};
  }

  Candidate from_emitter(const Surface& surface, const Bsdf& bsdf, const Float2& random) const {
    const Shine light = s_.setting.emitters.sample(s_.scene, surface.position, random);
    if (!(max_value(light.radiance) > 0)) return {};
    const Vec3d l = surface.frame.to_local(light.direction);
    if (!leads_out(surface, light.direction, l)) return {};
    const Evaluation value = bsdf.evaluate(l);
    const Rgb share = value.f * light.radiance *
                      (std::fabs(l.z) / light.pdf * power_weight(light.pdf, value.pdf));
    const Vec3d from = start(surface, l.z > 0);
    const Vec3d way = beside(light.position, light.normal, s_.size) - from;
    const double distance = length(way);
    if (!(distance > 0)) return {};
    return {{from, way / distance, distance}, share, luminance(share)};
  }

  // Of some candidates one is looked at, by what they would give were nothing in the way: resampled
  // importance sampling (J. Talbot et al., EGSR 2005). Where the camera looks it pays to be choosy.
  template <class Propose>
  void gather(Draw draw, Draw draw_choice, const Propose& propose) {
    const std::uint32_t tries = surfaces_ == 1 ? kTries : 1;
    Candidate chosen;
    double total = 0;
    double random = single(draw_choice);
    for (std::uint32_t i = 0; i < tries; ++i) {
      const Candidate each =
          propose(random_.pair(dimension(draw), branch_.number * tries + i, branch_.count * tries));
      if (!(each.weight > 0)) continue;
      total += each.weight;
      if (choose(each.weight / total, random)) chosen = each;
    }
    if (total > 0) add_seen(chosen.towards, chosen.share * (total / (chosen.weight * tries)));
  }

  void gather_light(const Hit& hit, const Surface& surface, const Bsdf& bsdf, bool from_behind) {
    if (s_.setting.environment) {
      gather(Draw::environment, Draw::choice,
             [&](const Float2& random) { return from_environment(surface, bsdf, random); });
    }
    const bool leaves = from_behind && surface.material.volumetric();
    const bool open = leaves ? media_.empty_without(hit.instance) : media_.empty();
    if (open && !s_.setting.emitters.empty()) {
      gather(Draw::emitter, Draw::emitter_choice,
             [&](const Float2& random) { return from_emitter(surface, bsdf, random); });
    }
    gather_lamps(surface, bsdf);
  }

  void gather_lamps(const Surface& surface, const Bsdf& bsdf) {
    if (s_.setting.lights.empty()) return;
    const LightChoice lamp = choose_light(s_.setting.lights, surface.position, pair(Draw::lamp));
    if (!(lamp.probability > 0)) return;
    const Vec3d l = surface.frame.to_local(lamp.light.direction);
    if (!leads_out(surface, lamp.light.direction, l)) return;
    const Rgb share =
        bsdf.evaluate(l).f * lamp.light.irradiance * (std::fabs(l.z) / lamp.probability);
    add_seen({start(surface, l.z > 0), lamp.light.direction, lamp.light.distance}, share);
  }

  void add_seen(const Ray& towards, const Rgb& share) {
    if (!(max_value(share) > 0)) return;
    ++result_.rays;
    result_.scattered += throughput_ * share * static_cast<double>(s_.bvh.visibility(towards));
  }

  bool go_on(const Hit& hit, const Surface& surface, const Vec3d& v, const MaterialSample& next) {
    const Vec3d onwards = normalize(surface.frame.to_world(next.l));
    const bool outside = dot(onwards, surface.flat_normal) > 0;
    if (outside != (next.l.z > 0)) return false;
    throughput_ *= next.weight;
    const bool through = (next.l.z > 0) != (v.z > 0);
    if (through && surface.material.volumetric()) {
      if (outside) {
        media_.leave(hit.instance);
      } else {
        media_.enter(surface.material, hit.instance);
      }
    }
    straight_ = straight_ && through && next.delta && dot(onwards, ray_.direction) > 0.99999;
    pdf_ = next.delta || !media_.empty() ? 0 : next.pdf;
    ray_ = {start(surface, outside), onwards};
    return true;
  }

  // Paths that carry little end early, and those that do not carry their part.
  bool survives() {
    const double most = max_value(throughput_);
    if (!(most > 0)) return false;
    if (step_ < kRouletteFrom || most >= 1) return true;
    if (single(Draw::roulette) >= most) return false;
    throughput_ *= 1 / most;
    return true;
  }

  const PathSetting& s_;
  Ray ray_;
  const Float2 point_;
  const SampleStream& random_;
  std::uint32_t first_draw_;
  Branch branch_;
  PathSample result_;
  Rgb throughput_{1, 1, 1};
  MediaStack media_;
  std::uint32_t step_ = 0;
  int surfaces_ = 0;      // that scattered
  int color_ = -1;        // that the path follows, after dispersion
  bool straight_ = true;  // nothing but sheets of glass so far
  double pdf_ = 0;        // of the last direction; 0: no lamp was looked for
};

// Clear glass shows two pictures at once, and with dispersion six: it takes more paths.
std::uint32_t branches_at(const Scene& scene, const Hit& hit) {
  constexpr std::uint32_t kBranches = 4;
  const Material& factors =
      material_of(scene, scene.meshes[scene.instances[hit.instance].mesh]).factors;
  return factors.transmission > 0 ? kBranches : 1;
}

void add(PathSample& sum, const PathSample& layer, double share) {
  sum.scattered += layer.scattered * share;
  sum.direct += layer.direct * share;
  const double seen = luminance(layer.behind) * share;
  if (seen > 0) {
    const double before = luminance(sum.behind);
    sum.shadow = (sum.shadow * before + layer.shadow * seen) / (before + seen);
    sum.behind += layer.behind * share;
  }
  sum.alpha += layer.alpha * share;
  sum.albedo += layer.albedo * share;
  sum.normal += layer.normal * share;
  sum.depth += layer.depth * share;
  if (sum.material == kNone) sum.material = layer.material;
  sum.rays += layer.rays;
}

}  // namespace

// What is partly transparent by alpha is not left to chance where it is seen directly: each layer
// is a path of its own, and counts for what it covers of what is left.
PathSample trace_path(const PathSetting& setting, const Ray& ray, const Float2& point,
                      const SampleStream& random) {
  PathSample sum;
  Ray rest = ray;
  double left = 1;
  for (std::uint32_t layer = 0;; ++layer) {
    const bool last = layer + 1 == kLayers;
    const auto hit =
        last ? setting.bvh.intersect(rest, random.key()) : setting.bvh.first_layer(rest);
    const double covered = hit && !last ? static_cast<double>(setting.bvh.coverage(*hit)) : 1.0;
    ++sum.rays;
    const std::uint32_t branches = hit ? branches_at(setting.scene, *hit) : 1;
    for (std::uint32_t i = 0; i < branches; ++i) {
      add(sum, Path(setting, rest, point, random, layer, {i, branches}).run(hit),
          left * covered / branches);
    }
    left *= 1 - covered;
    if (left < kLeast) return sum;
    const Vec3d behind = rest.origin + rest.direction * hit->distance;
    rest.origin = beside(behind, rest.direction, setting.size);
  }
}

}  // namespace gltfx::bake

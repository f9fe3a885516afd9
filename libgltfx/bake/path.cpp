// SPDX-License-Identifier: Apache-2.0
#include "bake/path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/background.hpp"
#include "bake/direct_light.hpp"
#include "bake/light_through.hpp"
#include "bake/material.hpp"
#include "bake/media.hpp"
#include "bake/path_draws.hpp"
#include "bake/storage.hpp"
#include "bake/surface.hpp"

namespace gltfx::bake {
namespace {

constexpr std::uint32_t kLooks = 2;         // for light where the camera looks, of few samples
constexpr std::uint32_t kRouletteFrom = 3;  // step
constexpr double kSharp = 0.5;              // roughness below which gloss shows a picture
constexpr std::uint32_t kDeepPaths = 4;     // into what light passes through

// One path, from the camera on.
class Path {
 public:
  Path(const PathSetting& setting, const Ray& ray, const Float2& point, const SampleStream& random,
       const PathStart& start)
      : s_(setting),
        ray_(ray),
        point_(point),
        random_(random),
        first_draw_(kFirstDraw + start.layer * kSteps * kDraws),
        branch_(start.branch) {}

  // `hit`: what the ray from the camera hits.
  PathSample run(const std::optional<Hit>& hit) {
    follow(hit);
    return result_;
  }

  // The same, but only what is there.
  PathSample look(const std::optional<Hit>& hit) {
    if (!hit) {
      result_.behind = background(s_, ray_.direction, point_);
      return result_;
    }
    const Surface surface = surface_at(s_.scene, *hit, ray_);
    describe(*hit, surface);
    result_.clear = may_be_clear(surface.material);
    note(surface.material, surface.frame.normal, hit->distance);
    result_.direct = emitted(surface.material, surface.frame.to_local(-ray_.direction));
    result_.alpha = 1;
    return result_;
  }

 private:
  void follow(std::optional<Hit> hit) {
    for (; step_ < kSteps; ++step_) {
      if (step_ > 0) {
        hit = s_.bvh.intersect(ray_, key(), viewing_ ? Backs::culled : Backs::solid);
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
  }

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
    note(Rgb(1), -ray_.direction, step.distance);
    const Float2 turn = pair(Draw::turn);
    ray_.origin += ray_.direction * step.distance;
    gather_inside();
    ray_.direction = sample_phase(media_.top(), ray_.direction, static_cast<double>(turn[0]),
                                  static_cast<double>(turn[1]));
    straight_ = viewing_ = false;
    pdf_ = 0;
    result_.alpha = 1;
    return true;
  }

  // Beyond the scene.
  void escape() {
    if (straight_) {
      see_background();
    } else if (far_light()) {
      note(Rgb(1), -ray_.direction, 0);
      add_far_light();
    }
  }

  // The environment, unless it has come in through a wall of this path.
  const Environment* far_light() const {
    return s_.setting.environment && !lit_through_ ? &*s_.setting.environment : nullptr;
  }

  void add_far_light() {
    // What a mirror or a medium sent here is found in no other way.
    const EnvironmentLook seen = far_light()->look(ray_.direction);
    const double weight = pdf_ > 0 ? power_weight(pdf_, seen.pdf) : 1.0;
    deliver(throughput_ * seen.radiance * weight, gloss_);
  }

  // A wall that lets light in is a window for what shines from behind it. The environment counts
  // once along a path: through the wall, and not again by what the wall reflects.
  void look_through(const Hit& hit, const Surface& wall) {
    if (viewing_ || !media_.empty()) return;
    const bool open =
        light_through(s_, ray_, hit, wall, key(), [this](const Hit& lamp, const Surface& surface) {
          const Vec3d v = surface.frame.to_local(-ray_.direction);
          deliver(throughput_ * emitted(surface.material, v) * mis_weight(lamp, surface), gloss_);
        });
    if (!open || !far_light()) return;
    add_far_light();
    lit_through_ = true;
  }

  Rgb own_light(const Hit& hit, const Surface& surface, const Vec3d& v) const {
    const bool outshone = lit_through_ && surface.material.unlit;
    if (outshone || is_unseen_back(s_.scene, hit, surface)) return {};
    return throughput_ * emitted(surface.material, v) * mis_weight(hit, surface);
  }

  void see_background() {
    result_.alpha = 1 - luminance(throughput_);
    result_.behind = throughput_ * background(s_, ray_.direction, point_);
    result_.shadow = floor_shadow(s_, ray_, pair(Draw::environment), result_.rays);
  }

  // A surface: the light it sends, that of lamps on it, and where the path goes on. False where it
  // ends.
  bool meet(const Hit& hit) {
    Surface surface = surface_at(s_.scene, hit, ray_);
    const Vec3d v = surface.frame.to_local(-ray_.direction);
    if (surfaces_ == 0) describe(hit, surface);
    look_through(hit, surface);
    const Rgb own = own_light(hit, surface, v);
    if (straight_) {
      result_.direct += own;
    } else {
      deliver(own, gloss_);
    }
    result_.alpha = 1;
    if (!goes_on(surface)) {
      note(surface.material, surface.frame.normal, hit.distance);
      return false;
    }
    ++surfaces_;
    surface.material.outside_ior = media_.ior_around(hit.body());
    follow_one_color(surface.material);
    const Bsdf bsdf(surface.material, v, {s_.mode, color_});
    if (!may_be_clear(surface.material)) {
      note(surface.material, surface.frame.normal, hit.distance);
    }
    if (!bsdf.is_delta()) gather_light(hit, surface, bsdf);
    if (surfaces_ > 1) return turn(hit, surface, v, bsdf, branch_, {});
    fork(hit, surface, v, bsdf);
    return false;
  }

  bool goes_on(const Surface& surface) const {
    return !surface.material.unlit && surfaces_ < s_.bounces && surface.flat_normal != Vec3d();
  }

  void describe(const Hit& hit, const Surface& surface) {
    const Material& m = surface.material;
    result_.mirror = m.base_color * m.metallic + Rgb(1 - m.metallic);
    result_.material = s_.scene.meshes[hit.mesh].material;
  }

  // What is seen first behind clear glass, if there is any. For the denoiser and the pictures of
  // these.
  void note(const Rgb& color, const Vec3d& normal, double distance) {
    if (!noting_) return;
    noting_ = false;
    result_.albedo = throughput_ * color;
    result_.normal = normal * scale_;
    result_.depth = (length_ + distance) * scale_;
    result_.clear = result_.clear || surfaces_ > 1;
  }
  void note(const Material& m, const Vec3d& normal, double distance) {
    note(scattering_color(m), normal, distance);
  }

  // Colours part in a dispersive volume: from there on the path is of one of them.
  void follow_one_color(const Material& material) {
    if (color_ >= 0 || material.dispersion <= 0 || material.transmission <= 0) return;
    if (!material.volumetric()) return;
    color_ = std::min(static_cast<int>(single(Draw::color) * 3), 2);
    throughput_ *= Rgb(color_ == 0 ? 3 : 0, color_ == 1 ? 3 : 0, color_ == 2 ? 3 : 0);
  }

  // How much of what a surface sends is found on this way and not by looking for it.
  double mis_weight(const Hit& hit, const Surface& surface) const {
    if (!(pdf_ > 0) || s_.setting.emitters.empty()) return 1;
    const double cosine = std::fabs(dot(surface.flat_normal, ray_.direction));
    return power_weight(pdf_, s_.setting.emitters.pdf(hit, cosine));
  }

  // Where the camera looks it pays to be choosy.
  template <class Propose>
  Reservoir gather(Draw draw, Draw draw_choice, const Branch& part, const Propose& propose) const {
    const std::uint32_t tries = surfaces_ == 1 ? s_.tries : 1;
    const float random = random_.single(dimension(draw_choice), part.number, part.count);
    return choose_one(tries, static_cast<double>(random), [&](std::uint32_t i) {
      const Branch point = part.part(i, tries);
      return propose(random_.pair(dimension(draw), point.number, point.count));
    });
  }

  void gather_light(const Hit& hit, const Surface& surface, const Bsdf& bsdf) {
    const DirectLight light(s_, surface, bsdf, media_.around(hit.body()));
    const std::uint32_t looks = surfaces_ == 1 && s_.tries > 2 ? kLooks : 1;
    for (std::uint32_t look = 0; look < looks; ++look) {
      const Branch part = branch_.part(look, looks);
      if (far_light()) {
        Reservoir far =
            gather(Draw::environment, Draw::choice, part,
                   [&light](const Float2& random) { return light.from_environment(random); });
        if (far.scale > 0) light.finish_environment(far.light);
        add_seen({far.light, far.scale / looks});
      }
      if (s_.setting.emitters.empty()) continue;
      const Reservoir near =
          gather(Draw::emitter, Draw::emitter_choice, part,
                 [&light](const Float2& random) { return light.from_emitter(random); });
      add_seen({near.light, near.scale / looks});
    }
    if (!s_.setting.lights.empty()) add_seen({light.from_lamp(pair(Draw::lamp)), 1});
  }

  // Where a medium scatters.
  void gather_inside() {
    const Candidate lamp = lamp_inside(s_, media_.top(), ray_, pair(Draw::lamp));
    if (lamp.weight > 0) add_seen({lamp, 1});
  }

  void add_seen(const Reservoir& chosen) {
    const auto& [light, scale] = chosen;
    if (!(max_value(light.share) > 0)) return;
    ++result_.rays;
    const auto seen = static_cast<double>(s_.bvh.visibility(light.towards, s_.setting.eye));
    if (seen <= 0) return;
    const Rgb gloss = surfaces_ == 1 ? part(light.value.reflected, light.value.f) : gloss_;
    deliver(throughput_ * light.share * (scale * seen), gloss);
  }

  void deliver(const Rgb& light, const Rgb& gloss) {
    result_.reflected += light * gloss;
    result_.scattered += light * (Rgb(1) - gloss);
  }

  // Where the camera looks, mirrors and gloss are followed by paths of their own: what they show is
  // sharp, but by their strength they would get few. Clear and scattering matter shows much at
  // once, and gets several.
  void fork(const Hit& hit, const Surface& surface, const Vec3d& v, const Bsdf& bsdf) {
    const Material& m = surface.material;
    const double reflecting = bsdf.reflection_chance();
    const bool deep = m.transmission > 0 || m.diffuse_transmission > 0;
    const double sharpest =
        m.clearcoat > 0 ? std::min(m.roughness, m.clearcoat_roughness) : m.roughness;
    const bool apart = reflecting > 0 && reflecting < 1 && sharpest < kSharp;
    const std::uint32_t others = deep && reflecting < 1 ? kDeepPaths : 1;
    const std::uint32_t count = others + (apart ? 1 : 0);
    PathSample sum = result_;
    sum.alpha = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const bool mirrors = i == others;
      Range range{apart && !mirrors ? reflecting : 0, apart && mirrors ? reflecting : 1};
      const Branch within = mirrors ? branch_ : branch_.part(i, others);
      Path path(*this);
      path.result_ = {};
      path.result_.alpha = 1;
      path.branch_ = branch_.part(i, count);
      path.scale_ = (range.to - range.from) * count / (mirrors ? 1 : others);
      path.throughput_ *= path.scale_;
      path.noting_ = noting_ && !mirrors;
      if (path.turn(hit, surface, v, bsdf, within, range) && path.survives()) {
        ++path.step_;
        path.follow(std::nullopt);
      }
      sum.add(path.result_, 1.0 / count);
    }
    result_ = sum;
  }

  // Into a direction that the material proposes. False where the path ends.
  bool turn(const Hit& hit, const Surface& surface, const Vec3d& v, const Bsdf& bsdf,
            const Branch& branch, const Range& range) {
    const Float2 towards = random_.pair(dimension(Draw::direction), branch.number, branch.count);
    const auto lobe =
        static_cast<double>(random_.single(dimension(Draw::lobe), branch.number, branch.count));
    const auto next = bsdf.sample(
        {range.at(lobe), static_cast<double>(towards[0]), static_cast<double>(towards[1])});
    // A picture comes through, or else what is seen is the surface.
    constexpr double kNarrow = 2;  // per steradian
    const bool clear = next && (next->l.z > 0) != (v.z > 0) && (next->delta || next->pdf > kNarrow);
    if (!clear) note(surface.material, surface.frame.normal, hit.distance);
    return next && go_on(hit, surface, v, *next);
  }

  bool go_on(const Hit& hit, const Surface& surface, const Vec3d& v, const BsdfSample& next) {
    const Vec3d onwards = normalize(surface.frame.to_world(next.l));
    const bool outside = dot(onwards, surface.flat_normal) > 0;
    if (outside != (next.l.z > 0)) return false;
    throughput_ *= next.weight;
    const bool through = (next.l.z > 0) != (v.z > 0);
    if (surfaces_ == 1) {
      gloss_ = through ? Rgb(0) : next.delta ? Rgb(1) : part(next.reflected, next.weight);
    }
    if (through && surface.material.volumetric()) {
      if (outside) {
        media_.leave(hit.body());
      } else {
        media_.enter(surface.material, hit.body());
      }
    }
    viewing_ = viewing_ && next.delta;
    straight_ = straight_ && through && next.delta && dot(onwards, ray_.direction) > 0.99999;
    result_.clear = result_.clear || straight_;
    length_ += hit.distance;
    const bool leads_in = next.l.z < 0 && surface.material.volumetric();
    pdf_ = next.delta || leads_in ? 0 : next.pdf;
    ray_ = {start_at(surface, outside, s_.size), onwards};
    return true;
  }

  // Paths that carry little end early, and those that do not carry their part.
  bool survives() {
    const double most = max_value(throughput_) / scale_;
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
  double scale_ = 1;  // of it, for what a branch stands for
  Rgb gloss_;         // part of it that the first surface reflects
  MediaStack media_;
  std::uint32_t step_ = 0;
  int surfaces_ = 0;          // that scattered
  int color_ = -1;            // that the path follows, after dispersion
  bool straight_ = true;      // nothing but sheets of glass so far
  bool viewing_ = true;       // nothing but mirrors and clear glass so far
  bool lit_through_ = false;  // by the environment, through a wall
  bool noting_ = true;        // nothing but clear glass so far, by what it lets through
  double length_ = 0;         // to the last surface, as long as that holds
  double pdf_ = 0;            // of the last direction; 0: no lamp was looked for
};

}  // namespace

PathSample follow_path(const PathSetting& setting, const Ray& ray, const Float2& point,
                       const SampleStream& random, const PathStart& start) {
  PathSample sample = Path(setting, ray, point, random, start).run(start.hit);
  sample.alpha = std::clamp(sample.alpha, 0.0, 1.0);
  return sample;
}

PathSample look_at_start(const PathSetting& setting, const Ray& ray, const Float2& point,
                         const SampleStream& random, const PathStart& start) {
  return Path(setting, ray, point, random, start).look(start.hit);
}

}  // namespace gltfx::bake

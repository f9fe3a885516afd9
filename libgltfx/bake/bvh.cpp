// SPDX-License-Identifier: Apache-2.0
#include "bake/bvh.hpp"

#include <cmath>
#include <utility>

#include "bake/bvh_state.hpp"
#include "bake/embree.hpp"
#include "bake/material.hpp"
#include "bake/sampler.hpp"
#include "bake/surface.hpp"

namespace gltfx::bake {

// A ray with what the filters need. Embree hands back its own part, the first member.
struct Bvh::Tracing {
  Tracing(const State& s, std::uint32_t k) : state(&s), key(k) { rtcInitRayQueryContext(&embree); }
  RTCRayQueryContext embree;
  const State* state;
  std::uint32_t key;
  bool every_layer = false;  // any coverage above 0 is a hit
  Backs backs = Backs::culled;
  const std::optional<Eye>* eye = nullptr;  // of a ray towards light
  const Ray* to_lamp = nullptr;             // that ray, where no path meets the light
  float visibility = 1;
  Rgb tint{1};  // of panes

  std::optional<Hit> intersect(const Ray& ray);
  float coverage(const RTCFilterFunctionNArguments* args, Hit& hit) const;
  float find_visibility(const Ray& ray);
  bool is_passed(const RTCFilterFunctionNArguments* args, const Hit& hit,
                 const SceneMaterial& material) const;

  static Tracing& of(const RTCFilterFunctionNArguments* args) {
    return *reinterpret_cast<Tracing*>(args->context);
  }
  static void filter_closest(const RTCFilterFunctionNArguments* args);
  static void filter_any(const RTCFilterFunctionNArguments* args);
  static void filter_backs(const RTCFilterFunctionNArguments* args);
  static void filter_wall(const RTCFilterFunctionNArguments* args);
  static void filter_light_on_wall(const RTCFilterFunctionNArguments* args);
};

namespace {

Vec3d normal_of(const RTCFilterFunctionNArguments* args) {
  return {RTCHitN_Ng_x(args->hit, 1, 0), RTCHitN_Ng_y(args->hit, 1, 0),
          RTCHitN_Ng_z(args->hit, 1, 0)};
}

// Above 0 where the ray goes along the normal of the triangle, by its winding.
float along_normal(const RTCFilterFunctionNArguments* args) {
  return RTCHitN_Ng_x(args->hit, 1, 0) * RTCRayN_dir_x(args->ray, 1, 0) +
         RTCHitN_Ng_y(args->hit, 1, 0) * RTCRayN_dir_y(args->ray, 1, 0) +
         RTCHitN_Ng_z(args->hit, 1, 0) * RTCRayN_dir_z(args->ray, 1, 0);
}

Vec3d point_of(const RTCFilterFunctionNArguments* args) {
  const auto t = static_cast<double>(RTCRayN_tfar(args->ray, 1, 0));
  const Vec3d origin(RTCRayN_org_x(args->ray, 1, 0), RTCRayN_org_y(args->ray, 1, 0),
                     RTCRayN_org_z(args->ray, 1, 0));
  const Vec3d direction(RTCRayN_dir_x(args->ray, 1, 0), RTCRayN_dir_y(args->ray, 1, 0),
                        RTCRayN_dir_z(args->ray, 1, 0));
  return origin + direction * t;
}

// Of the surface that the ray meets.
Rgb straight_transmittance(const Scene& scene, const Hit& hit, const Ray& ray) {
  if (!is_pane(material_of(scene, scene.meshes[hit.mesh]))) return Rgb(0);
  const Surface surface = surface_at(scene, hit, ray);
  return Bsdf(surface.material, surface.frame.to_local(-ray.direction)).straight_transmittance();
}

}  // namespace

// Whether the ray passes the side that it comes from. A shared mesh is met in its own
// space, where nothing is mirrored.
bool Bvh::Tracing::is_passed(const RTCFilterFunctionNArguments* args, const Hit& hit,
                             const SceneMaterial& material) const {
  if (!is_culled(material)) return false;
  const float along = along_normal(args);
  const bool shared = RTCHitN_instID(args->hit, 1, 0, 0) != RTC_INVALID_GEOMETRY_ID;
  const bool front = (shared || state->groups.facing[hit.instance] > 0 ? along : -along) < 0;
  if (!front) {
    const bool tints = to_lamp != nullptr && is_pane(material);
    return backs == Backs::culled || !(is_wall(material) || tints);
  }
  return eye != nullptr && is_wall(material) && turns_back(state->scene, hit, *eye);
}

// The part of a ray that the triangle of a possible hit stops.
float Bvh::Tracing::coverage(const RTCFilterFunctionNArguments* args, Hit& hit) const {
  hit = state->hit_of(RTCHitN_instID(args->hit, 1, 0, 0), RTCHitN_geomID(args->hit, 1, 0),
                      RTCHitN_primID(args->hit, 1, 0));
  hit.u = RTCHitN_u(args->hit, 1, 0);
  hit.v = RTCHitN_v(args->hit, 1, 0);
  const Scene& scene = state->scene;
  const Mesh& mesh = scene.meshes[hit.mesh];
  const SceneMaterial& material = material_of(scene, mesh);
  if (is_passed(args, hit, material)) return 0;
  return has_holes(material) ? coverage_at(scene, mesh, material, hit) : 1.0F;
}

// Where nothing is mirrored it does not matter whose triangle it is.
void Bvh::Tracing::filter_backs(const RTCFilterFunctionNArguments* args) {
  if (along_normal(args) >= 0) args->valid[0] = 0;
}

void Bvh::Tracing::filter_wall(const RTCFilterFunctionNArguments* args) {
  if (Tracing::of(args).backs == Backs::culled) filter_backs(args);
}

void Bvh::Tracing::filter_light_on_wall(const RTCFilterFunctionNArguments* args) {
  if (along_normal(args) >= 0) return;
  const std::optional<Eye>& eye = *Tracing::of(args).eye;
  if (!eye || eye->is_behind(normal_of(args), point_of(args))) args->valid[0] = 0;
}

void Bvh::Tracing::filter_closest(const RTCFilterFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  const Tracing& tracing = Tracing::of(args);
  Hit hit;
  const float coverage = tracing.coverage(args, hit);
  if (coverage >= 1 || (tracing.every_layer && coverage > 0)) return;
  const std::uint32_t surface = mix_bits(hit.triangle, mix_bits(hit.instance, hit.mesh));
  if (coverage <= unit_float(mix_bits(tracing.key, surface))) args->valid[0] = 0;
}

void Bvh::Tracing::filter_any(const RTCFilterFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  Tracing& tracing = Tracing::of(args);
  Hit hit;
  const float coverage = tracing.coverage(args, hit);
  Rgb through(0);
  if (tracing.to_lamp != nullptr && coverage > 0) {
    through = straight_transmittance(tracing.state->scene, hit, *tracing.to_lamp);
  }
  if (max_value(through) > 0) {
    const auto covered = static_cast<double>(coverage);
    tracing.tint *= Rgb(1 - covered) + through * covered;
  } else {
    tracing.visibility *= 1 - coverage;
  }
  if (tracing.visibility > 0) args->valid[0] = 0;
}

void Bvh::State::set_filters(RTCGeometry geometry, Treatment treatment, bool in_world,
                             bool mirrored) {
  if (treatment == Treatment::solid) return;
  const bool wall = treatment == Treatment::wall;
  const bool body = treatment == Treatment::body;
  RTCFilterFunctionN closest = Tracing::filter_closest;
  RTCFilterFunctionN any = body ? nullptr : Tracing::filter_any;
  if (treatment != Treatment::holed && treatment != Treatment::pane && !mirrored) {
    closest = wall || body ? Tracing::filter_wall : Tracing::filter_backs;
    if (treatment == Treatment::culled) any = Tracing::filter_backs;
    if (wall && in_world) any = Tracing::filter_light_on_wall;
  }
  rtcSetGeometryIntersectFilterFunction(geometry, closest);
  rtcSetGeometryOccludedFilterFunction(geometry, any);
}

namespace {

void start(RTCRay& target, const Ray& ray) {
  target.org_x = static_cast<float>(ray.origin.x);
  target.org_y = static_cast<float>(ray.origin.y);
  target.org_z = static_cast<float>(ray.origin.z);
  target.tnear = 0;
  target.dir_x = static_cast<float>(ray.direction.x);
  target.dir_y = static_cast<float>(ray.direction.y);
  target.dir_z = static_cast<float>(ray.direction.z);
  target.time = 0;
  target.tfar = static_cast<float>(ray.far);
  target.mask = 0xFFFFFFFFU;
  target.id = 0;
  target.flags = 0;
}

}  // namespace

Bvh::Bvh(std::unique_ptr<State> state) : state_(std::move(state)) {}
Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;
Bvh::~Bvh() = default;

Result<Bvh> Bvh::build(const Scene& scene) {
  auto state = std::make_unique<State>(scene);
  if (!state->build()) {
    State::keep(std::move(state));
    return Error{"there is not enough memory to prepare the scene for rays"};
  }
  return Bvh(std::move(state));
}

namespace {

// Numbers, and not too large for Embree.
bool is_traceable(const Ray& ray, double farthest) {
  const double reach = std::fabs(ray.origin.x) + std::fabs(ray.origin.y) + std::fabs(ray.origin.z);
  return reach < farthest && dot(ray.direction, ray.direction) < 2;
}

}  // namespace

std::optional<Hit> Bvh::Tracing::intersect(const Ray& ray) {
  if (!is_traceable(ray, state->groups.farthest)) return std::nullopt;
  RTCRayHit query;
  start(query.ray, ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  find_hit(state->top, embree, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  Hit hit = state->hit_of(query.hit.instID[0], query.hit.geomID, query.hit.primID);
  hit.distance = query.ray.tfar;
  hit.u = query.hit.u;
  hit.v = query.hit.v;
  return hit;
}

float Bvh::Tracing::find_visibility(const Ray& ray) {
  backs = Backs::solid;
  RTCRay query;
  start(query, ray);
  find_occluder(state->top, embree, query);
  return query.tfar < 0 ? 0.0F : visibility;
}

std::optional<Hit> Bvh::intersect(const Ray& ray, std::uint32_t key, Backs backs) const {
  Tracing tracing(*state_, key);
  tracing.backs = backs;
  return tracing.intersect(ray);
}

std::optional<Hit> Bvh::first_layer(const Ray& ray) const {
  Tracing tracing(*state_, 0);
  tracing.every_layer = true;
  return tracing.intersect(ray);
}

float Bvh::coverage(const Hit& hit) const {
  const Mesh& mesh = state_->scene.meshes[hit.mesh];
  const SceneMaterial& material = material_of(state_->scene, mesh);
  return has_holes(material) ? coverage_at(state_->scene, mesh, material, hit) : 1.0F;
}

float Bvh::visibility(const Ray& ray, const std::optional<Eye>& eye) const {
  if (!is_traceable(ray, state_->groups.farthest)) return 1;
  Tracing tracing(*state_, 0);
  tracing.eye = &eye;
  return tracing.find_visibility(ray);
}

Rgb Bvh::transmittance(const Ray& ray, const std::optional<Eye>& eye) const {
  if (!is_traceable(ray, state_->groups.farthest)) return Rgb(1);
  Tracing tracing(*state_, 0);
  tracing.eye = &eye;
  tracing.to_lamp = &ray;
  const auto visible = static_cast<double>(tracing.find_visibility(ray));
  return tracing.tint * visible;
}

bool Bvh::lets_light_in(const Hit& hit, const Vec3d& direction,
                        const std::optional<Eye>& eye) const {
  return !state_->groups.closed[hit.mesh] &&
         bake::lets_light_in(state_->scene, hit, direction, eye);
}

std::size_t Bvh::triangles() const { return state_->groups.triangles; }

}  // namespace gltfx::bake

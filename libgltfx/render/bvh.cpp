// SPDX-License-Identifier: Apache-2.0
#include "render/bvh.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "render/bvh_state.hpp"
#include "render/embree.hpp"
#include "render/sampler.hpp"
#include "render/surface.hpp"
#include "shader/material.hpp"

namespace gltfx::render {

namespace {

Vec3d normal_of(const RTCHit& hit) { return {hit.Ng_x, hit.Ng_y, hit.Ng_z}; }

Vec3d end_of(const RTCRay& ray) {
  const Vec3d origin(ray.org_x, ray.org_y, ray.org_z);
  const Vec3d direction(ray.dir_x, ray.dir_y, ray.dir_z);
  return origin + direction * static_cast<double>(ray.tfar);
}

// Above 0 where the ray goes along the normal of the triangle, by its winding.
float along_normal(const RTCRayHit& possible) {
  const auto& [ray, hit] = possible;
  return hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z;
}

// Rejects the possible hits for which pass(hit) is true.
template <class Pass>
void reject(const RTCFilterFunctionNArguments* args, const Pass& pass) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const RTCRayHit possible{rtcGetRayFromRayN(args->ray, args->N, i),
                             rtcGetHitFromHitN(args->hit, args->N, i)};
    if (pass(possible)) args->valid[i] = 0;
  }
}

}  // namespace

// Rays with the data of the filters. Embree passes the first member to the filters.
struct Bvh::Tracing {
  Tracing(const State& s, std::uint32_t k) : state(&s), key(k) { rtcInitRayQueryContext(&embree); }
  RTCRayQueryContext embree;
  const State* state;
  std::uint32_t key;
  bool every_layer = false;  // any coverage above 0 is a hit
  Backs backs = Backs::culled;
  const std::optional<Eye>* eye = nullptr;  // of a ray towards light
  const Ray* to_lamp = nullptr;             // that ray, if no path can hit the light
  std::array<float, kShadowPacket> visibility{1, 1, 1, 1};  // by RTCRay::id
  Rgb tint{1};                                              // of panes

  std::optional<Hit> intersect(const Ray& ray);
  float coverage(const RTCRayHit& possible, Hit& hit) const;
  float find_visibility(const Ray& ray);
  bool is_passed(const RTCRayHit& possible, const Hit& hit, const SceneMaterial& material) const;

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

// The transmittance of the surface at the hit.
Rgb straight_transmittance(const Scene& scene, const Hit& hit, const Ray& ray) {
  if (!is_pane(material_of(scene, scene.meshes[hit.mesh]))) return Rgb(0);
  const Surface surface = surface_at(scene, hit, ray);
  return shader::Bsdf(surface.material, surface.frame.to_local(-ray.direction))
      .straight_transmittance();
}

}  // namespace

// Whether the ray passes the side that it comes from. A shared mesh is hit in its own space, where
// nothing is mirrored.
bool Bvh::Tracing::is_passed(const RTCRayHit& possible, const Hit& hit,
                             const SceneMaterial& material) const {
  if (!is_culled(material)) return false;
  const float along = along_normal(possible);
  const bool shared = possible.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
  const bool front = (shared || state->groups.facing[hit.instance] > 0 ? along : -along) < 0;
  if (!front) {
    const bool tints = to_lamp != nullptr && is_pane(material);
    return backs == Backs::culled || !(is_wall(material) || tints);
  }
  return eye != nullptr && is_wall(material) && turns_back(state->scene, hit, *eye);
}

// The part of a ray that the triangle of a possible hit stops.
float Bvh::Tracing::coverage(const RTCRayHit& possible, Hit& hit) const {
  hit = state->hit_of(possible.hit);
  const Scene& scene = state->scene;
  const Mesh& mesh = scene.meshes[hit.mesh];
  const SceneMaterial& material = material_of(scene, mesh);
  if (is_passed(possible, hit, material)) return 0;
  return has_holes(material) ? coverage_at(scene, mesh, material, hit) : 1.0F;
}

// Without mirrored instances, the instance of a triangle does not matter.
void Bvh::Tracing::filter_backs(const RTCFilterFunctionNArguments* args) {
  reject(args, [](const RTCRayHit& possible) { return along_normal(possible) >= 0; });
}

void Bvh::Tracing::filter_wall(const RTCFilterFunctionNArguments* args) {
  if (Tracing::of(args).backs == Backs::culled) filter_backs(args);
}

void Bvh::Tracing::filter_light_on_wall(const RTCFilterFunctionNArguments* args) {
  const std::optional<Eye>& eye = *Tracing::of(args).eye;
  reject(args, [&eye](const RTCRayHit& possible) {
    if (along_normal(possible) >= 0) return false;
    return !eye || eye->is_behind(normal_of(possible.hit), end_of(possible.ray));
  });
}

void Bvh::Tracing::filter_closest(const RTCFilterFunctionNArguments* args) {
  const Tracing& tracing = Tracing::of(args);
  reject(args, [&tracing](const RTCRayHit& possible) {
    Hit hit;
    const float coverage = tracing.coverage(possible, hit);
    if (coverage >= 1 || (tracing.every_layer && coverage > 0)) return false;
    const std::uint32_t surface = mix_bits(hit.triangle, mix_bits(hit.instance, hit.mesh));
    return coverage <= unit_float(mix_bits(tracing.key, surface));
  });
}

void Bvh::Tracing::filter_any(const RTCFilterFunctionNArguments* args) {
  Tracing& tracing = Tracing::of(args);
  reject(args, [&tracing](const RTCRayHit& possible) {
    Hit hit;
    const float coverage = tracing.coverage(possible, hit);
    float& left = tracing.visibility[possible.ray.id];
    Rgb through(0);
    if (tracing.to_lamp != nullptr && coverage > 0) {
      through = straight_transmittance(tracing.state->scene, hit, *tracing.to_lamp);
    }
    if (max_value(through) > 0) {
      const auto covered = static_cast<double>(coverage);
      tracing.tint *= Rgb(1 - covered) + through * covered;
    } else {
      left *= 1 - coverage;
    }
    return left > 0;
  });
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

// One of the rays of a packet, or a ray alone, which is a packet of one.
template <class Packet>
void set(Packet& packet, unsigned count, unsigned number, const Ray& ray) {
  auto* const rays = reinterpret_cast<RTCRayN*>(&packet);
  RTCRayN_org_x(rays, count, number) = static_cast<float>(ray.origin.x);
  RTCRayN_org_y(rays, count, number) = static_cast<float>(ray.origin.y);
  RTCRayN_org_z(rays, count, number) = static_cast<float>(ray.origin.z);
  RTCRayN_tnear(rays, count, number) = 0;
  RTCRayN_dir_x(rays, count, number) = static_cast<float>(ray.direction.x);
  RTCRayN_dir_y(rays, count, number) = static_cast<float>(ray.direction.y);
  RTCRayN_dir_z(rays, count, number) = static_cast<float>(ray.direction.z);
  RTCRayN_time(rays, count, number) = 0;
  RTCRayN_tfar(rays, count, number) = static_cast<float>(ray.far);
  RTCRayN_mask(rays, count, number) = 0xFFFFFFFFU;
  RTCRayN_id(rays, count, number) = number;
  RTCRayN_flags(rays, count, number) = 0;
}

}  // namespace

Bvh::Bvh(std::unique_ptr<State> state) : state_(std::move(state)) {}
Bvh::Bvh(Bvh&&) noexcept = default;
Bvh& Bvh::operator=(Bvh&&) noexcept = default;
Bvh::~Bvh() = default;

Result<Bvh> Bvh::build(const Scene& scene, BvhMethod method) {
  auto state = std::make_unique<State>(scene, method);
  if (!state->build()) {
    State::keep(std::move(state));
    return Error{"there is not enough memory to prepare the scene for rays"};
  }
  return Bvh(std::move(state));
}

namespace {

// Whether coordinates are numbers, and not too large for Embree.
bool is_traceable(const Ray& ray, double farthest) {
  const double reach = std::fabs(ray.origin.x) + std::fabs(ray.origin.y) + std::fabs(ray.origin.z);
  return reach < farthest && dot(ray.direction, ray.direction) < 2;
}

}  // namespace

std::optional<Hit> Bvh::Tracing::intersect(const Ray& ray) {
  if (!is_traceable(ray, state->groups.farthest)) return std::nullopt;
  RTCRayHit query;
  set(query.ray, 1, 0, ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  find_hit(state->top, embree, query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  Hit hit = state->hit_of(query.hit);
  hit.distance = query.ray.tfar;
  return hit;
}

float Bvh::Tracing::find_visibility(const Ray& ray) {
  backs = Backs::solid;
  RTCRay query;
  set(query, 1, 0, ray);
  find_occluder(state->top, embree, query);
  return query.tfar < 0 ? 0.0F : visibility[0];
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

void Bvh::first_layers(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const {
  Tracing tracing(*state_, 0);
  tracing.every_layer = true;
  alignas(32) std::array<int, kCameraPacket> valid{};
  RTCRayHit8 query;
  for (unsigned i = 0; i < rays.size(); ++i) {
    valid[i] = is_traceable(rays[i], state_->groups.farthest) ? -1 : 0;
    set(query.ray, kCameraPacket, i, rays[i]);
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  find_hits(state_->top, tracing.embree, valid.data(), query);
  auto* const found = reinterpret_cast<RTCHitN*>(&query.hit);
  for (unsigned i = 0; i < rays.size(); ++i) {
    hits[i].reset();
    if (valid[i] == 0 || query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    hits[i] = state_->hit_of(rtcGetHitFromHitN(found, kCameraPacket, i));
    hits[i]->distance = query.ray.tfar[i];
  }
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

void Bvh::find_visibility(std::span<const Ray> rays, const std::optional<Eye>& eye,
                          std::span<float> visible) const {
  if (rays.size() == 1) {
    visible[0] = visibility(rays[0], eye);
    return;
  }
  Tracing tracing(*state_, 0);
  tracing.eye = &eye;
  tracing.backs = Backs::solid;
  alignas(16) std::array<int, kShadowPacket> valid{};
  RTCRay4 query;
  for (unsigned i = 0; i < rays.size(); ++i) {
    valid[i] = is_traceable(rays[i], state_->groups.farthest) ? -1 : 0;
    set(query, kShadowPacket, i, rays[i]);
  }
  find_occluders(state_->top, tracing.embree, valid.data(), query);
  for (unsigned i = 0; i < rays.size(); ++i) {
    const bool stopped = valid[i] != 0 && query.tfar[i] < 0;
    visible[i] = stopped ? 0.0F : tracing.visibility[i];
  }
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
         render::lets_light_in(state_->scene, hit, direction, eye);
}

std::size_t Bvh::triangles() const { return state_->groups.triangles; }

}  // namespace gltfx::render

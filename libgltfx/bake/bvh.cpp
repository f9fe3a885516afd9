// SPDX-License-Identifier: Apache-2.0
#include "bake/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <embree3/rtcore.h>

#include "bake/bvh_state.hpp"
#include "bake/coverage.hpp"
#include "bake/sampler.hpp"

namespace gltfx::bake {

Hit Bvh::State::hit_of(std::uint32_t inst, std::uint32_t geometry, std::uint32_t primitive) const {
  Hit hit;
  if (inst != RTC_INVALID_GEOMETRY_ID) {
    hit.instance = instanced[inst - kTreatments];
    hit.triangle = primitive;
    return hit;
  }
  const Group& group = groups[geometry];
  const auto after = std::upper_bound(group.first.begin(), group.first.end(), primitive);
  const auto index = static_cast<std::size_t>(after - group.first.begin() - 1);
  hit.instance = group.instances[index];
  hit.triangle = primitive - static_cast<std::uint32_t>(group.first[index]);
  return hit;
}

namespace {

// Above 0 where the ray goes the way that the triangle's normal points, by its winding.
float along_normal(const RTCFilterFunctionNArguments* args) {
  return RTCHitN_Ng_x(args->hit, 1, 0) * RTCRayN_dir_x(args->ray, 1, 0) +
         RTCHitN_Ng_y(args->hit, 1, 0) * RTCRayN_dir_y(args->ray, 1, 0) +
         RTCHitN_Ng_z(args->hit, 1, 0) * RTCRayN_dir_z(args->ray, 1, 0);
}

}  // namespace

// What part of a ray a triangle stops that Embree offers.
float Bvh::State::coverage(const RTCFilterFunctionNArguments* args, Hit& hit) const {
  hit = hit_of(RTCHitN_instID(args->hit, 1, 0, 0), RTCHitN_geomID(args->hit, 1, 0),
               RTCHitN_primID(args->hit, 1, 0));
  hit.u = RTCHitN_u(args->hit, 1, 0);
  hit.v = RTCHitN_v(args->hit, 1, 0);
  const Mesh& mesh = scene.meshes[scene.instances[hit.instance].mesh];
  const SceneMaterial& material = material_of(scene, mesh);
  if (is_culled(material) && !offers_front(args, hit)) return 0;
  return has_holes(material) ? coverage_at(scene, mesh, material, hit) : 1.0F;
}

// A mesh of many instances is met in its own space, where nothing is mirrored.
bool Bvh::State::offers_front(const RTCFilterFunctionNArguments* args, const Hit& hit) const {
  const float along = along_normal(args);
  const bool instance = RTCHitN_instID(args->hit, 1, 0, 0) != RTC_INVALID_GEOMETRY_ID;
  return (instance || facing[hit.instance] > 0 ? along : -along) < 0;
}

// Where nothing is mirrored it does not matter whose triangle it is.
void Bvh::State::filter_backs(const RTCFilterFunctionNArguments* args) {
  if (along_normal(args) >= 0) args->valid[0] = 0;
}

void Bvh::State::filter_closest(const RTCFilterFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  const auto& tracing = *reinterpret_cast<const Tracing*>(args->context);
  Hit hit;
  const float coverage = tracing.state->coverage(args, hit);
  if (coverage >= 1 || (tracing.every_layer && coverage > 0)) return;
  const std::uint32_t surface = mix_bits(hit.triangle, hit.instance);
  if (coverage <= unit_float(mix_bits(tracing.key, surface))) args->valid[0] = 0;
}

void Bvh::State::filter_any(const RTCFilterFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  auto& tracing = *reinterpret_cast<Tracing*>(args->context);
  Hit hit;
  tracing.visibility *= 1 - tracing.state->coverage(args, hit);
  if (tracing.visibility > 0) args->valid[0] = 0;
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

bool Bvh::State::is_traceable(const Ray& ray) const {
  const double reach = std::fabs(ray.origin.x) + std::fabs(ray.origin.y) + std::fabs(ray.origin.z);
  return reach < farthest && dot(ray.direction, ray.direction) < 2;
}

std::optional<Hit> Bvh::State::intersect(Tracing& tracing, const Ray& ray) const {
  if (!is_traceable(ray)) return std::nullopt;
  RTCRayHit query;
  start(query.ray, ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(top, &tracing.embree, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  Hit hit = hit_of(query.hit.instID[0], query.hit.geomID, query.hit.primID);
  hit.distance = query.ray.tfar;
  hit.u = query.hit.u;
  hit.v = query.hit.v;
  return hit;
}

std::optional<Hit> Bvh::intersect(const Ray& ray, std::uint32_t key) const {
  Tracing tracing(*state_, key);
  return state_->intersect(tracing, ray);
}

std::optional<Hit> Bvh::first_layer(const Ray& ray) const {
  Tracing tracing(*state_, 0);
  tracing.every_layer = true;
  return state_->intersect(tracing, ray);
}

float Bvh::coverage(const Hit& hit) const {
  const Mesh& mesh = state_->scene.meshes[state_->scene.instances[hit.instance].mesh];
  const SceneMaterial& material = material_of(state_->scene, mesh);
  return has_holes(material) ? coverage_at(state_->scene, mesh, material, hit) : 1.0F;
}

float Bvh::visibility(const Ray& ray) const {
  if (!state_->is_traceable(ray)) return 1;
  Tracing tracing(*state_, 0);
  RTCRay query;
  start(query, ray);
  rtcOccluded1(state_->top, &tracing.embree, &query);
  return query.tfar < 0 ? 0.0F : tracing.visibility;
}

std::size_t Bvh::triangles() const { return state_->triangles; }

}  // namespace gltfx::bake

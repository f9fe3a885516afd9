// SPDX-License-Identifier: Apache-2.0
#include "bake/bvh.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

#include <embree3/rtcore.h>

#include "bake/bvh_groups.hpp"
#include "bake/coverage.hpp"
#include "bake/sampler.hpp"
#include "bake/storage.hpp"
#include "base/parallel.hpp"

namespace gltfx::bake {
struct Bvh::State {
  explicit State(const Scene& s) : scene(s), groups(group_instances(s)) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (top != nullptr) rtcReleaseScene(top);
    for (RTCScene each : shared) {
      if (each != nullptr) rtcReleaseScene(each);
    }
    if (device != nullptr) rtcReleaseDevice(device);
  }

  bool build();
  static void keep(std::unique_ptr<State> failed);
  bool add_points(RTCGeometry geometry, const Group& group) const;
  bool add_triangles(RTCGeometry geometry, const Group& group) const;
  bool add_group(const Group& group, Treatment treatment);
  bool add_shared_mesh(std::uint32_t mesh);
  bool add_instance(std::uint32_t instance);
  static void set_filters(RTCGeometry geometry, Treatment treatment, bool mirrored);
  Hit hit_of(std::uint32_t inst, std::uint32_t geometry, std::uint32_t primitive) const;
  float coverage(const RTCFilterFunctionNArguments* args, Hit& hit) const;
  bool is_traceable(const Ray& ray) const;  // numbers, and not too large for Embree
  bool offers_front(const RTCFilterFunctionNArguments* args, const Hit& hit) const;
  std::optional<Hit> intersect(Tracing& tracing, const Ray& ray) const;
  static void filter_closest(const RTCFilterFunctionNArguments* args);
  static void filter_any(const RTCFilterFunctionNArguments* args);
  static void filter_backs(const RTCFilterFunctionNArguments* args);

  const Scene& scene;
  const Groups groups;
  State* kept_before = nullptr;
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<RTCScene> shared;  // by mesh; null where not shared
  bool watertight = false;
};

// What the filters know of the ray. Embree hands back its own part, which is the first one.
struct Bvh::Tracing {
  Tracing(const State& s, std::uint32_t k) : state(&s), key(k) { rtcInitIntersectContext(&embree); }
  RTCIntersectContext embree;
  const State* state;
  std::uint32_t key;
  bool every_layer = false;  // whatever covers anything counts
  float visibility = 1;
};

namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Null where there is no memory.
template <class T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, std::size_t count) {
  static_assert(sizeof(T) == 12);
  const bool vertices = type == RTC_BUFFER_TYPE_VERTEX;
  return static_cast<T*>(rtcSetNewGeometryBuffer(
      geometry, type, 0, vertices ? RTC_FORMAT_FLOAT3 : RTC_FORMAT_UINT3, sizeof(T), count));
}

// The scene outlives the hierarchy. Vertices are copied: Embree reads on behind the last one.
void share_triangles(RTCGeometry geometry, const Mesh& mesh) {
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, 12, mesh.triangles.size());
}

bool attach(RTCDevice device, RTCScene scene, RTCGeometry geometry, std::uint32_t number) {
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, number);
  rtcReleaseGeometry(geometry);
  return rtcGetDeviceError(device) == RTC_ERROR_NONE;
}

// On one thread: with more the order of triangles, and with it which of two at one place is hit,
// would depend on their number. Not by the device's own limit, which holds for the whole process.
void commit(RTCScene scene) {
  run_alone([scene] { rtcCommitScene(scene); });
}

// A ray in some millions slips through between two triangles, for a tenth less time: only those
// must not that keep count of what they are inside of.
bool has_volumes(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const SceneMaterial& each) { return each.factors.volumetric(); });
}

RTCScene new_scene(RTCDevice device, bool watertight) {
  RTCScene scene = rtcNewScene(device);
  if (scene != nullptr) {
    const unsigned robust = watertight ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE;
    rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(robust));
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  }
  return scene;
}

}  // namespace

void Bvh::State::set_filters(RTCGeometry geometry, Treatment treatment, bool mirrored) {
  if (treatment == Treatment::solid) return;
  const bool simple = treatment == Treatment::culled && !mirrored;
  rtcSetGeometryIntersectFilterFunction(geometry, simple ? filter_backs : filter_closest);
  rtcSetGeometryOccludedFilterFunction(geometry, simple ? filter_backs : filter_any);
}

bool Bvh::State::add_points(RTCGeometry geometry, const Group& group) const {
  auto* points = new_buffer<Float3>(geometry, RTC_BUFFER_TYPE_VERTEX, group.vertices);
  if (points == nullptr) return false;
  for (const std::uint32_t number : group.instances) {
    const Instance& instance = scene.instances[number];
    for (const Float3& p : scene.meshes[instance.mesh].positions) {
      *points++ = to_float3(transform_point(instance.to_world, to_vec(p)));
    }
  }
  return true;
}

bool Bvh::State::add_triangles(RTCGeometry geometry, const Group& group) const {
  if (group.instances.size() == 1) {
    share_triangles(geometry, scene.meshes[scene.instances[group.instances.front()].mesh]);
    return true;
  }
  auto* triangle = new_buffer<Triangle>(geometry, RTC_BUFFER_TYPE_INDEX, group.triangles);
  if (triangle == nullptr) return false;
  std::uint32_t base = 0;
  for (const std::uint32_t number : group.instances) {
    const Mesh& mesh = scene.meshes[scene.instances[number].mesh];
    for (const auto& t : mesh.triangles) *triangle++ = {t[0] + base, t[1] + base, t[2] + base};
    base += static_cast<std::uint32_t>(mesh.positions.size());
  }
  return true;
}

bool Bvh::State::add_group(const Group& group, Treatment treatment) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (!add_points(geometry, group) || !add_triangles(geometry, group)) {
    rtcReleaseGeometry(geometry);
    return false;
  }
  set_filters(geometry, treatment, group.mirrored);
  return attach(device, top, geometry, static_cast<std::uint32_t>(treatment));
}

bool Bvh::State::add_shared_mesh(std::uint32_t number) {
  const Mesh& mesh = scene.meshes[number];
  RTCScene own = new_scene(device, watertight);
  if (own == nullptr) return false;
  shared[number] = own;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* points = new_buffer<Float3>(geometry, RTC_BUFFER_TYPE_VERTEX, mesh.positions.size());
  if (points == nullptr) {
    rtcReleaseGeometry(geometry);
    return false;
  }
  std::copy(mesh.positions.begin(), mesh.positions.end(), points);
  share_triangles(geometry, mesh);
  set_filters(geometry, treatment_of(material_of(scene, mesh)), false);
  if (!attach(device, own, geometry, 0)) return false;
  commit(own);
  return rtcGetDeviceError(device) == RTC_ERROR_NONE;
}

bool Bvh::State::add_instance(std::uint32_t index) {
  const Instance& instance = scene.instances[groups.instanced[index]];
  if (shared[instance.mesh] == nullptr && !add_shared_mesh(instance.mesh)) return false;
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, shared[instance.mesh]);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, instance.to_world.data());
  return attach(device, top, geometry, static_cast<std::uint32_t>(kTreatments + index));
}

bool Bvh::State::build() {
  device = rtcNewDevice("set_affinity=0");
  if (device == nullptr) return false;
  watertight = has_volumes(scene);
  top = new_scene(device, watertight);
  if (top == nullptr) return false;
  for (std::size_t i = 0; i < kTreatments; ++i) {
    if (groups.flat[i].triangles == 0) continue;
    if (!add_group(groups.flat[i], static_cast<Treatment>(i))) return false;
  }
  shared.assign(scene.meshes.size(), nullptr);
  for (std::uint32_t i = 0; i < groups.instanced.size(); ++i) {
    if (!add_instance(i)) return false;
  }
  commit(top);
  return rtcGetDeviceError(device) == RTC_ERROR_NONE;
}

Hit Bvh::State::hit_of(std::uint32_t inst, std::uint32_t geometry, std::uint32_t primitive) const {
  Hit hit;
  if (inst != RTC_INVALID_GEOMETRY_ID) {
    hit.instance = groups.instanced[inst - kTreatments];
    hit.triangle = primitive;
    return hit;
  }
  const Group& group = groups.flat[geometry];
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
  return (instance || groups.facing[hit.instance] > 0 ? along : -along) < 0;
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

// Embree's threads still hold on to what a build that failed had allocated: it is never freed.
void Bvh::State::keep(std::unique_ptr<State> failed) {
  static std::atomic<State*> kept{nullptr};
  State* const state = failed.release();
  state->kept_before = kept.exchange(state);
}

Result<Bvh> Bvh::build(const Scene& scene) {
  auto state = std::make_unique<State>(scene);
  if (!state->build()) {
    State::keep(std::move(state));
    return Error{"there is not enough memory to prepare the scene for rays"};
  }
  return Bvh(std::move(state));
}

bool Bvh::State::is_traceable(const Ray& ray) const {
  const double reach = std::fabs(ray.origin.x) + std::fabs(ray.origin.y) + std::fabs(ray.origin.z);
  return reach < groups.farthest && dot(ray.direction, ray.direction) < 2;
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

std::size_t Bvh::triangles() const { return state_->groups.triangles; }

}  // namespace gltfx::bake

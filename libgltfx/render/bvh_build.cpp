// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <atomic>
#include <shared_mutex>
#include <span>
#include <utility>

#if GLTFX_TBB
#include <tbb/task_arena.h>
#endif

#include "base/fork.hpp"
#include "base/packed.hpp"
#include "render/bvh_groups.hpp"
#include "render/bvh_state.hpp"
#include "render/embree.hpp"
#include "render/transform.hpp"

namespace gltfx::render {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Null if memory is missing.
template <class T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, std::size_t count) {
  static_assert(sizeof(T) == 12);
  const bool vertices = type == RTC_BUFFER_TYPE_VERTEX;
  return static_cast<T*>(rtcSetNewGeometryBuffer(
      geometry, type, 0, vertices ? RTC_FORMAT_FLOAT3 : RTC_FORMAT_UINT3, sizeof(T), count));
}

// The scene outlives the hierarchy. Vertices are copied: Embree reads past the last one.
void share_triangles(RTCGeometry geometry, std::span<const Triangle> triangles) {
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.data(),
                             0, 12, triangles.size());
}

RTCBuildQuality quality_of(BvhMethod method) {
  return method == BvhMethod::sah ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_LOW;
}

// Embree and TBB have internal locks, which must not be held during a fork().
ForkGate building;

// On one thread: with several, the order of triangles, and so which of two at one place is hit,
// would depend on their number. Not with the device's own limit, which applies to the whole
// process. An arena is reused: TBB is slow to release its memory.
void commit(RTCScene scene) {
#if GLTFX_TBB
  static thread_local tbb::task_arena arena(1);
  arena.execute([scene] { rtcCommitScene(scene); });
#else  // Embree's own threads, of which the device has none
  rtcCommitScene(scene);
#endif
}

// In the fast mode, one ray in some millions passes between two triangles, for a tenth less time:
// not allowed for rays that count the bodies around them.
bool has_volumes(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const SceneMaterial& each) { return each.factors.volumetric(); });
}

}  // namespace

Bvh::State::~State() {
  const std::shared_lock lock(building);
  if (top != nullptr) rtcReleaseScene(top);
  for (RTCScene each : shared) {
    if (each != nullptr) rtcReleaseScene(each);
  }
  if (device != nullptr) rtcReleaseDevice(device);
}

void Bvh::State::keep(std::unique_ptr<State> failed) {
  static constinit std::atomic<State*> kept{nullptr};
  State* const state = failed.release();
  state->kept_before = kept.exchange(state);
}

RTCScene Bvh::State::new_scene() const {
  RTCScene made = rtcNewScene(device);
  if (made != nullptr) {
    const unsigned robust = watertight_ ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE;
    rtcSetSceneFlags(made, static_cast<RTCSceneFlags>(robust));
    rtcSetSceneBuildQuality(made, quality_of(method_));
  }
  return made;
}

bool Bvh::State::attach(RTCScene target, RTCGeometry geometry, std::uint32_t number) const {
  rtcSetGeometryBuildQuality(geometry, quality_of(method_));
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(target, geometry, number);
  rtcReleaseGeometry(geometry);
  return rtcGetDeviceError(device) == RTC_ERROR_NONE;
}

std::span<const Float3> Bvh::State::add_points(RTCGeometry geometry, const Group& group,
                                               bool in_world) const {
  auto* const first = new_buffer<Float3>(geometry, RTC_BUFFER_TYPE_VERTEX, group.vertices);
  if (first == nullptr) return {};
  Float3* points = first;
  for (const Group::Part& part : group.parts) {
    const auto& positions = scene.meshes[part.mesh].positions;
    if (!in_world) {
      points = std::copy(positions.begin(), positions.end(), points);
      continue;
    }
    const Matrix34& to_world = scene.instances[part.instance].to_world;
    for (const Float3& p : positions) *points++ = to_float3(transform_point(to_world, to_vec(p)));
  }
  return {first, group.vertices};
}

bool Bvh::State::add_triangles(RTCGeometry geometry, const Group& group,
                               std::span<const Float3> points, bool may_repeat) const {
  const std::span<const Triangle> only(scene.meshes[group.parts.front().mesh].triangles);
  const bool single = group.parts.size() == 1;
  if (single && (may_repeat || find_repeats(only, points).empty())) {
    share_triangles(geometry, only);
    return true;
  }
  auto* const first = new_buffer<Triangle>(geometry, RTC_BUFFER_TYPE_INDEX, group.triangles);
  if (first == nullptr) return false;
  Triangle* triangle = first;
  std::uint32_t base = 0;
  for (const Group::Part& part : group.parts) {
    const Mesh& mesh = scene.meshes[part.mesh];
    for (const auto& t : mesh.triangles) *triangle++ = {t[0] + base, t[1] + base, t[2] + base};
    base += static_cast<std::uint32_t>(mesh.positions.size());
  }
  if (may_repeat) return true;
  // Embree ignores triangles whose indices are out of range.
  for (const std::uint32_t i : find_repeats({first, group.triangles}, points)) {
    first[i] = {kNone, kNone, kNone};
  }
  return true;
}

bool Bvh::State::add_groups(RTCScene target, const TreatedGroups& treated, bool in_world) const {
  for (std::uint32_t i = 0; i < kTreatments; ++i) {
    const Group& group = treated[i];
    if (group.triangles == 0) continue;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Each layer of triangles with alpha counts.
    const bool layered = static_cast<Treatment>(i) == Treatment::holed;
    const std::span<const Float3> points = add_points(geometry, group, in_world);
    if (points.empty() || !add_triangles(geometry, group, points, layered)) {
      rtcReleaseGeometry(geometry);
      return false;
    }
    set_filters(geometry, static_cast<Treatment>(i), in_world, in_world && group.mirrored);
    if (!attach(target, geometry, i)) return false;
  }
  return true;
}

bool Bvh::State::add_shared(const TreatedGroups& treated) {
  RTCScene own = new_scene();
  if (own == nullptr) return false;
  shared.push_back(own);
  if (!add_groups(own, treated, false)) return false;
  commit(own);
  return rtcGetDeviceError(device) == RTC_ERROR_NONE;
}

bool Bvh::State::add_instance(std::uint32_t index) {
  const Instance& instance = scene.instances[groups.instanced[index]];
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, shared[groups.shape[index]]);
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, instance.to_world.data());
  return attach(top, geometry, static_cast<std::uint32_t>(kTreatments + index));
}

bool Bvh::State::build() {
  const std::shared_lock lock(building);
  device = rtcNewDevice(GLTFX_TBB ? "set_affinity=0" : "set_affinity=0,threads=1");
  if (device == nullptr) return false;
  watertight_ = has_volumes(scene);
  top = new_scene();
  if (top == nullptr || !add_groups(top, groups.flat, true)) return false;
  for (const TreatedGroups& treated : groups.shared) {
    if (!add_shared(treated)) return false;
  }
  for (std::uint32_t i = 0; i < groups.instanced.size(); ++i) {
    if (!add_instance(i)) return false;
  }
  commit(top);
  return rtcGetDeviceError(device) == RTC_ERROR_NONE;
}

Hit Bvh::State::hit_of(const RTCHit& found) const {
  const bool instanced = found.instID[0] != RTC_INVALID_GEOMETRY_ID;
  const std::size_t index = instanced ? found.instID[0] - kTreatments : 0;
  const TreatedGroups& treated = instanced ? groups.shared[groups.shape[index]] : groups.flat;
  const auto& parts = treated[found.geomID].parts;
  const auto after = std::upper_bound(
      parts.begin(), parts.end(), std::size_t{found.primID},
      [](std::size_t number, const Group::Part& part) { return number < part.first; });
  const Group::Part& part = *(after - 1);
  Hit hit;
  hit.instance = instanced ? groups.instanced[index] : part.instance;
  hit.mesh = part.mesh;
  if (instanced) {  // another mesh may have the same triangles
    hit.mesh += scene.instances[hit.instance].mesh - groups.first[groups.shape[index]];
  }
  hit.triangle = found.primID - static_cast<std::uint32_t>(part.first);
  hit.u = found.u;
  hit.v = found.v;
  return hit;
}

}  // namespace gltfx::render

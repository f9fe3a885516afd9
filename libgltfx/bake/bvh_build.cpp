// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <vector>

#include <embree3/rtcore.h>

#include "bake/bvh.hpp"
#include "bake/bvh_state.hpp"
#include "bake/coverage.hpp"
#include "bake/storage.hpp"
#include "bake/stretch.hpp"
#include "base/parallel.hpp"

namespace gltfx::bake {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

Treatment treatment_of(const SceneMaterial& material) {
  if (has_holes(material)) return Treatment::holed;
  return is_culled(material) ? Treatment::culled : Treatment::solid;
}

// Null where there is no memory.
template <class T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, std::size_t count) {
  static_assert(sizeof(T) == 12);
  const bool vertices = type == RTC_BUFFER_TYPE_VERTEX;
  return static_cast<T*>(rtcSetNewGeometryBuffer(
      geometry, type, 0, vertices ? RTC_FORMAT_FLOAT3 : RTC_FORMAT_UINT3, sizeof(T), count));
}

// The scene outlives the hierarchy. Not for vertices, behind which Embree reads on.
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

void Bvh::State::group_instances() {
  constexpr std::size_t kMostFlattened = 1U << 20U;
  std::size_t flattened = 0;  // triangles
  std::vector<std::uint32_t> uses(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances) ++uses[instance.mesh];
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    facing.push_back(determinant(instance.to_world) < 0 ? -1 : 1);
    if (mesh.triangles.empty()) continue;
    triangles += mesh.triangles.size();
    const double stretch = uses[instance.mesh] > 1 ? stretch_into(instance.to_world) : 0;
    if (stretch > 0 && std::isfinite(stretch)) {
      instanced.push_back(i);
      farthest = std::min(farthest, kFarthest / stretch);
      continue;
    }
    // What is flattened lies in the world, as long as there is not too much of it.
    flattened += stretch > 0 ? mesh.triangles.size() : 0;
    if (flattened > kMostFlattened) continue;
    Group& group = groups[static_cast<std::size_t>(treatment_of(material_of(scene, mesh)))];
    group.instances.push_back(i);
    group.first.push_back(group.triangles);
    group.triangles += mesh.triangles.size();
    group.vertices += mesh.positions.size();
    group.mirrored = group.mirrored || facing.back() < 0;
  }
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
  const Instance& instance = scene.instances[instanced[index]];
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
  group_instances();
  for (std::size_t i = 0; i < kTreatments; ++i) {
    if (groups[i].triangles == 0) continue;
    if (!add_group(groups[i], static_cast<Treatment>(i))) return false;
  }
  shared.assign(scene.meshes.size(), nullptr);
  for (std::uint32_t i = 0; i < instanced.size(); ++i) {
    if (!add_instance(i)) return false;
  }
  commit(top);
  return rtcGetDeviceError(device) == RTC_ERROR_NONE;
}

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

}  // namespace gltfx::bake

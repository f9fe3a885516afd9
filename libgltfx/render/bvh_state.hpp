// SPDX-License-Identifier: Apache-2.0
/// The state of a hierarchy: Embree's scenes, and the data of its filters.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/bvh.hpp"
#include "render/bvh_groups.hpp"

// Handles of Embree, whose headers are included in source files only.
using RTCDevice = struct RTCDeviceTy*;
using RTCScene = struct RTCSceneTy*;
using RTCGeometry = struct RTCGeometryTy*;
struct RTCHit;

namespace gltfx::render {

struct Bvh::State {
  State(const Scene& s, BvhMethod method) : scene(s), groups(group_instances(s)), method_(method) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();

  /// False when there is not enough memory.
  bool build();
  /// Never frees a state whose build failed: Embree's threads may still use its memory.
  static void keep(std::unique_ptr<State> failed);
  /// All members except the distance.
  Hit hit_of(const RTCHit& found) const;

  const Scene& scene;
  const Groups groups;
  State* kept_before = nullptr;
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<RTCScene> shared;  // of each shared group

 private:
  /// Sets filter functions for triangles that do not stop every ray.
  static void set_filters(RTCGeometry geometry, Treatment treatment, bool in_world, bool mirrored);
  std::span<const Float3> add_points(RTCGeometry geometry, const Group& group, bool in_world) const;
  bool add_triangles(RTCGeometry geometry, const Group& group, std::span<const Float3> points,
                     bool may_repeat) const;
  bool add_groups(RTCScene target, const TreatedGroups& treated, bool in_world) const;
  bool add_shared(const TreatedGroups& treated);
  bool add_instance(std::uint32_t index);

  RTCScene new_scene() const;
  bool attach(RTCScene target, RTCGeometry geometry, std::uint32_t number) const;

  const BvhMethod method_;
  bool watertight_ = false;
};

}  // namespace gltfx::render

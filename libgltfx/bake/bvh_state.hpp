// SPDX-License-Identifier: Apache-2.0
/// What a hierarchy is made of: Embree's scenes, and what its filters ask.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bake/bvh.hpp"
#include "bake/bvh_groups.hpp"

// Handles of Embree, whose headers stay in source files.
using RTCDevice = struct RTCDeviceTy*;
using RTCScene = struct RTCSceneTy*;
using RTCGeometry = struct RTCGeometryTy*;

namespace gltfx::bake {

struct Bvh::State {
  explicit State(const Scene& s) : scene(s), groups(group_instances(s)) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State();

  /// False where there is not enough memory.
  bool build();
  /// Embree's threads still hold on to what a build that failed had allocated: it is never freed.
  static void keep(std::unique_ptr<State> failed);
  Hit hit_of(std::uint32_t inst, std::uint32_t geometry, std::uint32_t primitive) const;

  const Scene& scene;
  const Groups groups;
  State* kept_before = nullptr;
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<RTCScene> shared;  // of each shared group

 private:
  /// Tells Embree to ask about triangles that are not simply there.
  static void set_filters(RTCGeometry geometry, Treatment treatment, bool in_world, bool mirrored);
  std::span<const Float3> add_points(RTCGeometry geometry, const Group& group, bool in_world) const;
  bool add_triangles(RTCGeometry geometry, const Group& group, std::span<const Float3> points,
                     bool may_repeat) const;
  bool add_groups(RTCScene target, const TreatedGroups& treated, bool in_world) const;
  bool add_shared(const TreatedGroups& treated);
  bool add_instance(std::uint32_t index);

  bool watertight_ = false;
};

}  // namespace gltfx::bake

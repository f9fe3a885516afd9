// SPDX-License-Identifier: Apache-2.0
/// What a Bvh holds: for those who build it and those who send rays into it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <embree3/rtcore.h>

#include "bake/bvh.hpp"
#include "bake/stretch.hpp"

namespace gltfx::bake {

/// How rays treat triangles, which is one Embree geometry each: what needs no questions is asked
/// none.
enum class Treatment : std::uint8_t { solid, culled, holed };
constexpr std::size_t kTreatments = 3;

/// Triangles of meshes that stand in the scene once, in world space, and whose they are. A mesh of
/// many instances is a group of its own, in its own space.
struct Group {
  std::vector<std::uint32_t> instances;  ///< in order
  std::vector<std::size_t> first;        ///< triangle of each
  std::size_t triangles = 0, vertices = 0;
  bool mirrored = false;  ///< one of them, at least
};

struct Bvh::State {
  explicit State(const Scene& s) : scene(s) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (top != nullptr) rtcReleaseScene(top);
    for (RTCScene each : shared) {
      if (each != nullptr) rtcReleaseScene(each);
    }
    if (device != nullptr) rtcReleaseDevice(device);
  }

  // bvh_build.cpp; false: there is not enough memory
  bool build();
  static void keep(std::unique_ptr<State> failed);
  void group_instances();
  bool add_points(RTCGeometry geometry, const Group& group) const;
  bool add_triangles(RTCGeometry geometry, const Group& group) const;
  bool add_group(const Group& group, Treatment treatment);
  bool add_shared_mesh(std::uint32_t mesh);
  bool add_instance(std::uint32_t instance);
  static void set_filters(RTCGeometry geometry, Treatment treatment, bool mirrored);

  // bvh.cpp
  Hit hit_of(std::uint32_t inst, std::uint32_t geometry, std::uint32_t primitive) const;
  float coverage(const RTCFilterFunctionNArguments* args, Hit& hit) const;
  bool is_traceable(const Ray& ray) const;  // numbers, and not too large for Embree
  bool offers_front(const RTCFilterFunctionNArguments* args, const Hit& hit) const;
  std::optional<Hit> intersect(Tracing& tracing, const Ray& ray) const;
  static void filter_closest(const RTCFilterFunctionNArguments* args);
  static void filter_any(const RTCFilterFunctionNArguments* args);
  static void filter_backs(const RTCFilterFunctionNArguments* args);

  const Scene& scene;
  State* kept_before = nullptr;
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<RTCScene> shared;           // by mesh; null where not shared
  std::array<Group, kTreatments> groups;  // geometry 0, 1, 2 of `top`
  std::vector<std::uint32_t> instanced;   // instance of geometry kTreatments + i
  std::vector<int> facing;                // by instance: -1 where the transform mirrors
  std::size_t triangles = 0;
  bool watertight = false;
  double farthest = kFarthest;  // from where a ray may come
};

/// What the filters know of the ray. Embree hands back its own part, which is the first one.
struct Bvh::Tracing {
  Tracing(const State& s, std::uint32_t k) : state(&s), key(k) { rtcInitIntersectContext(&embree); }
  RTCIntersectContext embree;
  const State* state;
  std::uint32_t key;
  bool every_layer = false;  // whatever covers anything counts
  float visibility = 1;
};

}  // namespace gltfx::bake

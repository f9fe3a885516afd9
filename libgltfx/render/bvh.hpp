// SPDX-License-Identifier: Apache-2.0
/// Intersection of rays: Embree's bounding volume hierarchy over the instances of a scene.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "base/result.hpp"
#include "render/ray.hpp"
#include "render/scene.hpp"
#include "render/wall.hpp"

namespace gltfx::render {

/// Whether a ray hits the backs of walls (wall.hpp). No ray hits the back of a surface that is
/// single-sided and clear.
enum class Backs : std::uint8_t {
  culled,  ///< no: camera rays
  solid    ///< yes: all later rays
};

/// How the triangles of a hierarchy are grouped.
enum class BvhMethod : std::uint8_t {
  sah,    ///< by the surface area heuristic: rays take the least time
  morton  ///< along a Morton curve: built in a fifth of the time, for pictures of few samples
};

/// Immutable once built; any number of threads may trace. Rays pass triangles that are culled or
/// cut out by alpha. The same scene gives the same hits on any number of threads.
class Bvh {
 public:
  /// `scene` must outlive the result. An Error when there is not enough memory.
  static Result<Bvh> build(const Scene& scene, BvhMethod method = BvhMethod::sah);

  /// The first surface along the ray. `key` decides, surface by surface, whether a ray passes
  /// through partial alpha coverage.
  std::optional<Hit> intersect(const Ray& ray, std::uint32_t key,
                               Backs backs = Backs::culled) const;

  /// The first surface with any coverage above 0.
  std::optional<Hit> first_layer(const Ray& ray) const;
  /// The same for 1 to kCameraPacket rays: saves time where they are close together.
  void first_layers(std::span<const Ray> rays, std::span<std::optional<Hit>> hits) const;
  static constexpr unsigned kCameraPacket = 8;
  /// The part of a ray that a surface stops: above 0 for a hit of first_layer().
  float coverage(const Hit& hit) const;

  /// The fraction of light from the end of the ray that reaches its start: 0 behind a surface. See
  /// lets_light_in() for `eye`.
  float visibility(const Ray& ray, const std::optional<Eye>& eye = std::nullopt) const;
  /// The same for 1 to kShadowPacket rays in any directions.
  void find_visibility(std::span<const Ray> rays, const std::optional<Eye>& eye,
                       std::span<float> visible) const;
  static constexpr unsigned kShadowPacket = 4;
  /// The same, by colour, for a lamp that no path can hit: includes light straight through thin
  /// smooth walls, single-sided or not.
  Rgb transmittance(const Ray& ray, const std::optional<Eye>& eye) const;

  /// As the function lets_light_in() in wall.hpp, but never for the surface of a closed body.
  bool lets_light_in(const Hit& hit, const Vec3d& direction, const std::optional<Eye>& eye) const;

  /// Triangles of all instances.
  std::size_t triangles() const;

  Bvh(Bvh&&) noexcept;
  Bvh& operator=(Bvh&&) noexcept;
  ~Bvh();

 private:
  struct State;
  struct Tracing;
  explicit Bvh(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace gltfx::render

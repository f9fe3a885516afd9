// SPDX-License-Identifier: Apache-2.0
/// What a ray hits: Embree's bounding volume hierarchy over the instances of a scene.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "bake/ray.hpp"
#include "bake/scene.hpp"
#include "bake/wall.hpp"
#include "base/result.hpp"

namespace gltfx::bake {

/// What a ray makes of the backs of walls (wall.hpp). Surfaces that are single-sided and clear are
/// not there from behind for any ray.
enum class Backs : std::uint8_t {
  culled,  ///< not there: rays of the camera
  solid    ///< there: rays along which light is gathered
};

/// Immutable once built; any number of threads may trace. Triangles that are culled or cut out by
/// alpha are not there for the rays that pass them. The same scene gives the same answers on any
/// number of threads.
class Bvh {
 public:
  /// `scene` must outlive the result. An Error when there is not enough memory.
  static Result<Bvh> build(const Scene& scene);

  /// The first surface along the ray. `key` decides, surface by surface, whether a ray passes
  /// through what is partly transparent by alpha.
  std::optional<Hit> intersect(const Ray& ray, std::uint32_t key,
                               Backs backs = Backs::culled) const;

  /// The first surface that covers anything at all, however little.
  std::optional<Hit> first_layer(const Ray& ray) const;
  /// What part of a ray that surface stops: above 0 for what was hit.
  float coverage(const Hit& hit) const;

  /// What part of light comes from the end of the ray to its start: 0 when a surface stops it. See
  /// lets_light_in() for `eye`.
  float visibility(const Ray& ray, const std::optional<Eye>& eye = std::nullopt) const;

  /// As the function of that name, but not through a body, out of which no light comes.
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

}  // namespace gltfx::bake

// SPDX-License-Identifier: Apache-2.0
/// What a ray hits: Embree's bounding volume hierarchy over the instances of a scene.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "bake/ray.hpp"
#include "bake/scene.hpp"
#include "base/result.hpp"

namespace gltfx::bake {

/// Immutable once built; any number of threads may trace. Triangles that are culled or cut out by
/// alpha are not there for the rays that pass them. The same scene gives the same answers on any
/// number of threads.
class Bvh {
 public:
  /// `scene` must outlive the result. An Error when there is not enough memory.
  static Result<Bvh> build(const Scene& scene);

  /// The first surface along the ray. `key` decides, surface by surface, whether a ray passes
  /// through what is partly transparent by alpha.
  std::optional<Hit> intersect(const Ray& ray, std::uint32_t key) const;

  /// The first surface that covers anything at all, however little.
  std::optional<Hit> first_layer(const Ray& ray) const;
  /// What part of a ray that surface stops: above 0 for what was hit.
  float coverage(const Hit& hit) const;

  /// What part of light comes through to the end of the ray past surfaces: 0 when one is solid.
  float visibility(const Ray& ray) const;

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

// SPDX-License-Identifier: Apache-2.0
/// A material seen from one direction. What does not depend on the light is worked out once, so
/// one object serves all light samples and the continuation of a path at a hit.
#pragma once

#include <gltfx/material.hpp>

#include <optional>

namespace gltfx::bake {

/// Value and density of one direction, as multiple importance sampling needs them together.
struct Evaluation {
  Rgb f;           ///< without the cosine; no delta lobes
  double pdf = 0;  ///< per steradian, of Bsdf::sample()
};

/// Frame, units and options as in <gltfx/material.hpp>. Keeps no reference to the material. Not of
/// use for unlit materials: they only emit.
class Bsdf {
 public:
  Bsdf(const Material& material, const Vec3d& v, const ShaderOptions& options = {});

  Evaluation evaluate(const Vec3d& l) const;
  std::optional<MaterialSample> sample(const Random3& random) const;
  /// Whether all lobes are mirrors or ideal refractions, so that evaluate() gives 0 everywhere.
  bool is_delta() const;
  /// Whether some light gets to the other side.
  bool transmits() const;
};

}  // namespace gltfx::bake

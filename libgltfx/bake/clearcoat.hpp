// SPDX-License-Identifier: Apache-2.0
/// The layer of KHR_materials_clearcoat: specular_brdf about a normal of its own.
#pragma once

#include "bake/lobes.hpp"

namespace gltfx::bake {

/// A turned frame; of no effect when its normal is +z.
struct CoatFrame {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  CoatFrame() = default;
  /// The tangent is as near to +x as possible.
  explicit CoatFrame(const Vec3d& normal);
  Vec3d into(const Vec3d& w) const { return {dot(w, x), dot(w, y), dot(w, z)}; }
  Vec3d out_of(const Vec3d& w) const { return w.x * x + w.y * y + w.z * z; }
};

/// A coat as it is seen from v.
struct SeenCoat {
  CoatFrame frame;
  Vec3d v;  ///< in that frame; below its horizon nothing is reflected
  SeenFacets facets;

  SeenCoat(const Vec3d& normal, double roughness, const Vec3d& viewer)
      : frame(normal), v(frame.into(viewer)), facets(microfacets(roughness), v) {}
};

/// clearcoat_brdf = specular_brdf(normal, alpha). Values are those of a BRDF about +z: they
/// include the cosine to the normal of the coat over that to +z.
struct clearcoat_brdf : Lobe {
  static constexpr int kKinds = kSpecularReflect;
  const SeenCoat& coat;
  specular_brdf brdf;

  /// Keeps a reference to the coat.
  explicit clearcoat_brdf(const SeenCoat& c)
      : Lobe{1, c.facets.smooth()}, coat(c), brdf(c.facets) {}
  Directions in_frame(const Directions& d) const {
    Directions turned(coat.v, coat.frame.into(d.l), d.measure, d.lobes);
    turned.opposite = turned.opposite || d.opposite || coat.v.z <= 0;
    return turned;
  }
  Rgb eval(const Directions& d, const Through& through) const {
    if (d.l.z <= 0) return {};
    const Directions turned = in_frame(d);
    return brdf.eval(turned, through) * (turned.l.z / d.l.z);
  }
  double pdf(const Directions& d) const { return brdf.pdf(in_frame(d)); }
  Proposal sample(const Vec3d&, const Random3& r) const {
    if (coat.v.z <= 0) return {{}, Measure::solid_angle, false};
    Proposal p = brdf.sample(coat.v, r);
    p.l = coat.frame.out_of(p.l);
    p.valid = p.valid && p.l.z > 0;
    return p;
  }
};

}  // namespace gltfx::bake

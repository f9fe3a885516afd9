// SPDX-License-Identifier: Apache-2.0
/// Energy conservation of layered materials, and the albedo scaling of sheen.
///
/// The sample implementation weights diffuse light by 1 - F(V.H), averaged over all lights. At
/// grazing angles that is far more than a smooth layer transmits. The conserving mode scales the
/// diffuse light by s(V) s(L) / m. Here s is the transmittance of the layer over that of the
/// sample implementation, 1 at most, and m is the mean of s over the lights of a grazing view,
/// which is the highest of all views. The result is reciprocal, never gains, and keeps the albedo
/// of the sample implementation where that conserves energy. (The form is that of C. Kulla and A.
/// Conty, Revisiting Physically Based Shading at Imageworks, 2017.)
#pragma once

#include "shader/albedo.hpp"
#include "shader/fresnel.hpp"
#include "shader/microfacet.hpp"

namespace gltfx::shader {

/// The factor for the diffuse lobes below an interface.
class EnergyCompensation {
 public:
  /// No compensation.
  EnergyCompensation() = default;
  EnergyCompensation(const Fresnel& fresnel, const Microfacets& facets, const Vec3d& v);

  /// `cosine`: of the light.
  double factor(double n_l) const;

  /// For rough diffuse lobes: they reflect more light back to its source, where an interface
  /// transmits more. In a furnace test the difference is 2 % at most.
  void calm(double diffuse_roughness) { scale_ *= 1 - 0.021 * diffuse_roughness * f90_; }

 private:
  /// The transmittance over that of the sample implementation, 1 at most, under a cosine.
  double share(double cosine) const;
  /// `diffuse`: diffuse_fresnel(); `margin`: of the albedos.
  double share(const SpecularAlbedo& along, const SpecularAlbedo& across, double diffuse,
               double margin) const;
  /// The mean of shares over the lights of a grazing view.
  double mean_share() const;

  bool active_ = false;
  bool inside_ = false;
  double share_v_ = 1;
  bool isotropic_ = true;
  SpecularCurve along_, across_;
  double highest_f0_ = 0, lowest_f0_ = 0;  ///< curves of Schlick around the Fresnel term
  double f90_ = 1;
  double scale_ = 1;
};

/// The compensation below the dielectric interface of a material: none in spec mode, or without
/// diffuse lobes.
inline EnergyCompensation held_below(const Fresnel& fresnel, const Microfacets& facets,
                                     const Vec3d& v, const Material& material, ShaderMode mode) {
  const bool scatters = material.scattering == Scattering::unified && !material.volumetric();
  const bool diffuse = material.metallic < 1 && (material.transmission < 1 || scatters);
  if (mode != ShaderMode::conserving || !diffuse) return {};
  EnergyCompensation held(fresnel, facets, v);
  held.calm(material.diffuse_roughness);
  return held;
}

/// Weights of a sheen and of the layers below it.
struct SheenScaling {
  double strength = 0;  ///< of the sheen: its strongest colour
  double roughness = 0;
  SheenCurve curve;
  double albedo_v = 0;  ///< of a white sheen towards the viewer
  bool conserving = false;

  struct Weights {
    double sheen, base;
  };

  SheenScaling(const Rgb& color, double sheen_roughness, const Vec3d& v, ShaderMode mode);
  /// `cosine`: of the light.
  Weights weights(double n_l) const;
};

}  // namespace gltfx::shader

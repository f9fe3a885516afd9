// SPDX-License-Identifier: Apache-2.0
/// Light that bounces between facets more than once, which Appendix B leaves out.
///
/// A lobe whose facets reflect all light is scaled by s(V) s(L), where s is the function that makes
/// its albedo 1 towards each view. The scale depends on one direction in E. Turquin's form
/// (Practical Multiple Scattering Compensation for Microfacet Models, 2019); this one is
/// reciprocal, and as there, the lobe keeps about its shape and its sampling. s exists and is
/// unique, and iteration finds it, because the lobe is a symmetric positive kernel (R. Sinkhorn, A
/// Relationship Between Arbitrary Positive Matrices and Doubly Stochastic Matrices, 1964). A lobe
/// of thin glass is its mirror image and has the same scale. For a surface that refracts no such s
/// is near 1, as light from all sides comes out of a narrow cone inside: there the scale is
/// Turquin's, over the albedo towards V.
///
/// The light that the scale adds has met facets at least twice, and so has more of their colour (C.
/// Kulla and A. Conty, Revisiting Physically Based Shading at Imageworks, 2017).
#pragma once

#include <memory>

#include "shader/albedo.hpp"
#include "shader/anisotropic.hpp"
#include "shader/fresnel.hpp"
#include "shader/microfacet.hpp"

namespace gltfx::shader {

/// The table of refracting surfaces: by root of F0, roughness and cosine, outside and inside.
inline constexpr int kGlassIors = 10;
inline constexpr int kGlassRows = 12;
inline constexpr int kGlassColumns = 16;

/// The ratio of indices of a row: from 1 to 3.
constexpr double glass_ior(int row) {
  const double root = row / (kGlassIors - 1.0);
  const double r = 0.5 * root * root;
  return (1 + r) / (1 - r);
}

/// The scale of the specular lobes of facets, prepared from v.
class MultipleScattering {
 public:
  /// Of a lobe that needs none.
  MultipleScattering() = default;
  MultipleScattering(const Microfacets& facets, const Vec3d& v);
  /// Of an interface between a volume and what is around it.
  MultipleScattering(const Fresnel& fresnel, const Microfacets& facets, const Vec3d& v);

  bool active() const { return kind_ != Kind::none; }
  /// `l`: on the viewer's side, or mirrored to it.
  double scale(const Vec3d& l) const {
    switch (kind_) {
      case Kind::none:
        return 1;
      case Kind::isotropic:
        return scale_v_ * curve_.scale(l.z);
      case Kind::anisotropic:
        return scale_v_ * anisotropic_->at(l);
      default:
        return scale_v_;
    }
  }
  /// The part of the light that the scale adds, for facets of a mean reflectance: their colour once
  /// or more often, beside the colour that the lobe has.
  Rgb tint(const Rgb& mean_reflectance) const {
    const Rgb once = mean_reflectance * mean_albedo_;
    return once / (Rgb(1) - mean_reflectance * (1 - mean_albedo_));
  }

 private:
  enum class Kind : std::uint8_t { none, isotropic, anisotropic, refracting };

  Kind kind_ = Kind::none;
  double scale_v_ = 1;
  double mean_albedo_ = 1;
  SpecularCurve curve_;
  std::unique_ptr<const AnisotropicScale> anisotropic_;  // large, and few surfaces have one
};

/// The mean of Schlick's curve, or of a film's, over a hemisphere.
Rgb mean_reflectance(const Fresnel& fresnel);

}  // namespace gltfx::shader

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

#include <array>
#include <memory>

#include "shader/albedo.hpp"
#include "shader/fresnel.hpp"
#include "shader/microfacet.hpp"

namespace gltfx::shader {

/// The tables of anisotropic lobes: roughness along, roughness across over that, where the
/// roughness under the azimuth is between both, and the cosine.
inline constexpr int kAlongRows = 14;
inline constexpr int kAcrossRows = 9;
inline constexpr int kAzimuthRows = 7;
inline constexpr int kScaleColumns = 16;
/// The table of refracting surfaces: by root of F0, roughness and cosine, outside and inside.
inline constexpr int kGlassIors = 10;
inline constexpr int kGlassRows = 12;
inline constexpr int kGlassColumns = 16;

/// The roughness along the direction of anisotropy of a row: close together where lobes are narrow.
inline double along_roughness(int row) {
  const double x = row / (kAlongRows - 1.0);
  return x * std::cbrt(x);
}
inline double along_row(double roughness) { return std::sqrt(roughness * std::sqrt(roughness)); }

/// The roughness across of a row over that along, and the part of the way from across to along of a
/// row of azimuths: close together across, where a lobe is narrow.
inline double across_ratio(int row) { return square(row / (kAcrossRows - 1.0)); }
inline double azimuth_part(int row) { return square(row / (kAzimuthRows - 1.0)); }
inline TableCell azimuth_row(double azimuth) { return {std::sqrt(azimuth), kAzimuthRows}; }

/// The ratio of indices of a row: from 1 to 3.
constexpr double glass_ior(int row) {
  const double root = row / (kGlassIors - 1.0);
  const double r = 0.5 * root * root;
  return (1 + r) / (1 - r);
}

inline TableCell scale_column(double cosine) {
  return {std::sqrt(std::sqrt(static_cast<float>(cosine))), kScaleColumns};
}

/// From 0 across to 1 along: the roughness under the azimuth of a direction.
double azimuth_of(const Microfacets& facets, const Vec3d& direction);

/// Values of one anisotropic lobe: by azimuth_of() and cosine.
using AnisotropicValues = std::array<std::array<float, kScaleColumns>, kAzimuthRows>;

/// s for one anisotropic lobe.
class AnisotropicScale {
 public:
  /// The precondition is that alpha_t is at least alpha_b.
  explicit AnisotropicScale(const Microfacets& facets);
  double at(const Vec3d& direction) const;
  double mean_albedo() const { return mean_; }

 private:
  Microfacets facets_;
  AnisotropicValues values_{};
  double mean_ = 0;
};

/// The albedo of one anisotropic lobe.
class AnisotropicAlbedo {
 public:
  /// The precondition is that alpha_t is at least alpha_b.
  explicit AnisotropicAlbedo(const Microfacets& facets);
  SpecularAlbedo at(const Vec3d& direction) const;
  /// `azimuth`: as azimuth_of().
  SpecularAlbedo at(double azimuth, double cosine) const;
  const Microfacets& facets() const { return facets_; }

 private:
  Microfacets facets_;
  AnisotropicValues constant_{}, rising_{};
};

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

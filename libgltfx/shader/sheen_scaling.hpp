// SPDX-License-Identifier: Apache-2.0
/// Weights of a sheen and of the layers below it.
///
/// What the sheen leaves over is a(V) towards one direction. The text gives the base the lesser of
/// a(V) and a(L), which loses light that the sheen does not reflect. The conserving mode gives a
/// base g(V) g(L), with g = a / sqrt(m). Below a diffuse base m is the mean of a over the
/// hemisphere. Gloss of each roughness has a function m of its own, for which all light comes back:
/// that of a mirror is a itself, that of dull metal nearly the mean. It is found as in
/// shader/multiple_scattering.hpp.
///
/// Fibres that are nearly upright reflect more light towards the horizon than arrives, by the text.
/// The conserving mode scales them by c(V) c(L), which lets them reflect all of it.
#pragma once

#include "shader/albedo.hpp"
#include "shader/microfacet.hpp"

namespace gltfx::shader {

/// Tables of the conserving mode. Rows of the sheen are by the logarithm of its roughness, from
/// that below which all look alike; columns by the fourth root of the cosine.
inline constexpr int kHeldSheenRows = 24;
/// Of what is below: rows of the sheen, rows of the base by the root of roughness, strengths,
/// columns.
inline constexpr int kBelowSheenRows = 12;
inline constexpr int kBelowBaseRows = 10;
inline constexpr int kBelowStrengths = 2;  ///< 1/2 and 1; without a sheen all is 1
inline constexpr int kBelowColumns = 24;

inline double held_sheen_roughness(int row, int rows) {
  return std::pow(kLeastSheenRoughness, 1 - row / (rows - 1.0));
}
inline TableCell held_sheen_row(double roughness, int rows) {
  const double place =
      1 - std::log(std::fmax(roughness, kLeastSheenRoughness)) / std::log(kLeastSheenRoughness);
  return {place, rows};
}
/// `alpha`: of the base.
inline TableCell below_base_row(double alpha) {
  return {std::sqrt(std::sqrt(alpha)), kBelowBaseRows};
}
inline double below_base_roughness(int row) { return square(row / (kBelowBaseRows - 1.0)); }
inline TableCell below_column(double cosine) { return cosine_column(cosine, kBelowColumns); }

/// A white sheen of one roughness in the conserving mode.
class HeldSheen {
 public:
  HeldSheen() = default;
  explicit HeldSheen(double roughness) : row_(held_sheen_row(roughness, kHeldSheenRows)) {}
  /// c, and the albedo with it.
  double scale(double cosine) const;
  double albedo(double cosine) const;
  /// The mean of the albedo over a hemisphere.
  double mean() const;

 private:
  TableCell row_;
};

class SheenScaling {
 public:
  struct Weights {
    double sheen, diffuse, specular;  ///< the latter of lobes below
  };

  SheenScaling(const Material& material, const Vec3d& v, ShaderMode mode);
  Weights weights(const Vec3d& l) const;
  /// Of the sheen: its strongest colour.
  double strength() const { return strength_; }
  /// Towards the viewer, of a white sheen.
  double albedo() const { return albedo_v_; }

 private:
  /// What is left over for the base, and for gloss of it.
  double left(double albedo) const;
  double left_for_diffuse(double left, double cosine) const;
  double left_for_gloss(double left, const Vec3d& direction) const;

  double strength_ = 0;
  bool conserving_ = false;
  SheenCurve curve_;                ///< of the text
  HeldSheen held_;                  ///< of the conserving mode
  TableCell below_;                 ///< its row in the table of what is below
  Microfacets facets_;              ///< of the base
  double grazing_ = 0, front_ = 0;  ///< more and less of its rough diffuse light
  double albedo_v_ = 0;
  double scale_v_ = 1, diffuse_v_ = 1, gloss_v_ = 1;
};

}  // namespace gltfx::shader

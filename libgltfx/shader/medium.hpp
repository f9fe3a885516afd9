// SPDX-License-Identifier: Apache-2.0
/// Homogeneous media: KHR_materials_volume, KHR_materials_sss, KHR_materials_subsurface,
/// KHR_materials_volume_scatter, KHR_materials_scatter. Coefficients are per metre. A path may be
/// in several, nested inside each other.
#pragma once

#include <gltfx/material.hpp>

#include <cstdint>
#include <vector>

#include "base/packed.hpp"

namespace gltfx::shader {

struct Medium {
  Rgb absorption, scattering;
  double anisotropy = 0;  ///< g of the phase function

  Rgb extinction() const { return absorption + scattering; }
  bool scatters() const { return max_value(scattering) > 0; }
  /// Whether the extinction of all colours is equal.
  bool is_grey() const {
    const Rgb all = extinction();
    return all.x == all.y && all.y == all.z;
  }
  /// The fraction of light that is neither absorbed nor scattered over `distance` metres, which may
  /// be infinite.
  Rgb transmittance(double distance) const;
};

/// The medium behind the surface of a volumetric material.
Medium medium_of(const Material& material);

/// -log(c) / d: absorption and extinction by attenuation, scattering by scatter colour. 0 when the
/// distance is infinite.
Rgb coefficient(const Rgb& color, double distance);

/// The albedo of one scattering event for that of very many, by C. Kulla and A. Conty (Revisiting
/// Physically Based Shading at Imageworks, 2017); with the anisotropy g as in KHR_materials_scatter
/// (0: as in KHR_materials_volume_scatter and KHR_materials_sss).
double single_scatter_albedo(double multi_scatter_albedo, double g = 0);

/// The phase function of L. Henyey and J. Greenstein (1941), per steradian. Both directions point
/// away from the scattering point: v.l is -1 straight ahead.
double henyey_greenstein(double g, double v_dot_l);

/// The next direction of a path that came along `along` (-v). Its density is the phase function.
Vec3d sample_phase(const Medium& medium, const Vec3d& along, double u, double v);

/// A path enters and leaves closed meshes, each known by its Hit::body(). A medium that is nested
/// too deeply counts as the medium around it.
class MediaStack {
 public:
  bool empty() const { return entries_.empty(); }
  /// Precondition: not empty.
  const Medium& top() const { return entries_.back().medium; }

  void enter(const Material& material, std::uint64_t body);
  void leave(std::uint64_t body);
  /// The medium outside of a surface of the body; null in the open. Valid until the next
  /// change.
  const Medium* around(std::uint64_t body) const;
  /// The index of refraction of that medium.
  double ior_around(std::uint64_t body) const;

 private:
  struct Entry {
    Medium medium;
    double ior = 1;
    std::uint64_t body = 0;
  };
  const Entry* entry_around(std::uint64_t body) const;

  std::vector<Entry> entries_;  // most paths never have one
};

/// The distance after which a path is scattered, if no surface comes first; infinite if nothing
/// scatters. The throughput of the path chooses the colour whose extinction is used.
double sample_distance(const Medium& medium, const Rgb& throughput, const Float2& random);

/// The factor of the throughput of a path after `distance` metres, to a scattering point or to a
/// surface. The colours are combined by multiple importance sampling.
Rgb distance_weight(const Medium& medium, const Rgb& throughput, double distance, bool scattered);

}  // namespace gltfx::shader

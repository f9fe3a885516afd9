// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "cases.hpp"

namespace gltfx::ground_truth {
namespace {

void read_volume(Inputs& in, Material& m) {
  m.thickness = in.number("thickness", m.thickness);
  m.attenuation_color = in.color("attenuationColor", m.attenuation_color);
  m.attenuation_distance = in.number("attenuationDistance", m.attenuation_distance);
  m.dispersion = in.number("dispersion", m.dispersion);
  if (in.has("scatterStrength") || in.has("multiscatterColor")) {
    m.scattering = Scattering::unified;
    m.scatter_color = in.color("multiscatterColor", Rgb(1));
    m.scatter_strength = in.number("scatterStrength", 0);
    m.scatter_anisotropy = in.number("scatterAnisotropy", 0);
  }
}

void read_layers(Inputs& in, Material& m) {
  m.sheen_color = in.color("sheenColor", m.sheen_color);
  m.sheen_roughness = in.number("sheenRoughness", m.sheen_roughness);
  m.clearcoat = in.number("clearcoat", m.clearcoat);
  m.clearcoat_roughness = in.number("clearcoatRoughness", m.clearcoat_roughness);
  m.anisotropy = in.number("anisotropy", m.anisotropy);
  m.anisotropy_rotation = in.number("anisotropyRotation", m.anisotropy_rotation);
  m.iridescence = in.number("iridescence", m.iridescence);
  m.iridescence_ior = in.number("iridescenceIor", m.iridescence_ior);
  m.iridescence_thickness = in.number("iridescenceThickness", m.iridescence_thickness);
}

}  // namespace

Material read_properties(Inputs& in) {
  Material m;
  m.base_color = in.color("baseColor", m.base_color);
  m.metallic = in.number("metallic", 0);
  m.roughness = in.number("roughness", m.roughness);
  m.emissive = in.color("emissive", m.emissive) * in.number("emissiveStrength", 1);
  m.ior = in.number("ior", m.ior);
  m.specular = in.number("specular", m.specular);
  m.specular_color = in.color("specularColor", m.specular_color);
  m.transmission = in.number("transmission", m.transmission);
  m.diffuse_transmission = in.number("dt", m.diffuse_transmission);
  m.diffuse_transmission_color = in.color("dtColor", m.diffuse_transmission_color);
  m.unlit = in.number("unlit", 0) != 0;
  read_volume(in, m);
  read_layers(in, m);
  in.ignore("doubleSided");  // both sides are checked anyway
  return m;
}

Material read_material(Inputs& inputs) {
  Inputs inner = inputs.object("material");
  const Material material = read_properties(inner);
  inputs.absorb(inner);
  return material;
}

Vec3d direction(const std::vector<double>& angles) {
  constexpr double kDegree = std::numbers::pi / 180;
  const double theta = angles.empty() ? 0 : angles[0] * kDegree;
  const double phi = angles.size() < 2 ? 0 : angles[1] * kDegree;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Vec3d direction_of_cosine(double cosine) {
  return {std::sqrt(std::fmax(0.0, 1 - cosine * cosine)), 0, cosine};
}

}  // namespace gltfx::ground_truth

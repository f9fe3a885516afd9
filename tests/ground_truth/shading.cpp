// SPDX-License-Identifier: Apache-2.0
#include "cases.hpp"
#include "shader/fresnel.hpp"

namespace gltfx::ground_truth {
namespace {

constexpr int kResolution = 256;

// An IOR with that F0 against air.
double ior_of(double f0) { return f0 < 1 ? (1 + std::sqrt(f0)) / (1 - std::sqrt(f0)) : 0; }

// A surface that reflects like Schlick's curve and hands on the rest: everything, or to one lobe.
Material white(double roughness) {
  Material m;
  m.roughness = roughness;
  return m;
}

Rgb specular_albedo(double f0, double roughness, const Vec3d& v) {
  Material metal = white(roughness);
  metal.base_color = Rgb(f0);
  return integrate(metal, v, kSpec, kResolution).specular_reflect;
}

Rgb thin_wall_albedo(double f0, double roughness, const Vec3d& v) {
  Material glass = white(roughness);
  glass.metallic = 0;
  glass.transmission = 1;
  glass.ior = ior_of(f0);
  return integrate(glass, v, kSpec, kResolution).specular_transmit;
}

Rgb diffuse_albedo(double f0, const Vec3d& v) {
  Material paper = white(1);
  paper.metallic = 0;
  paper.ior = ior_of(f0);
  return integrate(paper, v, kSpec, kResolution).diffuse_reflect;
}

}  // namespace

Value evaluate_bsdf(Inputs& inputs, const Value& expected) {
  const Material material = read_material(inputs);
  const Vec3d v = direction(inputs.numbers("V", {0, 0}));
  const Vec3d l = direction(inputs.numbers("L", {0, 0}));
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (key == "f") return evaluate(material, v, l, kSpec);
    if (key == "pdf") return pdf(material, v, l, kSpec);
    return {};
  });
}

Value directional_albedo(Inputs& inputs, const Value& expected) {
  const double r = inputs.number("roughness", 1);
  const Vec3d v = direction_of_cosine(inputs.number("NdotV", 1));
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (key == "B") return specular_albedo(0, r, v);
    if (key == "A") return specular_albedo(1, r, v) - specular_albedo(0, r, v);
    if (const auto f0 = f0_in(key, "E_f0_")) return specular_albedo(*f0, r, v);
    if (key == "thin_btdf_A") return thin_wall_albedo(0, r, v);
    if (const auto f0 = f0_in(key, "thin_btdf_1mF_f0_")) return thin_wall_albedo(*f0, r, v);
    if (key == "C") return Rgb(1) - diffuse_albedo(0, v);
    if (const auto f0 = f0_in(key, "Kd_f0_")) return diffuse_albedo(*f0, v);
    return {};
  });
}

Value backlit_plane(Inputs& inputs, const Value& expected) {
  const Material material = read_material(inputs);
  const Vec3d v = direction(inputs.numbers("V", {0, 0}));
  Inputs light = inputs.object("light");
  light.ignore("type");
  const double lux = light.number("lux", 1);
  const double theta = light.number("theta_behind_deg", 0);
  const Vec3d l = direction({180 - theta, light.number("phi_deg", 0)});
  inputs.absorb(light);
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (key == "radiance") return evaluate(material, v, l, kSpec) * (lux * -l.z);
    if (key == "fresnel") {
      const shader::Directions d(v, l);
      return shader::dielectric_fresnel(material, 1, ShaderMode::spec).at(d.v_h).x;
    }
    return {};
  });
}

Value symmetric_lights(Inputs& inputs, const Value& expected) {
  const Material material = read_material(inputs);
  inputs.ignore("lights");
  const Vec3d v = direction(inputs.numbers("V", {0, 0}));
  const double lux = inputs.number("E", 1);
  const Vec3d front = direction({inputs.number("theta", 0), inputs.number("phi", 0)});
  const Vec3d back = shader::mirrored(front);
  const auto radiance = [&](const Vec3d& viewer, const Vec3d& l) {
    return evaluate(material, viewer, l, kSpec) * (lux * front.z);
  };
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (key == "front_light_only") return radiance(v, front);
    if (key == "back_light_only") return radiance(v, back);
    if (key == "radiance_front") return radiance(v, front) + radiance(v, back);
    if (key == "radiance_back") {
      return radiance(shader::mirrored(v), front) + radiance(shader::mirrored(v), back);
    }
    return {};
  });
}

}  // namespace gltfx::ground_truth

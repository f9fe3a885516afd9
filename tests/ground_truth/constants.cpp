// SPDX-License-Identifier: Apache-2.0
#include "cases.hpp"
#include "shader/albedo_integrals.hpp"
#include "shader/fresnel.hpp"

namespace gltfx::ground_truth {

Value iridescence(Inputs& inputs, const Value& expected) {
  const Rgb reflectance = shader::iridescent_fresnel(
      inputs.number("outsideIor", 1), inputs.number("iridescenceIor", 1.3),
      inputs.color("baseF0", Rgb(0.04)), inputs.number("thickness_nm", 400),
      inputs.number("cosTheta1", 1));
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    return key == "F" ? Value(reflectance) : Value();
  });
}

Value dispersion(Inputs& inputs, const Value& expected) {
  const double ior = inputs.number("ior", 1.5);
  const double strength = inputs.number("dispersion", 0);
  return for_each_key(expected, [&](const std::string& key, const Value& wanted) -> Value {
    if (key == "rgb_ior") return shader::dispersed_ior(ior, strength);
    if (key != "n_at_nm") return {};
    return for_each_key(wanted, [&](const std::string& wavelength, const Value&) -> Value {
      const auto nm = number_in(wavelength);
      return nm ? Value(shader::dispersed_ior(ior, strength, *nm)) : Value();
    });
  });
}

Value sheen(Inputs& inputs, const Value& expected) {
  const double roughness = inputs.number("sheenRoughness", 0);
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    const auto cosine = number_in(key, "E_at_NdotV_");
    return cosine ? Value(shader::integrate_sheen_albedo(roughness, *cosine, 256)) : Value();
  });
}

}  // namespace gltfx::ground_truth

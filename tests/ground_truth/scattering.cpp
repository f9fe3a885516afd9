// SPDX-License-Identifier: Apache-2.0
#include "cases.hpp"
#include "shader/medium.hpp"
#include "transport.hpp"

namespace gltfx::ground_truth {
namespace {

// All of these have index-matched boundaries and scatter evenly.
void ignore_setting(Inputs& inputs) {
  for (const char* key : {"phase", "boundary", "optical_thickness"}) inputs.ignore(key);
}

// A list of beams, each with the cosines "mu0" and "mu".
Value beams(const SemiInfinite& medium, const Value& expected) {
  Value list;
  list.kind = Value::Kind::list;
  for (const Value& beam : expected.items) {
    const Value* mu0 = beam.find("mu0");
    const Value* mu = beam.find("mu");
    if (mu0 == nullptr || mu == nullptr) return {};
    list.items.push_back(
        for_each_key(beam, [&](const std::string& key, const Value& same) -> Value {
          if (key == "mu" || key == "mu0") return same;
          return key == "L" ? Value(medium.radiance(mu0->number, mu->number)) : Value();
        }));
  }
  return list;
}

}  // namespace

Value sss_semi_infinite(Inputs& inputs, const Value& expected) {
  const SemiInfinite medium(inputs.number("single_scatter_albedo", 0));
  ignore_setting(inputs);
  return for_each_key(expected, [&](const std::string& key, const Value& wanted) -> Value {
    if (key == "diffuse_albedo") return medium.diffuse_albedo();
    if (key == "radiance_dirlight_E1") return beams(medium, wanted);
    return for_each_key(wanted, [&](const std::string& mu, const Value&) -> Value {
      const auto cosine = number_in(mu);
      if (!cosine) return {};
      if (key == "furnace_radiance") return medium.plane_albedo(*cosine);
      if (key == "H") return medium.h(*cosine);
      return {};
    });
  });
}

Value sss_slab(Inputs& inputs, const Value& expected) {
  const double albedo = inputs.number("single_scatter_albedo", 0);
  const double tau = inputs.number("tau", 1);
  ignore_setting(inputs);
  return for_each_key(expected, [&](const std::string& mu, const Value& wanted) -> Value {
    const auto cosine = number_in(mu);
    if (!cosine) return {};
    const SlabAlbedo slab = slab_albedo(albedo, tau, *cosine);
    return for_each_key(wanted, [&](const std::string& key, const Value&) -> Value {
      if (key == "R") return slab.reflected;
      if (key == "T_total") return slab.transmitted;
      if (key == "T_direct") return std::exp(-tau / *cosine);
      if (key == "T_diffuse") return slab.transmitted - std::exp(-tau / *cosine);
      return {};
    });
  });
}

Value sss_sphere(Inputs& inputs, const Value& expected) {
  const double environment = inputs.number("environment", 1);
  const SphereRadiance sphere = sphere_radiance(inputs.number("single_scatter_albedo", 0),
                                                inputs.number("optical_radius", 1));
  ignore_setting(inputs);
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (key == "centre_pixel") return sphere.centre * environment;
    if (key == "mean_over_disk") return sphere.mean * environment;
    return {};
  });
}

namespace {

Value of_medium(const Material& material, const std::string& key) {
  const shader::Medium medium = shader::medium_of(material);
  if (key == "sigma_s") return medium.scattering;
  if (key == "sigma_a") return medium.absorption;
  if (key == "sigma_t") return medium.extinction();
  if (key == "albedo") return medium.scattering / medium.extinction();
  if (key == "mfp") return Rgb(1) / medium.extinction();
  return {};
}

}  // namespace

Value sss_parameters(Inputs& inputs, const Value& expected) {
  const bool multiple = inputs.has("multi_scatter_albedo");
  const double albedo = inputs.number("multi_scatter_albedo", 0);
  Material m = read_properties(inputs);
  m.scattering = Scattering::distance;
  m.scatter_color = inputs.color("scatterColor", m.scatter_color);
  m.scatter_distance = inputs.number("scatterDistance", m.scatter_distance);
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (!multiple) return of_medium(m, key);
    return key == "single_scatter_albedo" ? Value(shader::single_scatter_albedo(albedo)) : Value();
  });
}

Value scatter_parameters(Inputs& inputs, const Value& expected) {
  const double albedo = inputs.number("multi_scatter_albedo", 0);
  const double g = inputs.number("scatterAnisotropy", 0);
  return for_each_key(expected, [&](const std::string& key, const Value& wanted) -> Value {
    if (key != "single_scatter_albedo") return {};
    return for_each_key(wanted, [&](const std::string& extension, const Value&) -> Value {
      if (extension.ends_with("_volume_scatter")) return shader::single_scatter_albedo(albedo);
      if (extension.ends_with("_scatter")) return shader::single_scatter_albedo(albedo, g);
      return {};
    });
  });
}

Value phase_function(Inputs& inputs, const Value& expected) {
  const double p = shader::henyey_greenstein(inputs.number("g", 0), inputs.number("v_dot_l", 1));
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    return key == "p" ? Value(p) : Value();
  });
}

}  // namespace gltfx::ground_truth

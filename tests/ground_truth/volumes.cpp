// SPDX-License-Identifier: Apache-2.0
#include "volumes.hpp"

#include "cases.hpp"
#include "shader/directions.hpp"
#include "shader/medium.hpp"

namespace gltfx::ground_truth {

Crossing cross_boundary(const Material& material, const Vec3d& v) {
  const Albedo albedo = integrate(material, v, kSpec, 1);
  Crossing crossing{albedo.specular_reflect, albedo.specular_transmit, {}};
  for (const double lobe : {0.0, 0.25, 0.5, 0.75, 0.999999}) {
    const auto ray = sample(material, v, {lobe, 0.5, 0.5}, kSpec);
    if (ray && ray->delta && ray->l.z * v.z < 0) crossing.onwards = ray->l;
  }
  return crossing;
}

namespace {

// Light between two boundaries that are hit repeatedly at one angle: `entering` comes from outside,
// `inside` is what each does to light that is within.
struct Between {
  Crossing entering, inside;

  Between(const Material& material, const Vec3d& v) : entering(cross_boundary(material, v)) {
    const Vec3d& onwards = entering.onwards;
    if (onwards.z != 0) inside = cross_boundary(material, {onwards.x, onwards.y, onwards.z});
  }
};

bool is_smooth(const Material& m) { return m.roughness <= 0.01 && m.transmission == 1; }

// A slab has its material's properties in addition to its own.
Material slab_material(Inputs& inputs) {
  Material m = read_properties(inputs);
  m.thickness = 1;
  return m;
}

}  // namespace

Rgb sphere_radiance(const Material& material, double radius, const Vec3d& v) {
  const Between b(material, v);
  const double chord = 2 * radius * -b.entering.onwards.z;
  const Rgb dimmed = shader::medium_of(material).transmittance(chord);
  return b.entering.reflected + b.entering.transmitted * dimmed * b.inside.transmitted /
                                    (Rgb(1) - b.inside.reflected * dimmed);
}

Value volume_slab(Inputs& inputs, const Value& expected) {
  const double thickness = inputs.number("thickness", 1);
  const double theta = inputs.number("theta_deg", 0);
  const Material m = slab_material(inputs);
  const Between b(m, direction({theta, 0}));
  const double path = thickness / -b.entering.onwards.z;
  const Rgb dimmed = shader::medium_of(m).transmittance(path);
  const Rgb twice = b.inside.reflected * dimmed * b.inside.reflected * dimmed;
  const Rgb single = b.entering.transmitted * dimmed * b.inside.transmitted;
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (!is_smooth(m)) return {};
    if (key == "F") return b.entering.reflected;
    if (key == "path") return path;
    if (key == "transmittance") return dimmed;
    if (key == "T_single_pass") return single;
    if (key == "T") return single / (Rgb(1) - twice);
    if (key == "R") {
      return b.entering.reflected + single * b.inside.reflected * dimmed / (Rgb(1) - twice);
    }
    return {};
  });
}

Value volume_sphere(Inputs& inputs, const Value& expected) {
  const double radius = inputs.number("radius", 1);
  const double environment = inputs.number("environment", 1);
  const Material m = slab_material(inputs);
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (key != "centre_pixel" || !is_smooth(m)) return {};
    return sphere_radiance(m, radius, {0, 0, 1}) * environment;
  });
}

Value beer_lambert(Inputs& inputs, const Value& expected) {
  const double x = inputs.number("x", 0);
  const shader::Medium medium = shader::medium_of(read_properties(inputs));
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (key == "T") return medium.transmittance(x);
    if (key == "sigma_t") return medium.extinction();
    if (key == "sigma_a") return medium.absorption;
    return {};
  });
}

}  // namespace gltfx::ground_truth

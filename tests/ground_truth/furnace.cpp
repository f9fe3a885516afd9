// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "cases.hpp"
#include "volumes.hpp"

namespace gltfx::ground_truth {
namespace {

constexpr int kFurnaceResolution = 128;

// What reaches the eye from a wall in an environment that is the same all around.
Value of_wall(const Albedo& albedo, double environment, const std::string& key) {
  if (key == "diffuse_reflect") return albedo.diffuse_reflect * environment;
  if (key == "diffuse_transmit") return albedo.diffuse_transmit * environment;
  if (key == "specular_reflect") return albedo.specular_reflect * environment;
  if (key == "specular_transmit") return albedo.specular_transmit * environment;
  if (key == "total") return albedo.total * environment;
  return {};
}

// The radiance that is furthest from `expected`, over angles of view.
template <class Radiance>
Rgb worst_over_angles(const Value& expected, const Radiance& radiance) {
  Rgb worst;
  double furthest = -1;
  for (double cosine = 0.05; cosine <= 1; cosine += 0.19) {
    const Rgb seen = radiance(direction_of_cosine(cosine));
    for (std::size_t i = 0; i < expected.items.size(); ++i) {
      const double off = std::fabs(seen[static_cast<int>(i)] - expected.items[i].number);
      if (off <= furthest) continue;
      furthest = off;
      worst = seen;
    }
  }
  return worst;
}

}  // namespace

Value white_furnace(Inputs& inputs, const Value& expected) {
  const Material material = read_material(inputs);
  const double environment = inputs.number("environment", 1);
  inputs.ignore("geometry");  // volumes are closed, walls are plane or convex: no light comes twice
  if (inputs.has("NdotV")) {
    const Vec3d v = direction_of_cosine(inputs.number("NdotV", 1));
    const Albedo albedo = integrate(material, v, kSpec, kFurnaceResolution);
    return for_each_key(expected, [&](const std::string& key, const Value&) {
      return of_wall(albedo, environment, key);
    });
  }
  return for_each_key(expected, [&](const std::string& key, const Value& wanted) -> Value {
    if (key != "total") return {};
    return worst_over_angles(wanted, [&](const Vec3d& v) {
      const Rgb seen = material.volumetric()
                           ? sphere_radiance(material, 1, v)
                           : integrate(material, v, kSpec, kFurnaceResolution).total;
      return seen * environment;
    });
  });
}

Value model_property(Inputs& inputs, const Value& expected) {
  const Material material = read_material(inputs);
  const Vec3d v = direction_of_cosine(inputs.number("NdotV", 1));
  const Rgb literal = integrate(material, v, kSpec, kFurnaceResolution).total;
  const Rgb conserving = integrate(material, v, {}, kFurnaceResolution).total;
  return for_each_key(expected, [&](const std::string& key, const Value&) -> Value {
    if (key == "literal_total") return literal;
    if (max_value(conserving) > 1 + 1e-3) return std::string("the conserving mode gains energy");
    if (key == "gains_energy") return max_value(literal) > 1;
    if (key == "conserving_total") return conserving;
    return {};
  });
}

namespace {

Rgb power(const Rgb& base, double exponent) {
  return {std::pow(base.x, exponent), std::pow(base.y, exponent), std::pow(base.z, exponent)};
}

// A closed convex shell of walls that send light evenly, in an environment of radiance 1.
Value of_shell(const Albedo& wall, const std::string& key) {
  const Rgb inside = wall.diffuse_transmit / (Rgb(1) - wall.diffuse_reflect);
  if (key == "inside") return inside;
  if (key == "outside") return wall.diffuse_reflect + wall.diffuse_transmit * inside;
  return {};
}

// Inside of a closed box whose walls glow.
Value of_box(const Albedo& wall, const Rgb& glow, const std::string& key, const Value& expected) {
  const Rgb without_end = glow / (Rgb(1) - wall.diffuse_reflect);
  if (key == "radiance") return without_end;
  if (key != "with_bounce_limit") return {};
  return for_each_key(expected, [&](const std::string& bounces, const Value&) -> Value {
    const auto limit = number_in(bounces);
    if (!limit) return {};
    return without_end * (Rgb(1) - power(wall.diffuse_reflect, *limit + 1));
  });
}

}  // namespace

Value multi_bounce(Inputs& inputs, const Value& expected) {
  const Material material = read_material(inputs);
  inputs.ignore("geometry");
  const Vec3d v = direction_of_cosine(0.7);
  const Albedo wall = integrate(material, v, kSpec, 64);
  return for_each_key(expected, [&](const std::string& key, const Value& wanted) -> Value {
    // Light that is not sent evenly makes another equation.
    if (max_value(wall.specular_reflect + wall.specular_transmit) > 1e-9) return {};
    const Value shell = of_shell(wall, key);
    return shell.kind != Value::Kind::null ? shell
                                           : of_box(wall, emitted(material, v), key, wanted);
  });
}

}  // namespace gltfx::ground_truth

// SPDX-License-Identifier: Apache-2.0
/// Random materials and directions, the same in each run.
#pragma once

#include <gltfx/material.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

namespace gltfx::shader::test {

class Chance {
 public:
  explicit Chance(unsigned seed) : engine_(seed) {}

  double number() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * number(); }
  Rgb color() { return {number(), number(), number()}; }
  Random3 three() { return {number(), number(), number()}; }
  /// On the side of +z.
  Vec3d upwards() {
    const double z = between(0.02, 1);
    const double phi = 2 * std::numbers::pi * number();
    return {std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z};
  }
  Vec3d anywhere() {
    const Vec3d up = upwards();
    return number() < 0.5 ? up : -up;
  }
  /// A dielectric with some of each parameter that is equal on front and back.
  Material material() {
    Material m;
    m.base_color = color();
    m.metallic = number();
    m.roughness = between(0.1, 1);
    m.ior = between(1, 2.5);
    m.specular = number();
    m.specular_color = color() * 1.5;
    m.transmission = number();
    m.diffuse_transmission = number();
    m.diffuse_transmission_color = color();
    m.diffuse_roughness = number();
    return m;
  }

 private:
  std::mt19937_64 engine_;
};

inline Vec3d direction_of_cosine(double cosine) {
  return {std::sqrt(1 - cosine * cosine) * 0.8, std::sqrt(1 - cosine * cosine) * 0.6, cosine};
}

}  // namespace gltfx::shader::test

// SPDX-License-Identifier: Apache-2.0
/// evaluate_material: how much light a leaf reflects and transmits, by the angle of the viewer, as
/// CSV. Colors are linear Rec. 709; the printed channel is green.
#include <gltfx/material.hpp>

#include <cmath>
#include <iostream>

int main() {
  gltfx::Material leaf;
  leaf.metallic = 0;
  leaf.roughness = 0.6;
  leaf.base_color = {0.1, 0.3, 0.05};
  leaf.diffuse_transmission = 0.6;
  leaf.diffuse_transmission_color = {0.2, 0.6, 0.1};

  std::cout << "degrees,diffuse reflection,diffuse transmission,specular reflection,total\n";
  for (int degrees = 0; degrees <= 80; degrees += 20) {
    const double angle = degrees * 3.14159265358979 / 180;
    const gltfx::Vec3d viewer{std::sin(angle), 0, std::cos(angle)};
    const gltfx::Albedo albedo = gltfx::integrate(leaf, viewer);
    std::cout << degrees << ',' << albedo.diffuse_reflect.y << ',' << albedo.diffuse_transmit.y
              << ',' << albedo.specular_reflect.y << ',' << albedo.total.y << '\n';
  }
}

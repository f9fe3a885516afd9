// SPDX-License-Identifier: Apache-2.0
/// A ball between two cubes, in the light and on the floor of the studio.
#pragma once

#include <utility>

#include "preview/lighting.hpp"
#include "rendering.hpp"

namespace gltfx::render {

/// `transmission`: of the ball.
inline Stage studio_stage(double transmission = 0) {
  Scene scene = scene_of(sphere(1, 16), matte({0.8, 0.4, 0.2}));
  scene.materials[0].factors.specular = 1;
  scene.materials[0].factors.roughness = 0.4;
  scene.materials[0].factors.transmission = transmission;
  scene.meshes.push_back(cube(0.5F));
  scene.instances.push_back({1, moved(1.2F, -0.5F, 0.8F)});
  scene.instances.push_back({1, moved(-1.2F, -0.5F, 0.8F)});
  Stage stage(std::move(scene));
  stage.world.environment.emplace(preview::studio_environment({0, 0, 1}));
  stage.world.shadow_catcher = ShadowCatcher{-1, 3};
  stage.bounces = 4;
  return stage;
}

inline View front() {
  View view;
  view.origin = {0, 0.5, 6};
  return view;
}

}  // namespace gltfx::render

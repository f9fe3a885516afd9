// SPDX-License-Identifier: Apache-2.0
/// Two integrators that share little except the scene agree.
#include <string>

#include <gtest/gtest.h>

#include "rendering.hpp"

namespace gltfx::render {
namespace {

struct SceneCase {
  std::string name;
  SceneMaterial material;
};

SceneMaterial rough(double roughness, double metallic = 0) {
  SceneMaterial material;
  material.factors.base_color = {0.8, 0.5, 0.3};
  material.factors.roughness = roughness;
  material.factors.metallic = metallic;
  return material;
}

std::vector<SceneCase> cases() {
  std::vector<SceneCase> all{{"matte", matte({0.8, 0.5, 0.2})},
                             {"plastic", rough(0.5)},
                             {"metal", rough(0.6, 1)},
                             {"half metal", rough(0.8, 0.5)}};
  SceneMaterial leaf = rough(0.7);
  leaf.factors.diffuse_transmission = 0.6;
  leaf.factors.diffuse_transmission_color = {0.2, 0.9, 0.1};
  leaf.double_sided = true;
  all.push_back({"leaf", leaf});
  SceneMaterial frosted = rough(0.7);
  frosted.factors.transmission = 0.8;
  frosted.double_sided = true;
  all.push_back({"frosted sheet", frosted});
  SceneMaterial velvet = rough(0.9);
  velvet.factors.sheen_color = {0.5, 0.4, 0.9};
  velvet.factors.sheen_roughness = 0.6;
  all.push_back({"velvet", velvet});
  SceneMaterial lacquer = rough(0.8);
  lacquer.factors.clearcoat = 1;
  lacquer.factors.clearcoat_roughness = 0.5;
  all.push_back({"lacquer", lacquer});
  SceneMaterial brushed = rough(0.7, 1);
  brushed.factors.anisotropy = 0.5;
  all.push_back({"brushed", brushed});
  SceneMaterial lamp = matte(Rgb(0.5));
  lamp.factors.emissive = {0.5, 1, 2};
  all.push_back({"lamp", lamp});
  return all;
}

// An object on a floor, under a sky with a bright side, and a lamp.
Stage stage_of(const SceneMaterial& material) {
  Scene scene = scene_of(sphere(1, 12), material);
  Mesh floor = quad(4);
  floor.material = 1;
  scene.meshes.push_back(floor);
  scene.materials.push_back(matte({0.3, 0.6, 0.9}));
  scene.instances.push_back({1, moved(0, 0, -1.2F)});
  Stage stage(std::move(scene));
  stage.find_emitters();
  EnvironmentImage sky = even_light(0.5F);
  sky.width = 4;
  sky.height = 2;
  sky.radiance.assign(8, {0.4F, 0.5F, 0.6F});
  sky.radiance[1] = {4, 3, 2};
  stage.world.environment.emplace(sky);
  Light light;
  light.position = {1, 2, 3};
  light.intensity = {6, 5, 4};
  stage.world.lights = {light};
  stage.bounces = 3;
  return stage;
}

TEST(SimpleIntegrator, AgreesWithTheFastOne) {
  for (const SceneCase& each : cases()) {
    const Stage stage = stage_of(each.material);
    EXPECT_EQ(stage.world.emitters.empty(), each.name != "lamp");
    for (const Ray& ray :
         {Ray{{0.5, 0.4, 4}, {0, 0, -1}}, Ray{{3, 0, 3}, normalize(Vec3d(-0.55, 0, -1))}}) {
      const Estimate fast = stage.path(ray, 6000);
      const Estimate simple = stage.simply(ray, 30000);
      for (int c = 0; c < 3; ++c) {
        const double error =
            std::sqrt(fast.error[c] * fast.error[c] + simple.error[c] * simple.error[c]);
        EXPECT_NEAR(fast.mean[c], simple.mean[c], 3.5 * error + 1e-4) << each.name << " " << c;
        EXPECT_LT(error, 0.05 * simple.mean[c] + 0.01) << each.name;
      }
    }
  }
}

}  // namespace
}  // namespace gltfx::render

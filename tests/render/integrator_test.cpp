// SPDX-License-Identifier: Apache-2.0
/// Scenes whose light is known in closed form.
#include "render/integrator.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "rendering.hpp"

namespace gltfx::render {
namespace {

constexpr double kPi = std::numbers::pi;
const Ray kDown{{0.1, 0.2, 3}, {0, 0, -1}};

// A box from the inside, all of whose walls shine and scatter: L = Le / (1 - albedo).
TEST(Integrator, AFurnaceIsEquallyBrightEverywhere) {
  SceneMaterial wall = matte({0.5, 0.8, 0.2});
  wall.factors.emissive = {1, 0.5, 2};
  wall.double_sided = true;
  Stage stage(scene_of(cube(2), wall));
  stage.bounces = 64;
  expect_near(stage.path({{0.3, 0.1, 0}, normalize(Vec3d(0.2, 0.7, -0.4))}, 20000),
              {1 / 0.5, 0.5 / 0.2, 2 / 0.8});
}

TEST(Integrator, BouncesEndAPath) {
  SceneMaterial wall = matte({0.5, 0.5, 0.5});
  wall.factors.emissive = {1, 1, 1};
  wall.double_sided = true;
  Stage stage(scene_of(cube(2), wall));
  for (const int bounces : {0, 1, 2}) {
    stage.bounces = bounces;
    const double expected = 2 - std::pow(0.5, bounces);
    expect_near(stage.path({{0, 0, 0}, {0, 0, -1}}), Rgb(expected));
  }
}

TEST(Integrator, ADirectionalLightOnAPlane) {
  Stage stage(scene_of(quad(), matte({0.6, 0.4, 0.2})));
  Light light;
  light.kind = Light::Kind::directional;
  light.intensity = {3, 3, 3};
  light.direction = {0.6F, 0, -0.8F};
  stage.world.lights = {light};
  expect_near(stage.path(kDown, 10), Rgb(0.6, 0.4, 0.2) * (3 * 0.8 / kPi), 1e-5);
}

// What reflects nothing at all lets its base colour through; a half that is cut out, everything.
TEST(Integrator, ALampShinesThroughAPane) {
  SceneMaterial pane = matte({0.9, 0.5, 0.1});
  pane.factors.roughness = 0;
  pane.factors.specular = 0;
  pane.factors.transmission = 1;
  pane.double_sided = true;
  for (const bool blended : {false, true}) {
    pane.alpha_mode = blended ? AlphaMode::blend : AlphaMode::opaque;
    pane.alpha = blended ? 0.5F : 1;
    Scene scene = scene_of(quad(), matte({0.6, 0.4, 0.2}));
    scene.materials.push_back(pane);
    Mesh mesh = quad();
    mesh.material = 1;
    scene.meshes.push_back(mesh);
    scene.instances.push_back({1, moved(0, 0, 1)});
    Stage stage(std::move(scene));
    Light light;
    light.kind = Light::Kind::directional;
    light.intensity = {3, 3, 3};
    light.direction = {0, 0, -1};
    stage.world.lights = {light};
    const Rgb passed = blended ? Rgb(0.95, 0.75, 0.55) : Rgb(0.9, 0.5, 0.1);
    expect_near(stage.path({{0.1, 0.2, 0.5}, {0, 0, -1}}, 10),
                Rgb(0.6, 0.4, 0.2) * passed * (3 / kPi), 1e-5);
  }
}

TEST(Integrator, APointLightFallsOffWithTheSquare) {
  Stage stage(scene_of(quad(), matte(Rgb(0.5))));
  Light light;
  light.intensity = {10, 10, 10};
  light.position = {0.1F, 0.2F, 2};
  stage.world.lights = {light};
  expect_near(stage.path(kDown, 10), Rgb(0.5 * 10 / 4 / kPi), 1e-5);
}

TEST(Integrator, LampsAreChosenByWhatTheyGive) {
  Stage stage(scene_of(quad(), matte(Rgb(0.5))));
  double expected = 0;
  for (int i = 1; i <= 100; ++i) {
    Light light;
    light.intensity = Float3{static_cast<float>(i), static_cast<float>(i), static_cast<float>(i)};
    light.position = {0.1F, 0.2F, static_cast<float>(i)};
    stage.world.lights.push_back(light);
    expected += 0.5 * i / (i * i) / kPi;
  }
  expect_near(stage.path(kDown, 20000), Rgb(expected), 1e-5);
}

TEST(Integrator, AnEvenSkyOnAMatteSphere) {
  Stage stage(scene_of(sphere(), matte({0.9, 0.5, 0.1})));
  stage.world.environment.emplace(even_light(2));
  expect_near(stage.path(kDown), Rgb(0.9, 0.5, 0.1) * 2, 0.01);
}

// Beer's law along a straight way: a slab whose surface neither reflects nor bends.
TEST(Integrator, ASlabAbsorbs) {
  SceneMaterial glass;
  glass.factors.metallic = 0;
  glass.factors.roughness = 0;
  glass.factors.ior = 1;
  glass.factors.transmission = 1;
  glass.factors.thickness = 1;
  glass.factors.attenuation_distance = 0.5;
  glass.factors.attenuation_color = {0.8, 0.5, 0.25};
  Stage stage(scene_of(cube(), glass));
  stage.world.environment.emplace(even_light());
  stage.world.background = Background::environment;
  const auto through = [](double color) { return std::pow(color, 2 / 0.5); };
  expect_near(stage.path(kDown, 200), {through(0.8), through(0.5), through(0.25)}, 1e-4);
}

// A sheet of glass as a closed box: the light outside equals that inside except for reflections,
// and in an even light both are equal.
TEST(Integrator, GlassInAnEvenLightIsInvisible) {
  SceneMaterial glass;
  glass.factors.metallic = 0;
  glass.factors.roughness = 0;
  glass.factors.transmission = 1;
  glass.factors.thickness = 1;
  Stage stage(scene_of(sphere(1, 32), glass));
  stage.bounces = 64;
  stage.world.environment.emplace(even_light());
  stage.world.background = Background::environment;
  expect_near(stage.path({{0.4, 0.3, 3}, {0, 0, -1}}, 4000), Rgb(1), 0.01);
}

TEST(Integrator, UnlitIsItsColour) {
  SceneMaterial material;
  material.factors.base_color = {0.1, 0.2, 0.3};
  material.factors.unlit = true;
  Stage stage(scene_of(quad(), material));
  stage.world.environment.emplace(even_light(5));
  expect_near(stage.path(kDown, 4), {0.1, 0.2, 0.3});
}

TEST(Integrator, AlphaIsWhatHidesTheBackground) {
  SceneMaterial material = matte(Rgb(0.5));
  material.alpha_mode = AlphaMode::blend;
  material.alpha = 0.25F;
  Stage stage(scene_of(quad(), material));
  stage.world.background = Background::transparent;
  EXPECT_EQ(trace_ray(stage.context(), {kDown}).alpha, 0.25);
  EXPECT_EQ(trace_ray(stage.context(), {{{5, 5, 5}, {0, 0, -1}}}).alpha, 0);
}

TEST(Integrator, TheFirstSurfaceIsDescribed) {
  Stage stage(scene_of(quad(), matte({0.6, 0.4, 0.2})));
  const PathSample sample = trace_ray(stage.context(), {kDown});
  EXPECT_EQ(sample.features.albedo, Rgb(0.6, 0.4, 0.2));
  EXPECT_NEAR(sample.features.normal.z, 1, 1e-6);
  EXPECT_NEAR(sample.features.depth, 3, 1e-6);
  EXPECT_EQ(sample.features.material, 0U);
}

}  // namespace
}  // namespace gltfx::render

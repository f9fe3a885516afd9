// SPDX-License-Identifier: Apache-2.0
/// Two integrators that share little but the scene bring back the same light, in scenes that
/// between them need all there is of either: the mean over a picture, within three standard errors
/// of the difference, which are small compared with the effect of a missing or an extra light.
#include <array>
#include <functional>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "render/view.hpp"
#include "rendering.hpp"

namespace gltfx::render {
namespace {

// A view, and rays all over it.
struct Shot {
  Stage stage;
  View view;

  Ray ray(const SampleStream& random) const {
    const Float2 at = random.pair(0x10000);
    return view.ray(static_cast<double>(at[0]), static_cast<double>(at[1]));
  }
};

SceneMaterial plain(const Rgb& color, double roughness, double metallic = 0) {
  SceneMaterial material;
  material.factors.base_color = color;
  material.factors.roughness = roughness;
  material.factors.metallic = metallic;
  return material;
}

SceneMaterial glass(double roughness, double ior = 1.5) {
  SceneMaterial material = plain({0.95, 0.9, 0.85}, roughness);
  material.factors.transmission = 1;
  material.factors.thickness = 1;
  material.factors.ior = ior;
  return material;
}

// Darker below, with one side that is some times as bright.
EnvironmentImage sky() {
  EnvironmentImage image;
  image.width = 8;
  image.height = 4;
  for (std::uint32_t y = 0; y < 4; ++y) {
    for (std::uint32_t x = 0; x < 8; ++x) {
      const float up = 1 - static_cast<float>(y) * 0.2F;
      const float sun = x == 5 && y < 2 ? 5 : 1;
      image.radiance.push_back({0.5F * up * sun, 0.6F * up * sun, 0.7F * up});
    }
  }
  return image;
}

Light lamp(Light::Kind kind, const Float3& position, const Float3& intensity) {
  Light light;
  light.kind = kind;
  light.position = position;
  light.intensity = intensity;
  light.direction = {0, 0, -1};
  return light;
}

void add(Scene& scene, Mesh mesh, const SceneMaterial& material, const Matrix34& place) {
  mesh.material = static_cast<std::uint32_t>(scene.materials.size());
  scene.materials.push_back(material);
  scene.instances.push_back({static_cast<std::uint32_t>(scene.meshes.size()), place});
  scene.meshes.push_back(std::move(mesh));
}

// Seen from above, under the sky.
Shot outdoors(Scene scene, int bounces = 4) {
  Shot shot{Stage(std::move(scene)), {}};
  shot.view.origin = {0, 0, 5};
  shot.view.half_width = shot.view.half_height = 0.3;
  shot.stage.world.environment.emplace(sky());
  shot.stage.world.background = Background::environment;
  shot.stage.bounces = bounces;
  return shot;
}

Scene on_floor(const SceneMaterial& material, Mesh mesh = sphere(1, 12)) {
  Scene scene = scene_of(std::move(mesh), material);
  add(scene, quad(4), plain({0.3, 0.6, 0.9}, 0.8), moved(0, 0, -1.2F));
  return scene;
}

Shot with_lamp(Shot shot) {
  shot.stage.world.lights = {lamp(Light::Kind::point, {1, 2, 3}, {6, 5, 4})};
  return shot;
}

Texture texels(std::uint32_t channels, const std::vector<std::uint8_t>& values) {
  const auto bytes = std::make_shared<std::vector<std::uint8_t>>(values);
  Texture texture;
  texture.width = texture.height = 2;
  texture.channels = channels;
  texture.pixels = std::as_bytes(std::span(*bytes));
  texture.owner = bytes;
  return texture;
}

Shot furnace() {
  SceneMaterial wall = matte({0.5, 0.8, 0.2});
  wall.factors.emissive = {1, 0.5, 2};
  wall.double_sided = true;
  Scene scene = scene_of(cube(2), wall);
  add(scene, sphere(0.7F, 8), plain(Rgb(0.9), 0.8, 1), moved(0, 0.5F, -0.5F));
  Shot shot{Stage(std::move(scene)), {}};
  shot.stage.bounces = 5;
  shot.view.origin = {0, 0, 1.5};
  return shot;
}

Shot textured() {
  SceneMaterial material = plain(Rgb(1), 1, 1);
  material.factors.emissive = {0.3, 0.2, 0.1};
  Scene scene;
  scene.textures = {texels(3, {250, 120, 40, 30, 200, 90, 90, 60, 220, 240, 240, 230}),
                    texels(3, {0, 150, 250, 0, 200, 0, 0, 240, 120, 0, 120, 60}),
                    texels(3, {128, 128, 255, 180, 128, 230, 128, 90, 240, 110, 160, 240}),
                    texels(3, {0, 0, 0, 255, 120, 0, 40, 40, 40, 0, 0, 250})};
  const std::array<Slot, 4> slots{Slot::base_color, Slot::metallic_roughness, Slot::normal,
                                  Slot::emissive};
  for (std::uint32_t i = 0; i < slots.size(); ++i) material.use(slots[i]).texture = i;
  add(scene, sphere(1, 12), material, kIdentity);
  add(scene, quad(4), plain({0.3, 0.6, 0.9}, 0.8), moved(0, 0, -1.2F));
  return with_lamp(outdoors(std::move(scene)));
}

Shot absorbing_glass() {
  SceneMaterial material = glass(0.45);
  material.factors.attenuation_distance = 1.5;
  material.factors.attenuation_color = {0.9, 0.5, 0.3};
  return with_lamp(outdoors(on_floor(material), 6));
}

// A ball of glass in a block of another.
Shot nested() {
  SceneMaterial block = glass(0, 1.2);
  block.factors.attenuation_distance = 4;
  block.factors.attenuation_color = {0.8, 0.6, 0.9};
  SceneMaterial ball = glass(0.3, 1.5);
  ball.factors.attenuation_distance = 1;
  ball.factors.attenuation_color = {0.4, 0.9, 0.6};
  Scene scene = on_floor(block, cube());
  add(scene, sphere(0.6F, 12), ball, kIdentity);
  return outdoors(std::move(scene), 8);
}

Shot leaf() {
  SceneMaterial material = plain({0.4, 0.5, 0.1}, 0.7);
  material.factors.diffuse_transmission = 0.7;
  material.factors.diffuse_transmission_color = {0.3, 0.9, 0.1};
  material.double_sided = true;
  Shot shot = outdoors(on_floor(material, quad(1)));
  Light sun = lamp(Light::Kind::directional, {}, {3, 2.5F, 2});
  sun.direction = {0, 0.6F, 0.8F};  // from below
  shot.stage.world.lights = {sun};
  return shot;
}

Shot wax() {
  SceneMaterial material = glass(0.6, 1.3);
  material.factors.diffuse_transmission = 1;
  material.factors.transmission = 0.5;
  material.factors.scattering = Scattering::distance;
  material.factors.scatter_distance = 1;
  material.factors.scatter_color = {0.4, 0.6, 0.8};
  material.factors.attenuation_distance = 2;
  material.factors.attenuation_color = {0.9, 0.5, 0.3};
  return with_lamp(outdoors(on_floor(material), 6));
}

Shot milk() {
  SceneMaterial material = glass(0.5, 1.3);
  material.factors.scattering = Scattering::unified;
  material.factors.scatter_color = {0.7, 0.5, 0.3};
  material.factors.scatter_anisotropy = 0.2;
  material.factors.attenuation_distance = 0.5;
  material.factors.attenuation_color = {0.3, 0.4, 0.5};
  return outdoors(on_floor(material), 6);
}

Shot velvet() {
  SceneMaterial material = plain({0.6, 0.2, 0.3}, 0.7);
  material.factors.sheen_color = {0.5, 0.4, 0.9};
  material.factors.sheen_roughness = 0.6;
  material.factors.clearcoat = 0.8;
  material.factors.clearcoat_roughness = 0.4;
  return with_lamp(outdoors(on_floor(material)));
}

Shot shell() {
  SceneMaterial material = plain({0.9, 0.7, 0.5}, 0.6, 0.5);
  material.factors.anisotropy = 0.6;
  material.factors.anisotropy_rotation = 0.7;
  material.factors.iridescence = 1;
  material.factors.iridescence_thickness = 500;
  return with_lamp(outdoors(on_floor(material)));
}

// Surfaces with partial coverage and holes, and copies of them, one of them mirrored.
Shot veil() {
  Scene scene;
  scene.textures = {texels(4, {250, 90, 40, 250, 30, 200, 90, 20, 90, 60, 220, 90, 9, 9, 9, 200})};
  SceneMaterial curtain = plain({0.8, 0.7, 0.6}, 0.7);
  curtain.alpha_mode = AlphaMode::blend;
  curtain.alpha = 0.6F;
  curtain.double_sided = true;
  SceneMaterial grid = curtain;
  grid.alpha_mode = AlphaMode::mask;
  grid.alpha = 1;
  curtain.use(Slot::base_color).texture = grid.use(Slot::base_color).texture = 0;
  add(scene, quad(1.5F), curtain, moved(0.2F, 0, 0.8F));
  add(scene, quad(0.6F), grid, moved(0.7F, 0.4F, 0.2F));
  scene.instances.push_back({1, moved(-0.6F, 0.2F, 0, -1)});
  scene.instances.push_back({1, moved(0, -0.7F, 0.4F, 0.8F)});
  add(scene, quad(4), plain({0.3, 0.6, 0.9}, 0.8), moved(0, 0, -1.2F));
  return with_lamp(outdoors(std::move(scene)));
}

Shot lamps() {
  Shot shot = outdoors(on_floor(plain({0.8, 0.7, 0.6}, 0.5)), 3);
  shot.stage.world.environment.reset();
  Light near = lamp(Light::Kind::point, {1, -1, 1.5F}, {3, 2, 1});
  near.range = 4;
  Light spot = lamp(Light::Kind::spot, {-1, 1, 4}, {20, 30, 40});
  spot.inner_cone = 0.1F;
  spot.outer_cone = 0.4F;
  Light sun = lamp(Light::Kind::directional, {}, {0.5F, 0.4F, 0.3F});
  sun.direction = {0.6F, 0, -0.8F};
  shot.stage.world.lights = {near, spot, sun};
  return shot;
}

Shot room() {
  SceneMaterial wall = matte({0.7, 0.6, 0.5});
  wall.double_sided = true;
  SceneMaterial bulb = matte(Rgb(0.2));
  bulb.factors.emissive = {6, 5, 4};
  Scene scene = scene_of(cube(2), wall);
  add(scene, sphere(0.8F, 8), bulb, moved(0.8F, 0.8F, 0.4F));
  add(scene, sphere(0.6F, 8), plain(Rgb(0.6), 0.5), moved(-0.8F, -0.5F, -1));
  Shot shot{Stage(std::move(scene)), {}};
  shot.view.origin = {0, 0, 1.8};
  shot.stage.bounces = 4;
  return shot;
}

Shot prism() {
  SceneMaterial material = glass(0.3, 1.6);
  material.factors.dispersion = 4;
  return outdoors(on_floor(material), 6);
}

Shot frosted() {
  SceneMaterial material = glass(0.5);
  material.factors.thickness = 0;
  material.factors.transmission = 0.8;
  material.double_sided = true;
  return with_lamp(outdoors(on_floor(material)));
}

// A sheet of water, not a closed volume, over a ball.
Shot pond() {
  Scene scene = on_floor(plain({0.8, 0.5, 0.3}, 0.6));
  add(scene, quad(3), glass(0.2, 1.33), moved(0, 0, 1.5F));
  return outdoors(std::move(scene), 6);
}

// The same, lit from below through the floor: without an eye, all walls let light in.
Shot lit_pond(double attenuation_distance) {
  Scene scene = on_floor(plain({0.8, 0.5, 0.3}, 0.6));
  SceneMaterial water = glass(0.2, 1.33);
  water.factors.attenuation_distance = attenuation_distance;
  water.factors.attenuation_color = {0.4, 0.6, 0.8};
  add(scene, quad(3), water, moved(0, 0, 1.5F));
  SceneMaterial bulb = plain(Rgb(0.2), 1);
  bulb.factors.emissive = {6, 5, 4};
  bulb.double_sided = true;
  add(scene, quad(1), bulb, moved(1.5F, 0, -3));
  Shot shot = outdoors(std::move(scene), 3);
  EnvironmentImage image = even_light(0);
  image.height = 2;
  image.radiance.insert(image.radiance.end(), 2, {1, 2, 3});
  shot.stage.world.environment.emplace(image);
  return shot;
}

// A lamp in a body of wax, and one in clear glass around a ball.
Shot candle() {
  Shot shot = wax();
  shot.stage.bounces = 4;
  shot.stage.world.environment.reset();
  shot.stage.world.background = Background::transparent;
  shot.stage.world.lights = {lamp(Light::Kind::point, {0.2F, 0.1F, 0.3F}, {3, 4, 5}),
                             lamp(Light::Kind::point, {1, 2, 3}, {6, 5, 4})};
  return shot;
}

Shot ball_in_glass() {
  SceneMaterial block = glass(0.8, 1.2);
  block.factors.attenuation_distance = 2;
  block.factors.attenuation_color = {0.8, 0.6, 0.4};
  Scene scene = on_floor(block, cube(1.1F));
  add(scene, sphere(0.5F, 12), plain({0.8, 0.5, 0.3}, 0.6), moved(-0.3F, 0, -0.4F));
  Shot shot = outdoors(std::move(scene), 5);
  shot.stage.world.lights = {lamp(Light::Kind::point, {0.3F, 0.2F, 0.4F}, {1, 1, 1})};
  return shot;
}

struct Case {
  std::string name;
  std::function<Shot()> make;
  double blur = 0.02;  ///< standard error of the difference, at most, of the mean
};

// Stated, or a failure to list the tests would show functions as bytes.
void PrintTo(const Case& shown, std::ostream* out) { *out << shown.name; }

const Case kCases[] = {
    {"furnace", furnace},
    {"textured", textured},
    {"clear_glass", [] { return outdoors(on_floor(glass(0)), 8); }},
    {"absorbing_glass", absorbing_glass},
    {"nested_glass", nested},
    {"leaf", leaf},
    {"wax", wax},
    {"milk", milk, 0.035},
    {"candle", candle, 0.1},
    {"ball_in_glass", ball_in_glass, 0.1},
    {"velvet", velvet},
    {"shell", shell},
    {"veil", veil},
    {"lamps", lamps},
    {"room", room},
    {"prism", prism},
    {"frosted", frosted},
    {"pond", pond},
    {"lit_pond", [] { return lit_pond(std::numeric_limits<double>::infinity()); }},
    {"lit_murky_pond", [] { return lit_pond(4); }, 0.04},
};

class Agreement : public testing::TestWithParam<Case> {};

TEST_P(Agreement, IsWithinThreeStandardErrors) {
  Shot shot = GetParam().make();
  shot.stage.find_emitters();
  const TraceContext context = shot.stage.context();
  const Estimate fast = shot.stage.estimate(20000, 8, [&](const SampleStream& random) {
    return trace_ray(context, {shot.ray(random), {0.5F, 0.5F}, random}).radiance();
  });
  const Estimate simple = shot.stage.estimate(60000, 6, [&](const SampleStream& random) {
    return trace_simply(context, shot.ray(random), random);
  });
  for (int c = 0; c < 3; ++c) {
    const double error = std::hypot(fast.error[c], simple.error[c]);
    EXPECT_NEAR(fast.mean[c], simple.mean[c], 3 * error) << "colour " << c;
    EXPECT_LT(error, GetParam().blur * simple.mean[c]) << "too blurred to tell";
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, testing::ValuesIn(kCases),
                         [](const auto& chosen) { return chosen.param.name; });

}  // namespace
}  // namespace gltfx::render

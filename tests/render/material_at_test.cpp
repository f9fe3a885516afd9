// SPDX-License-Identifier: Apache-2.0
/// What slots read of their textures.
#include "render/material_at.hpp"

#include <array>
#include <span>
#include <string>

#include <gtest/gtest.h>

namespace gltfx::render {
namespace {

constexpr std::array<std::uint8_t, 4> kTexel{51, 102, 153, 204};  // 0.2, 0.4, 0.6, 0.8

// A material at a hit with that texel in one slot.
Material read(Slot slot, const Material& factors) {
  Scene scene;
  scene.textures.push_back({1, 1, 4, 8, std::as_bytes(std::span(kTexel)), nullptr});
  Mesh mesh;
  mesh.triangles = {{0, 1, 2}};
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  SceneMaterial material;
  material.factors = factors;
  material.use(slot).texture = 0;
  const Hit hit;
  return material_at({scene, mesh, material, hit});
}

struct SlotCase {
  Slot slot;
  double Material::*number;
  double factor;  // of the texel
};

class OneChannel : public testing::TestWithParam<SlotCase> {};

TEST_P(OneChannel, ScalesItsNumber) {
  const auto& [slot, number, factor] = GetParam();
  Material factors;
  factors.*number = 0.5;
  EXPECT_NEAR(read(slot, factors).*number, 0.5 * factor, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(
    Slots, OneChannel,
    testing::Values(SlotCase{Slot::metallic_roughness, &Material::roughness, 0.4},
                    SlotCase{Slot::metallic_roughness, &Material::metallic, 0.6},
                    SlotCase{Slot::diffuse_roughness, &Material::diffuse_roughness, 0.2},
                    SlotCase{Slot::transmission, &Material::transmission, 0.2},
                    SlotCase{Slot::diffuse_transmission, &Material::diffuse_transmission, 0.8},
                    SlotCase{Slot::scatter_strength, &Material::scatter_strength, 0.8},
                    SlotCase{Slot::specular, &Material::specular, 0.8},
                    SlotCase{Slot::sheen_roughness, &Material::sheen_roughness, 0.8},
                    SlotCase{Slot::clearcoat, &Material::clearcoat, 0.2},
                    SlotCase{Slot::clearcoat_roughness, &Material::clearcoat_roughness, 0.4},
                    SlotCase{Slot::anisotropy, &Material::anisotropy, 0.6},
                    SlotCase{Slot::iridescence, &Material::iridescence, 0.2},
                    SlotCase{Slot::thickness, &Material::thickness, 1}),
    [](const auto& one) {
      return "slot_" + std::to_string(static_cast<int>(one.param.slot)) + "_" +
             std::to_string(one.index);
    });

TEST(MaterialAt, ColorsAreScaledInTheirCoding) {
  const auto decoded = [](Slot slot, Rgb Material::*color) {
    Material factors;
    factors.*color = Rgb(0.5, 0.5, 0.5);
    return read(slot, factors).*color;
  };
  for (const auto& [slot, color] :
       {std::pair{Slot::base_color, &Material::base_color},
        {Slot::emissive, &Material::emissive},
        {Slot::specular_color, &Material::specular_color},
        {Slot::sheen_color, &Material::sheen_color},
        {Slot::scatter_color, &Material::scatter_color},
        {Slot::diffuse_transmission_color, &Material::diffuse_transmission_color}}) {
    const Rgb found = decoded(slot, color);
    EXPECT_NEAR(found.x, 0.5 * 0.0331, 1e-4) << "sRGB";
    EXPECT_NEAR(found.y, 0.5 * 0.1329, 1e-4);
    EXPECT_NEAR(found.z, 0.5 * 0.3185, 1e-4);
  }
}

TEST(MaterialAt, AFilmIsAsThickAsTheTextureSays) {
  Material film;
  film.iridescence = 1;
  film.iridescence_thickness = 400;
  EXPECT_NEAR(read(Slot::iridescence_thickness, film).iridescence_thickness, 100 + 0.4 * 300, 1e-4);
}

TEST(MaterialAt, UnlitMaterialsReadTheirColorAlone) {
  Material unlit;
  unlit.unlit = true;
  EXPECT_EQ(read(Slot::metallic_roughness, unlit).roughness, 1);
  EXPECT_LT(read(Slot::base_color, unlit).base_color.x, 0.1);
}

}  // namespace
}  // namespace gltfx::render

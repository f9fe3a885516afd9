// SPDX-License-Identifier: Apache-2.0
// Materials and textures of scenes: slots, texture coordinates, tangents, images that are missing.
#include "pipeline/scene_materials.hpp"

#include <cmath>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/support/png_encoder.hpp"
#include "pipeline/scene_asset.hpp"
#include "render/material_at.hpp"

namespace gltfx {
namespace {

using render::Slot;
using test::Accessors;
using test::encode_png;
using test::PngColor;
using test::scene_of;
using test::triangle;
using testing::Each;
using testing::ElementsAre;
using testing::FloatNear;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string kPng =
    encode_png({2, 1, PngColor::rgb, 8, std::string("\xff\0\0\0\xff\0", 6), {}});

std::string image(const std::string& type, const std::string& bytes) {
  return R"({"uri": "data:)" + type + ";base64," + test::base64(bytes) + R"("})";
}

// A node with a triangle of the materials' first one; more attributes and members may follow.
render::Scene drawn(const std::string& materials, const std::string& images = {},
                    const std::string& attributes = {}, const std::string& textures = {},
                    const SceneOptions& options = {}) {
  std::string members = test::one_mesh(
      R"("POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2)" + attributes, R"(, "material": 0)");
  members.append(R"(, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "materials": [)");
  members.append(materials)
      .append(R"(], "images": [)")
      .append(images)
      .append(R"(], "textures": [)");
  members.append(textures.empty() ? R"({"source": 0}, {"source": 0, "sampler": 0})" : textures);
  members.append(R"(], "samplers": [{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}])");
  return scene_of(triangle(), members, options);
}

TEST(SceneMaterials, ToonIsMatteBetweenItsTwoColors) {
  const std::string toon = R"("pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 0.5, 1]},
   "extensions": {"KHR_materials_unlit": {}, "VRMC_materials_mtoon": {"specVersion": "1.0", "shadeColorFactor": [0.5, 0, 0.5]}})";
  const render::Scene scene = drawn("{" + toon + "}");
  ASSERT_THAT(scene.materials, SizeIs(1));
  EXPECT_TRUE(scene.materials[0].toon);
  EXPECT_FALSE(scene.materials[0].factors.unlit);
  const render::Hit hit{};
  const Material at = render::material_at({scene, scene.meshes.at(0), scene.materials[0], hit});
  EXPECT_EQ(at.base_color, Rgb(0.75, 0.25, 0.5));
  EXPECT_EQ(at.metallic, 0);
  EXPECT_EQ(at.specular, 0);
  EXPECT_THAT(scene.notes,
              testing::Contains(AllOf(HasSubstr("Material 0"), HasSubstr("outlines"))));
}

TEST(SceneMaterials, FactorsAreThoseOfTheAsset) {
  const render::Scene scene = drawn(
      R"({"name": "skin", "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 0.75],
 "metallicFactor": 0.5, "roughnessFactor": 0.25}, "emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK", "alphaCutoff": 0.25, "doubleSided": true,
 "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}, "KHR_materials_ior": {"ior": 1.25},
 "KHR_materials_sheen": {"sheenColorFactor": [0.5, 0, 0]}, "KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceThicknessMinimum": 50},
 "KHR_materials_volume": {"thicknessFactor": 2, "attenuationDistance": 0.5, "attenuationColor": [0.5, 1, 1]},
 "KHR_materials_transmission": {"transmissionFactor": 0.5}, "KHR_materials_dispersion": {"dispersion": 1}}})");
  ASSERT_THAT(scene.materials, SizeIs(1));
  const render::SceneMaterial& m = scene.materials[0];
  EXPECT_EQ(scene.meshes.at(0).material, 0U);
  EXPECT_EQ(m.name, "skin");
  EXPECT_EQ(m.factors.base_color, Rgb(0.5, 0.25, 0.125));
  EXPECT_EQ(m.alpha, 0.75F);
  EXPECT_EQ(m.factors.metallic, 0.5);
  EXPECT_EQ(m.factors.roughness, 0.25);
  EXPECT_EQ(m.factors.emissive, Rgb(4, 2, 0));
  EXPECT_EQ(m.alpha_mode, render::AlphaMode::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.25F);
  EXPECT_TRUE(m.double_sided);
  EXPECT_EQ(m.factors.ior, 1.25);
  EXPECT_EQ(m.factors.sheen_color, Rgb(0.5, 0, 0));
  EXPECT_EQ(m.factors.iridescence_thickness, 400);
  EXPECT_EQ(m.iridescence_thickness_minimum, 50);
  EXPECT_EQ(m.factors.thickness, 2);
  EXPECT_EQ(m.factors.attenuation_distance, 0.5);
  EXPECT_EQ(m.factors.transmission, 0.5);
  EXPECT_EQ(m.factors.dispersion, 1);
  EXPECT_EQ(m.factors.scattering, Scattering::none);
}

// What a user of <gltfx/material.hpp> gets without saying anything is what a file gets.
TEST(SceneMaterials, DefaultsOfTheLibraryAreThoseOfTheSchemas) {
  const render::SceneMaterial read = drawn("{}").materials.at(0);
  const render::SceneMaterial plain;
  for (std::size_t i = 0; i < kMaterialParameters; ++i) {
    // Without scattering its strength counts for nothing.
    if (i == static_cast<std::size_t>(MaterialParameter::scatter_strength)) continue;
    const auto& member = render::kParameterMembers[i];
    if (const auto* number = std::get_if<double Material::*>(&member)) {
      EXPECT_EQ(read.factors.**number,
                static_cast<double>(static_cast<float>(plain.factors.**number)))
          << i;
    } else if (const auto* color = std::get_if<Rgb Material::*>(&member)) {
      EXPECT_EQ(read.factors.**color, plain.factors.**color) << i;
    } else if (const auto* single = std::get_if<float render::SceneMaterial::*>(&member)) {
      EXPECT_EQ(read.**single, plain.**single) << i;
    }
  }
}

TEST(SceneMaterials, OneTextSaysHowLightScatters) {
  const auto factors = [](const std::string& extensions) {
    return drawn(R"({"extensions": {)" + extensions + "}}").materials.at(0).factors;
  };
  const std::string distance =
      R"("KHR_materials_sss": {"scatterDistance": 0.5, "scatterColor": [0.5, 0.5, 1]})";
  const std::string multiscatter =
      R"("KHR_materials_volume_scatter": {"multiscatterColor": [0.25, 0.5, 1], "scatterAnisotropy": 0.5})";
  const std::string unified =
      R"("KHR_materials_scatter": {"scatterStrengthFactor": 0.5, "multiscatterColorFactor": [1, 0.5, 1]})";
  const Material sss = factors(distance);
  EXPECT_EQ(sss.scattering, Scattering::distance);
  EXPECT_EQ(sss.scatter_distance, 0.5);
  EXPECT_EQ(sss.scatter_color, Rgb(0.5, 0.5, 1));
  const Material volume = factors(distance + ", " + multiscatter);
  EXPECT_EQ(volume.scattering, Scattering::multiscatter);
  EXPECT_EQ(volume.scatter_color, Rgb(0.25, 0.5, 1));
  EXPECT_EQ(volume.scatter_anisotropy, 0.5);
  const Material latest = factors(distance + ", " + multiscatter + ", " + unified);
  EXPECT_EQ(latest.scattering, Scattering::unified);
  EXPECT_EQ(latest.scatter_strength, 0.5);
  EXPECT_EQ(latest.scatter_color, Rgb(1, 0.5, 1));
  EXPECT_EQ(latest.scatter_anisotropy, 0);
}

TEST(SceneMaterials, TheFirstTranslucencyIsTintedByTheBaseColour) {
  const render::SceneMaterial first =
      drawn(
          R"({"extensions": {"KHR_materials_translucency": {"translucencyFactor": 0.5, "translucencyTexture": {"index": 0}}}})",
          image("image/png", kPng))
          .materials.at(0);
  EXPECT_TRUE(first.tinted_by_base_color);
  EXPECT_EQ(first.factors.diffuse_transmission, 0.5);
  EXPECT_EQ(first.use(Slot::diffuse_transmission).channel, 0U);
  const render::SceneMaterial later =
      drawn(
          R"({"extensions": {"KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5, "diffuseTransmissionTexture": {"index": 0}}}})",
          image("image/png", kPng))
          .materials.at(0);
  EXPECT_FALSE(later.tinted_by_base_color);
  EXPECT_EQ(later.use(Slot::diffuse_transmission).channel, render::kNone);
}

TEST(SceneMaterials, SpecularGlossinessTakesThePlaceOfTheBase) {
  const render::SceneMaterial m =
      drawn(
          R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "extensions": {"KHR_materials_pbrSpecularGlossiness":
 {"diffuseFactor": [0.5, 0.25, 0, 0.5], "specularFactor": [0.25, 0.5, 1], "glossinessFactor": 0.5, "specularGlossinessTexture": {"index": 1}}}})",
          image("image/png", kPng))
          .materials.at(0);
  EXPECT_TRUE(m.specular_glossiness);
  EXPECT_EQ(m.factors.base_color, Rgb(0.5, 0.25, 0));
  EXPECT_EQ(m.alpha, 0.5F);
  EXPECT_THAT(m.f0, ElementsAre(0.25F, 0.5F, 1));
  EXPECT_EQ(m.glossiness, 0.5F);
  EXPECT_EQ(m.use(Slot::base_color).texture, render::kNone);
  EXPECT_NE(m.use(Slot::specular_glossiness).texture, render::kNone);
}

TEST(SceneMaterials, OnlyMaterialsThatAreDrawnAreThere) {
  const render::Scene scene =
      drawn(R"({"name": "a"}, {"name": "b", "normalTexture": {"index": 0}})");
  ASSERT_THAT(scene.materials, SizeIs(1));
  EXPECT_EQ(scene.materials[0].name, "a");
  EXPECT_THAT(scene.textures, IsEmpty());
  EXPECT_THAT(scene.notes, IsEmpty());
}

TEST(SceneMaterials, AnAnimationReachesThem) {
  Accessors accessors = triangle();
  accessors.add("SCALAR", 5126, 2, test::floats({0, 1}));
  accessors.add("SCALAR", 5126, 2, test::floats({0, 1}));
  SceneOptions options;
  options.animation = 0;
  options.time = 0.25;
  const render::Scene scene = scene_of(
      accessors,
      test::one_mesh(R"("POSITION": 0)", R"(, "material": 0)") +
          R"(, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "materials": [{"pbrMetallicRoughness": {}}],
 "animations": [{"samplers": [{"input": 3, "output": 4}], "channels": [{"sampler": 0, "target": {"path": "pointer",
  "extensions": {"KHR_animation_pointer": {"pointer": "/materials/0/pbrMetallicRoughness/roughnessFactor"}}}}]}])",
      options);
  EXPECT_EQ(scene.materials.at(0).factors.roughness, 0.25);
}

TEST(SceneMaterials, AVariantChangesThem) {
  SceneOptions options;
  options.variant = 1;
  const render::Scene scene = scene_of(
      triangle(),
      test::one_mesh(R"("POSITION": 0)",
                     R"(, "material": 0, "extensions": {"KHR_materials_variants":
 {"mappings": [{"material": 1, "variants": [1]}]}})") +
          R"(, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "materials": [{"name": "a"}, {"name": "b"}])",
      options);
  EXPECT_EQ(scene.materials.at(0).name, "b");
}

TEST(SceneTextures, AnImageIsDecodedOnceForAllThatShowIt) {
  const render::Scene scene = drawn(
      R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 1}, "emissiveTexture": {"index": 0}})",
      image("image/png", kPng));
  EXPECT_THAT(scene.notes, IsEmpty());
  ASSERT_THAT(scene.textures, SizeIs(2));
  const render::SceneMaterial& m = scene.materials.at(0);
  EXPECT_EQ(m.use(Slot::base_color).texture, m.use(Slot::emissive).texture);
  const render::Texture& plain = scene.textures[m.use(Slot::base_color).texture];
  const render::Texture& other = scene.textures[m.use(Slot::normal).texture];
  EXPECT_EQ(plain.pixels.data(), other.pixels.data());
  EXPECT_EQ(plain.width, 2U);
  EXPECT_EQ(plain.height, 1U);
  EXPECT_EQ(plain.channels, 3U);
  EXPECT_EQ(plain.bits, 8U);
  EXPECT_FALSE(plain.missing);
  ASSERT_EQ(plain.pixels.size(), 6U);
  EXPECT_EQ(plain.pixels[0], std::byte{0xff});
  EXPECT_EQ(plain.wrap_s, render::Wrap::repeat);
  EXPECT_EQ(plain.filter, render::Filter::linear);
  EXPECT_EQ(other.wrap_s, render::Wrap::clamp_to_edge);
  EXPECT_EQ(other.wrap_t, render::Wrap::mirrored_repeat);
  EXPECT_EQ(other.filter, render::Filter::nearest);
}

TEST(SceneTextures, WhatCannotBeHadIsMarkedAndNamed) {
  const std::string material = R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})";
  const auto missing = [&](const std::string& images, const std::string& textures,
                           const std::string& why) {
    const render::Scene scene = drawn(material, images, {}, textures);
    ASSERT_THAT(scene.textures, SizeIs(1));
    EXPECT_TRUE(scene.textures[0].missing) << why;
    EXPECT_THAT(scene.notes,
                testing::Contains(testing::AllOf(HasSubstr(why), HasSubstr("checker"))));
  };
  missing(R"({"uri": "away.png"})", {}, "missing image");
  missing({}, R"({})", "has no image");
  missing(image("image/png", "nothing of the kind"), {}, "unknown format");
  missing(image("image/ktx2", std::string("\xabKTX 20\xbb\r\n\x1a\n", 12) + std::string(100, '\0')),
          {}, "invalid header");
  missing(image("image/png", kPng.substr(0, kPng.size() - 30)), {}, "cannot be decoded");
}

TEST(SceneTextures, Ktx2IsDrawn) {
  std::ifstream file(GLTFX_SOURCE_DIR "/tests/codec/basis/etc1s-smoke-24x24-128.ktx2",
                     std::ios::binary);
  const render::Scene scene =
      drawn(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
            image("image/ktx2", std::string(std::istreambuf_iterator<char>(file), {})), {},
            R"({"extensions": {"KHR_texture_basisu": {"source": 0}}})");
  ASSERT_THAT(scene.textures, SizeIs(1));
  EXPECT_FALSE(scene.textures[0].missing);
  EXPECT_EQ(scene.textures[0].width, 24U);
  EXPECT_EQ(scene.textures[0].channels, 4U);
  EXPECT_THAT(scene.notes, IsEmpty());
}

TEST(SceneTextures, AnotherFormatOfThePictureWillDo) {
  const render::Scene scene = drawn(
      R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
      image("image/png", kPng) + ", " +
          image("image/ktx2", std::string("\xabKTX 20\xbb\r\n\x1a\n", 12) + std::string(100, '\0')),
      {}, R"({"source": 0, "extensions": {"KHR_texture_basisu": {"source": 1}}})");
  EXPECT_FALSE(scene.textures.at(0).missing);
  EXPECT_THAT(scene.notes, IsEmpty());
}

TEST(SceneTextures, PixelsBeyondMemoryAreNotDecoded) {
  SceneOptions options;
  options.free_pixel_bytes = 0;  // what the bytes of the asset are worth is left
  std::string header = kPng;
  header[16 + 2] = '\x7f';  // a width of some thousands
  header[20 + 2] = '\x7f';
  const render::Scene scene =
      drawn(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})",
            image("image/png", header), {}, {}, options);
  EXPECT_TRUE(scene.textures.at(0).missing);
  EXPECT_THAT(scene.notes, testing::Contains(HasSubstr("too much memory")));
}

TEST(TexCoords, AMeshHasThoseThatItsMaterialReads) {
  const render::Scene scene = drawn(
      R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "texCoord": 7}}, "emissiveTexture": {"index": 0, "texCoord": 4000000000},
 "occlusionTexture": {"index": 0, "texCoord": 3}})",
      image("image/png", kPng), R"(, "TEXCOORD_7": 2)");
  const render::SceneMaterial& m = scene.materials.at(0);
  ASSERT_THAT(scene.meshes.at(0).uvs, SizeIs(2));
  EXPECT_EQ(m.use(Slot::base_color).uv_set, 0U);
  EXPECT_EQ(m.use(Slot::emissive).uv_set, 1U);
  EXPECT_THAT(scene.meshes[0].uvs[0], SizeIs(3));
  EXPECT_THAT(scene.meshes[0].uvs[1], IsEmpty());
}

TEST(TexCoords, ATransformTurnsCounterClockwiseAsSeen) {
  const auto moved = [](const std::string& transform, float u, float v) {
    const render::Scene scene =
        drawn(R"({"emissiveTexture": {"index": 0, "extensions": {"KHR_texture_transform": )" +
                  transform + "}}}",
              image("image/png", kPng));
    const auto& m = scene.materials.at(0).use(Slot::emissive).transform;
    return Float2{m[0][0] * u + m[0][1] * v + m[0][2], m[1][0] * u + m[1][1] * v + m[1][2]};
  };
  EXPECT_THAT(moved(R"({"offset": [3, 4], "scale": [2, 5]})", 1, 1), ElementsAre(5, 9));
  // The text's own example: the lower left quarter of the image, turned by a quarter.
  const std::string example =
      R"({"offset": [0, 1], "rotation": 1.57079632679, "scale": [0.5, 0.5]})";
  EXPECT_THAT(moved(example, 0, 0), ElementsAre(FloatNear(0, 1e-6F), FloatNear(1, 1e-6F)));
  EXPECT_THAT(moved(example, 1, 1), ElementsAre(FloatNear(0.5F, 1e-6F), FloatNear(0.5F, 1e-6F)));
}

TEST(Tangents, AreMadeForNormalMapsAlone) {
  const auto tangents = [](const std::string& material, const std::string& attributes = {}) {
    return drawn(material, image("image/png", kPng), attributes).meshes.at(0).tangents;
  };
  EXPECT_THAT(tangents(R"({"emissiveTexture": {"index": 0}})"), IsEmpty());
  EXPECT_THAT(tangents(R"({"normalTexture": {"index": 0}})"), Each(ElementsAre(1, 0, 0, 1)));
  EXPECT_THAT(tangents(R"({"normalTexture": {"index": 0, "texCoord": 5}})"), IsEmpty())
      << "no such coordinates";
  EXPECT_THAT(
      tangents(R"({"extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 1}}})"),
      Each(ElementsAre(1, 0, 0, 1)));
  EXPECT_THAT(
      tangents(
          R"({"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatNormalTexture": {"index": 0}}}})"),
      SizeIs(3));
  // Where the map is turned, so are they.
  EXPECT_THAT(
      tangents(
          R"({"normalTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"rotation": 3.14159265}}}})"),
      Each(ElementsAre(FloatNear(-1, 1e-6F), FloatNear(0, 1e-6F), FloatNear(0, 1e-6F), 1)));
}

TEST(Tangents, AreNotMadeForFlatTriangles) {
  const render::Scene scene = scene_of(
      triangle(),
      test::one_mesh(R"("POSITION": 0, "TEXCOORD_0": 2)", R"(, "material": 0)") +
          R"(, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "materials": [{"normalTexture": {"index": 0}}],
 "textures": [{"source": 0}], "images": [)" +
          image("image/png", kPng) + "]");
  EXPECT_THAT(scene.meshes.at(0).normals, IsEmpty());
  EXPECT_THAT(scene.meshes.at(0).tangents, IsEmpty());
}

}  // namespace
}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
// Materials, textures, lights, cameras and variants as numbers.
#include "model/material.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/asset_text.hpp"
#include "model/camera.hpp"
#include "model/light.hpp"
#include "model/variants.hpp"
#include "model/views.hpp"

namespace gltfx::model {
namespace {

using test::AssetText;
using testing::ElementsAre;
using testing::FloatEq;
using testing::IsEmpty;

using Parameter = MaterialParameter;
using Color = std::array<float, 3>;

const std::string kTextures = R"("textures": [{}, {}, {}, {}])";

Material material(const std::string& object, const AnimatedValues& animated = {}) {
  const AssetText file(R"({"materials": [)" + object + "], " + kTextures + "}");
  return read_material(file.asset, 0, &animated);
}
Material extended(const std::string& extensions) {
  return material(R"({"extensions": {)" + extensions + "}}");
}

float number(const Material& m, Parameter parameter) { return m.of(parameter)[0]; }
Color color(const Material& m, Parameter parameter) {
  const auto& of = m.of(parameter);
  return {of[0], of[1], of[2]};
}
auto textures(const Material& m) {
  return std::count_if(m.slots.begin(), m.slots.end(),
                       [](const TextureSlot& slot) { return slot.texture.has_value(); });
}

TEST(Material, DefaultsAreThoseOfTheSpecification) {
  const Material m = material("{}");
  EXPECT_THAT(m.of(Parameter::base_color), ElementsAre(1, 1, 1, 1));
  EXPECT_EQ(number(m, Parameter::metallic), 1);
  EXPECT_EQ(number(m, Parameter::roughness), 1);
  EXPECT_THAT(color(m, Parameter::emissive), ElementsAre(0, 0, 0));
  EXPECT_EQ(number(m, Parameter::emissive_strength), 1);
  EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(number(m, Parameter::alpha_cutoff), 0.5F);
  EXPECT_FALSE(m.double_sided || m.unlit || m.specular_glossiness);
  EXPECT_EQ(number(m, Parameter::ior), 1.5F);
  EXPECT_EQ(number(m, Parameter::specular), 1);
  EXPECT_THAT(color(m, Parameter::specular_color), ElementsAre(1, 1, 1));
  EXPECT_TRUE(std::isinf(number(m, Parameter::attenuation_distance)));
  EXPECT_TRUE(std::isinf(number(m, Parameter::scatter_distance)));
  EXPECT_EQ(number(m, Parameter::iridescence_ior), 1.3F);
  EXPECT_FALSE(m.first_generation);
  EXPECT_EQ(textures(m), 0);
}

TEST(Material, CoreMembers) {
  const Material m = material(R"({"name": "oak", "pbrMetallicRoughness": {
 "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.6,
 "baseColorTexture": {"index": 1, "texCoord": 2}, "metallicRoughnessTexture": {"index": 2}},
 "normalTexture": {"index": 3, "scale": 2},
 "emissiveTexture": {"index": 9}, "emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK",
 "alphaCutoff": 0.75, "doubleSided": true})");
  EXPECT_EQ(m.name, "oak");
  EXPECT_THAT(m.of(Parameter::base_color), ElementsAre(0.1F, 0.2F, 0.3F, 0.4F));
  EXPECT_EQ(number(m, Parameter::metallic), 0.5F);
  EXPECT_EQ(number(m, Parameter::roughness), 0.6F);
  EXPECT_EQ(m.of(MaterialSlot::base_color).texture, 1U);
  EXPECT_EQ(m.of(MaterialSlot::base_color).tex_coord, 2U);
  EXPECT_EQ(m.of(MaterialSlot::metallic_roughness).texture, 2U);
  EXPECT_EQ(m.of(MaterialSlot::normal).texture, 3U);
  EXPECT_EQ(number(m, Parameter::normal_scale), 2);
  EXPECT_FALSE(m.of(MaterialSlot::emissive).texture) << "there is no texture 9";
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(number(m, Parameter::alpha_cutoff), 0.75F);
  EXPECT_TRUE(m.double_sided);
}

TEST(Material, NumbersOutOfRangeAreBroughtIntoIt) {
  const Material m =
      material(R"({"pbrMetallicRoughness": {"metallicFactor": 7, "roughnessFactor": -1},
 "emissiveFactor": [2, 0, "x"], "extensions": {"KHR_materials_ior": {"ior": 0.5},
 "KHR_materials_volume": {"attenuationDistance": 0}, "KHR_materials_dispersion": {"dispersion": 1e300}}})");
  EXPECT_EQ(number(m, Parameter::metallic), 1);
  EXPECT_EQ(number(m, Parameter::roughness), 0);
  EXPECT_THAT(color(m, Parameter::emissive), ElementsAre(0, 0, 0));
  EXPECT_EQ(number(m, Parameter::ior), 1);
  EXPECT_TRUE(std::isinf(number(m, Parameter::attenuation_distance)));
  EXPECT_TRUE(std::isfinite(number(m, Parameter::dispersion)));
}

TEST(Material, LayersOfExtensions) {
  const Material m = extended(R"("KHR_materials_ior": {"ior": 0},
 "KHR_materials_emissive_strength": {"emissiveStrength": 5},
 "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [2, 1, 0], "specularTexture": {"index": 0}, "specularColorTexture": {"index": 1}},
 "KHR_materials_sheen": {"sheenColorFactor": [0.1, 0.2, 0.3], "sheenRoughnessFactor": 0.4, "sheenColorTexture": {"index": 0}, "sheenRoughnessTexture": {"index": 1}},
 "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatRoughnessFactor": 0.25, "clearcoatTexture": {"index": 1}, "clearcoatRoughnessTexture": {"index": 2}, "clearcoatNormalTexture": {"index": 3, "scale": 0.5}},
 "KHR_materials_anisotropy": {"anisotropyStrength": 0.75, "anisotropyRotation": 1.5, "anisotropyTexture": {"index": 2}},
 "KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.4, "iridescenceThicknessMinimum": 200, "iridescenceThicknessMaximum": 300, "iridescenceTexture": {"index": 0}, "iridescenceThicknessTexture": {"index": 3}},
 "KHR_materials_dispersion": {"dispersion": 0.5},
 "KHR_materials_transmission": {"transmissionFactor": 0.9, "transmissionTexture": {"index": 1}})");
  EXPECT_EQ(number(m, Parameter::ior), 0) << "zero has a meaning of its own";
  EXPECT_EQ(number(m, Parameter::emissive_strength), 5);
  EXPECT_THAT(color(m, Parameter::specular_color), ElementsAre(2, 1, 0));
  EXPECT_THAT(color(m, Parameter::sheen_color), ElementsAre(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(number(m, Parameter::sheen_roughness), 0.4F);
  EXPECT_EQ(number(m, Parameter::clearcoat_roughness), 0.25F);
  EXPECT_EQ(number(m, Parameter::clearcoat_normal_scale), 0.5F);
  EXPECT_EQ(number(m, Parameter::anisotropy_rotation), 1.5F);
  EXPECT_EQ(number(m, Parameter::iridescence_thickness_minimum), 200);
  EXPECT_EQ(m.of(MaterialSlot::iridescence_thickness).texture, 3U);
  EXPECT_EQ(number(m, Parameter::dispersion), 0.5F);
  EXPECT_EQ(number(m, Parameter::transmission), 0.9F);
  EXPECT_EQ(textures(m), 11);
}

TEST(Material, Media) {
  const Material m = extended(R"(
 "KHR_materials_volume": {"thicknessFactor": 2, "attenuationDistance": 0.5, "attenuationColor": [0.9, 0.8, 0.7], "thicknessTexture": {"index": 0}})");
  EXPECT_EQ(number(m, Parameter::thickness), 2);
  EXPECT_EQ(number(m, Parameter::attenuation_distance), 0.5F);
  EXPECT_THAT(color(m, Parameter::attenuation_color), ElementsAre(0.9F, 0.8F, 0.7F));
  EXPECT_EQ(m.of(MaterialSlot::thickness).texture, 0U);
  EXPECT_EQ(m.scattering, Scattering::none);
}

TEST(Material, OfSeveralTextsAboutScatteringTheLatestThatScattersCounts) {
  const std::string distance =
      R"("KHR_materials_sss": {"scatterDistance": 0.01, "scatterColor": [0.5, 0.25, 0.125]})";
  const std::string multiscatter =
      R"(, "KHR_materials_volume_scatter": {"multiscatterColorFactor": [0.1, 0.2, 0.3], "scatterAnisotropy": -2})";
  const std::string unified =
      R"(, "KHR_materials_scatter": {"scatterFactor": 0.5, "scatterTexture": {"index": 2}, "multiscatterColorFactor": [0.3, 0.2, 0.1], "scatterAnisotropy": 0.5})";
  const Material first = extended(distance);
  EXPECT_EQ(first.scattering, Scattering::distance);
  EXPECT_EQ(number(first, Parameter::scatter_distance), 0.01F);
  EXPECT_THAT(color(first, Parameter::scatter_color), ElementsAre(0.5F, 0.25F, 0.125F));
  const Material second = extended(distance + multiscatter);
  EXPECT_EQ(second.scattering, Scattering::multiscatter);
  EXPECT_THAT(color(second, Parameter::scatter_color), ElementsAre(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(number(second, Parameter::scatter_anisotropy), -0.999F);
  const Material third = extended(distance + multiscatter + unified);
  EXPECT_EQ(third.scattering, Scattering::unified);
  EXPECT_EQ(number(third, Parameter::scatter_strength), 0.5F);
  EXPECT_EQ(third.of(MaterialSlot::scatter_strength).texture, 2U);
  EXPECT_THAT(color(third, Parameter::scatter_color), ElementsAre(0.3F, 0.2F, 0.1F));
  EXPECT_EQ(number(third, Parameter::scatter_anisotropy), 0.5F);
  const Material off = extended(distance + R"(, "KHR_materials_volume_scatter": {},
 "KHR_materials_scatter": {"scatterTexture": {"index": 2}})");
  EXPECT_EQ(off.scattering, Scattering::distance);
  EXPECT_FALSE(off.of(MaterialSlot::scatter_strength).texture);
  const Material renamed = extended(R"("KHR_materials_subsurface": {"scatterDistance": 3},
 "KHR_materials_volume_scatter": {"multiscatterColor": [0.5, 0.5, 0.5]})");
  EXPECT_THAT(color(renamed, Parameter::scatter_color), ElementsAre(0.5F, 0.5F, 0.5F));
}

TEST(Material, SpecularGlossiness) {
  const Material m =
      extended(R"("KHR_materials_pbrSpecularGlossiness": {"diffuseFactor": [0.1, 0.2, 0.3, 0.4],
 "specularFactor": [0.5, 0.6, 0.7], "glossinessFactor": 0.8, "diffuseTexture": {"index": 1},
 "specularGlossinessTexture": {"index": 2}}, "KHR_materials_specular": {"specularTexture": {"index": 0}},
 "KHR_materials_unlit": {})");
  ASSERT_TRUE(m.specular_glossiness);
  EXPECT_THAT(m.of(Parameter::base_color), ElementsAre(0.1F, 0.2F, 0.3F, 0.4F));
  EXPECT_THAT(color(m, Parameter::f0), ElementsAre(0.5F, 0.6F, 0.7F));
  EXPECT_EQ(number(m, Parameter::glossiness), 0.8F);
  EXPECT_EQ(m.of(MaterialSlot::base_color).texture, 1U);
  EXPECT_EQ(m.of(MaterialSlot::specular_glossiness).texture, 2U);
  EXPECT_FALSE(m.of(MaterialSlot::specular).texture) << "it has a specular map of its own";
  EXPECT_TRUE(m.unlit);
}

TEST(Material, DiffuseTransmissionAndItsForerunners) {
  const Material now =
      extended(R"("KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5,
 "diffuseTransmissionColorFactor": [0.1, 0.2, 0.3], "diffuseTransmissionTexture": {"index": 1},
 "diffuseTransmissionColorTexture": {"index": 2}}, "KHR_materials_translucency": {"translucencyFactor": 1})");
  EXPECT_EQ(number(now, Parameter::diffuse_transmission), 0.5F);
  EXPECT_FALSE(now.first_generation);
  EXPECT_THAT(color(now, Parameter::diffuse_transmission_color), ElementsAre(0.1F, 0.2F, 0.3F));
  EXPECT_EQ(now.of(MaterialSlot::diffuse_transmission).texture, 1U);
  EXPECT_EQ(now.of(MaterialSlot::diffuse_transmission_color).texture, 2U);

  const std::string base =
      R"("pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.6, 0.7, 1], "baseColorTexture": {"index": 3}})";
  const Material first = material(
      "{" + base +
      R"(, "extensions": {"KHR_materials_translucency": {"translucencyFactor": 0.75, "translucencyTexture": 0}}})");
  EXPECT_EQ(number(first, Parameter::diffuse_transmission), 0.75F);
  EXPECT_TRUE(first.first_generation);
  EXPECT_EQ(first.of(MaterialSlot::diffuse_transmission).texture, 0U) << "a bare index";

  for (const std::string name : {"KHR_materials_translucency", "3DS_materials_translucency"}) {
    const Material later = material(
        "{" + base + R"(, "extensions": {")" + name +
        R"(": {"translucencyFactor": 0.25, "translucencyColorFactor": [0.5, 1, 1], "translucencyTexture": {"index": 1}}}})");
    EXPECT_EQ(number(later, Parameter::diffuse_transmission), 0.25F);
    EXPECT_FALSE(later.first_generation);
    EXPECT_THAT(color(later, Parameter::diffuse_transmission_color), ElementsAre(0.5F, 1, 1));
    EXPECT_FALSE(later.of(MaterialSlot::diffuse_transmission_color).texture);
  }
}

TEST(Material, AnAnimationTakesThePlaceOfWhatIsWritten) {
  const AnimatedValues animated{
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", {0, 0.5F, 2, 1}},
      {"/materials/0/emissiveFactor", {1, 1}},
      {"/materials/0/normalTexture/scale", {3}},
      {"/materials/0/normalTexture/extensions/KHR_texture_transform/offset", {4, 5}},
      {"/materials/0/extensions/KHR_materials_ior/ior", {2}},
      {"/materials/00/alphaCutoff", {0.25F}},
      {"/materials/1/alphaCutoff", {0.25F}}};
  const Material m = material(R"({"emissiveFactor": [0.5, 0, 0], "normalTexture": {"index": 0,
 "extensions": {"KHR_texture_transform": {"rotation": 1}}}, "extensions": {"KHR_materials_ior": {}}})",
                              animated);
  EXPECT_THAT(m.of(Parameter::base_color), ElementsAre(0, 0.5F, 1, 1)) << "limited like any other";
  EXPECT_THAT(color(m, Parameter::emissive), ElementsAre(0.5F, 0, 0))
      << "two numbers are no colour";
  EXPECT_EQ(number(m, Parameter::normal_scale), 3);
  EXPECT_THAT(m.of(MaterialSlot::normal).offset, ElementsAre(4, 5));
  EXPECT_EQ(m.of(MaterialSlot::normal).rotation, 1);
  EXPECT_EQ(number(m, Parameter::ior), 2);
  EXPECT_EQ(number(m, Parameter::alpha_cutoff), 0.5F);
}

TEST(Texture, SamplersHaveTheirNumbers) {
  const AssetText file(R"({"images": [{}, {}], "samplers": [
 {"wrapS": 33071, "wrapT": 33648, "magFilter": 9728, "minFilter": 9728},
 {"minFilter": 9985}, {"minFilter": 9986}, {"minFilter": 9729, "wrapS": 10497}],
 "textures": [{"source": 1}, {"sampler": 0, "source": 7}, {"sampler": 1}, {"sampler": 2}, {"sampler": 3},
  {"source": 0, "extensions": {"EXT_texture_webp": {"source": 1}, "VENDOR_other": 3}}]})");
  const auto read = [&](std::size_t i) {
    return read_texture(file.asset, file.asset.elements(RootArray::textures)[i]);
  };
  EXPECT_EQ(read(0).sampler, Sampler());
  EXPECT_THAT(read(0).images, ElementsAre(1));
  EXPECT_EQ(read(1).sampler, (Sampler{Wrap::clamp_to_edge, Wrap::mirrored_repeat, Filter::nearest,
                                      Filter::nearest, false, Filter::linear}));
  EXPECT_THAT(read(1).images, IsEmpty());
  EXPECT_EQ(read(2).sampler.minify, Filter::linear);
  EXPECT_EQ(read(2).sampler.between_mipmaps, Filter::nearest);
  EXPECT_EQ(read(3).sampler.minify, Filter::nearest);
  EXPECT_EQ(read(3).sampler.between_mipmaps, Filter::linear);
  EXPECT_FALSE(read(4).sampler.mipmaps);
  EXPECT_THAT(read(5).images, ElementsAre(1, 0)) << "the format of the extension comes first";
}

TEST(Texture, TransformsMayReplaceTheSet) {
  const Material m = material(R"({"normalTexture": {"index": 0, "texCoord": 1, "extensions":
 {"KHR_texture_transform": {"offset": [0.5, 1], "rotation": 0.25, "scale": [2, 3], "texCoord": 4}}}})");
  EXPECT_EQ(m.of(MaterialSlot::normal).tex_coord, 4U);
  EXPECT_THAT(m.of(MaterialSlot::normal).offset, ElementsAre(0.5F, 1));
  EXPECT_EQ(m.of(MaterialSlot::normal).rotation, 0.25F);
  EXPECT_THAT(m.of(MaterialSlot::normal).scale, ElementsAre(2, 3));
}

TEST(Lights, KindsAndDefaults) {
  const AssetText file(R"({"nodes": [{"extensions": {"KHR_lights_punctual": {"light": 1}}}, {}],
 "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "color": [1, 0, 0], "intensity": 3},
 {"type": "spot", "spot": {"innerConeAngle": 0.9, "outerConeAngle": 0.5}, "range": 7}, {"type": "moon"}, {"type": "point", "name": "lamp"}]}}})");
  const auto lights = read_lights(file.asset);
  ASSERT_EQ(lights.size(), 4U);
  EXPECT_EQ(lights[0]->type, LightType::directional);
  EXPECT_EQ(lights[0]->intensity, 3);
  EXPECT_THAT(lights[0]->color, ElementsAre(1, 0, 0));
  EXPECT_EQ(lights[1]->range, 7);
  EXPECT_EQ(lights[1]->inner_cone_angle, 0.5F) << "never beyond the outer one";
  EXPECT_FALSE(lights[2]);
  EXPECT_EQ(lights[3]->name, "lamp");
  EXPECT_TRUE(std::isinf(lights[3]->range));
  EXPECT_FLOAT_EQ(lights[3]->outer_cone_angle, 0.7853982F);
  const Views views(file.asset);
  EXPECT_EQ(light_of(file.asset, views.nodes[0]), 1U);
  EXPECT_FALSE(light_of(file.asset, views.nodes[1]));
  const AnimatedValues bright{{"/extensions/KHR_lights_punctual/lights/3/intensity", {9}}};
  EXPECT_EQ(read_lights(file.asset, &bright)[3]->intensity, 9);
}

TEST(Cameras, BothProjections) {
  const AssetText file(R"({"cameras": [
 {"type": "perspective", "name": "eye", "perspective": {"yfov": 0.5, "znear": 0.1, "aspectRatio": 2}},
 {"type": "orthographic", "orthographic": {"xmag": -2, "ymag": 1, "znear": 0, "zfar": 10}},
 {"type": "perspective", "perspective": {"yfov": 4}}, {"type": "orthographic"}]})");
  const auto eye = read_camera(file.asset, 0);
  ASSERT_TRUE(eye);
  EXPECT_EQ(eye->name, "eye");
  EXPECT_TRUE(eye->perspective);
  EXPECT_EQ(eye->y_fov, 0.5F);
  EXPECT_EQ(eye->aspect_ratio, 2);
  EXPECT_EQ(eye->z_near, 0.1F);
  EXPECT_TRUE(std::isinf(eye->z_far));
  const auto plan = read_camera(file.asset, 1);
  ASSERT_TRUE(plan);
  EXPECT_FALSE(plan->perspective);
  EXPECT_EQ(plan->x_mag, 2);
  EXPECT_EQ(plan->z_far, 10);
  EXPECT_FALSE(read_camera(file.asset, 2));
  EXPECT_FALSE(read_camera(file.asset, 3));
}

TEST(Variants, MappingsChooseTheMaterial) {
  const AssetText file(
      R"({"extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "blue"}, {}]}},
 "materials": [{}, {}, {}], "meshes": [{"primitives": [{"attributes": {}, "material": 0, "extensions":
 {"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0, 2]}, {"material": 9, "variants": [1]}]}}}]}]})");
  EXPECT_THAT(variant_names(file.asset), ElementsAre("red", "blue", ""));
  const Views views(file.asset);
  const Primitive& primitive = views.meshes[0].primitives[0];
  EXPECT_EQ(material_of(file.asset, primitive, std::nullopt), 0U);
  EXPECT_EQ(material_of(file.asset, primitive, 0), 1U);
  EXPECT_EQ(material_of(file.asset, primitive, 2), 1U);
  EXPECT_EQ(material_of(file.asset, primitive, 1), 0U) << "there is no material 9";
  EXPECT_EQ(material_of(file.asset, primitive, 7), 0U);
}

}  // namespace
}  // namespace gltfx::model

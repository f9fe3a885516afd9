// SPDX-License-Identifier: Apache-2.0
#include "model/material.hpp"

#include <array>
#include <cmath>

#include "model/fields.hpp"

namespace gltfx::model {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// The phase function of a medium has no value at the very ends.
constexpr Limits kAnisotropyLimits{-0.999F, 0.999F};

class MaterialReader {
 public:
  MaterialReader(const Asset& asset, const Properties& material)
      : asset_(asset), material_(material) {}

  Material read() {
    read_core();
    read_specular_glossiness();
    read_diffuse_transmission();
    read_media();
    read_layers();
    return result_;
  }

 private:
  TextureSlot slot(const Properties& owner, std::string_view name) const {
    return read_slot(asset_, owner, name);
  }

  AlphaMode alpha_mode() const {
    const std::string mode = string_member(asset_.document(), material_.node(), "alphaMode");
    if (mode == "MASK") return AlphaMode::mask;
    return mode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
  }

  void read_core() {
    const Properties pbr = material_.object("pbrMetallicRoughness");
    result_.name = asset_.name(material_.node());
    result_.base_color_factor =
        pbr.numbers("baseColorFactor", result_.base_color_factor, kUnitLimits);
    result_.base_color_texture = slot(pbr, "baseColorTexture");
    result_.metallic_factor = pbr.number("metallicFactor", 1, kUnitLimits);
    result_.roughness_factor = pbr.number("roughnessFactor", 1, kUnitLimits);
    result_.metallic_roughness_texture = slot(pbr, "metallicRoughnessTexture");
    result_.normal_texture = slot(material_, "normalTexture");
    result_.normal_scale = material_.object("normalTexture").number("scale", 1);
    result_.occlusion_texture = slot(material_, "occlusionTexture");
    result_.occlusion_strength =
        material_.object("occlusionTexture").number("strength", 1, kUnitLimits);
    result_.emissive_texture = slot(material_, "emissiveTexture");
    result_.emissive_factor = material_.numbers<3>("emissiveFactor", {0, 0, 0}, kUnitLimits);
    result_.alpha_mode = alpha_mode();
    result_.alpha_cutoff = material_.number("alphaCutoff", 0.5F, kPositiveLimits);
    result_.double_sided = material_.flag("doubleSided", false);
    result_.unlit = material_.extension("KHR_materials_unlit").exists();
    result_.emissive_strength = material_.extension("KHR_materials_emissive_strength")
                                    .number("emissiveStrength", 1, kPositiveLimits);
  }

  void read_specular_glossiness() {
    const Properties from = material_.extension("KHR_materials_pbrSpecularGlossiness");
    if (!from.exists()) return;
    SpecularGlossiness& to = result_.specular_glossiness.emplace();
    to.diffuse_factor = from.numbers("diffuseFactor", to.diffuse_factor, kUnitLimits);
    to.diffuse_texture = slot(from, "diffuseTexture");
    to.specular_factor = from.numbers("specularFactor", to.specular_factor, kUnitLimits);
    to.glossiness_factor = from.number("glossinessFactor", 1, kUnitLimits);
    to.specular_glossiness_texture = slot(from, "specularGlossinessTexture");
  }

  void read_diffuse_transmission() {
    DiffuseTransmission& to = result_.diffuse_transmission;
    const Properties from = material_.extension("KHR_materials_diffuse_transmission");
    if (!from.exists()) return read_translucency();
    to.factor = from.number("diffuseTransmissionFactor", 0, kUnitLimits);
    to.texture = slot(from, "diffuseTransmissionTexture");
    to.color_factor = from.numbers("diffuseTransmissionColorFactor", to.color_factor, kUnitLimits);
    to.color_texture = slot(from, "diffuseTransmissionColorTexture");
  }

  // The forerunner under its two names. Its first generation has no colour of its own and the
  // factor in R; there, and later, texture slots were also written as bare indices.
  void read_translucency() {
    const bool renamed = !material_.extension("KHR_materials_translucency").exists();
    const Properties from =
        material_.extension(renamed ? "3DS_materials_translucency" : "KHR_materials_translucency");
    if (!from.exists()) return;
    DiffuseTransmission& to = result_.diffuse_transmission;
    to.factor = from.number("translucencyFactor", 0, kUnitLimits);
    to.texture = lenient_slot(from, "translucencyTexture");
    const bool own_color =
        renamed || has(from, "translucencyColorFactor") || has(from, "translucencyColorTexture");
    to.first_generation = !own_color;
    to.color_factor = from.numbers("translucencyColorFactor", to.color_factor, kUnitLimits);
    to.color_texture = lenient_slot(from, "translucencyColorTexture");
  }

  bool has(const Properties& owner, std::string_view name) const {
    return asset_.document().find(owner.node(), name) != json::kNoNode;
  }

  TextureSlot lenient_slot(const Properties& owner, std::string_view name) const {
    TextureSlot found = slot(owner, name);
    if (!found.texture) found.texture = asset_.index(owner.node(), name, RootArray::textures);
    return found;
  }

  void read_media() {
    const Properties volume = material_.extension("KHR_materials_volume");
    result_.volume.thickness_factor = volume.number("thicknessFactor", 0, kPositiveLimits);
    result_.volume.thickness_texture = slot(volume, "thicknessTexture");
    result_.volume.attenuation_distance = distance(volume, "attenuationDistance");
    result_.volume.attenuation_color =
        volume.numbers<3>("attenuationColor", {1, 1, 1}, kUnitLimits);
    Properties subsurface = material_.extension("KHR_materials_sss");
    if (!subsurface.exists()) read_subsurface(material_.extension("KHR_materials_subsurface"));
    read_subsurface(subsurface);
    const Properties scatter = material_.extension("KHR_materials_volume_scatter");
    VolumeScatter& medium = result_.volume_scatter;
    medium.multiscatter_color = scatter.numbers<3>(
        renamed(scatter, "multiscatterColor", "multiscatterColorFactor"), {0, 0, 0}, kUnitLimits);
    medium.multiscatter_color_texture = slot(scatter, "multiscatterColorTexture");
    medium.anisotropy = scatter.number("scatterAnisotropy", 0, kAnisotropyLimits);
    read_scatter();
  }

  void read_subsurface(const Properties& from) {
    if (!from.exists()) return;
    result_.subsurface.scatter_distance = distance(from, "scatterDistance");
    result_.subsurface.scatter_color = from.numbers<3>("scatterColor", {0, 0, 0}, kUnitLimits);
  }

  // Drafts changed names; the one that is there counts.
  std::string_view renamed(const Properties& owner, std::string_view name,
                           std::string_view other) const {
    return has(owner, name) ? name : other;
  }

  void read_scatter() {
    const Properties from = material_.extension("KHR_materials_scatter");
    Scatter& to = result_.scatter;
    to.strength_factor =
        from.number(renamed(from, "scatterStrengthFactor", "scatterFactor"), 0, kUnitLimits);
    to.strength_texture = slot(from, renamed(from, "scatterStrengthTexture", "scatterTexture"));
    to.multiscatter_color_factor =
        from.numbers("multiscatterColorFactor", to.multiscatter_color_factor, kUnitLimits);
    to.multiscatter_color_texture = slot(from, "multiscatterColorTexture");
    to.anisotropy = from.number("scatterAnisotropy", 0, kAnisotropyLimits);
  }

  // Infinite when absent; 0 is no distance.
  static float distance(const Properties& owner, std::string_view name) {
    const float metres = owner.number(name, kInfinity, kPositiveLimits);
    return metres > 0 ? metres : kInfinity;
  }

  void read_layers() {
    result_.ior = ior(material_.extension("KHR_materials_ior"), "ior", 1.5F);
    result_.dispersion =
        material_.extension("KHR_materials_dispersion").number("dispersion", 0, kPositiveLimits);
    const Properties transmission = material_.extension("KHR_materials_transmission");
    result_.transmission_factor = transmission.number("transmissionFactor", 0, kUnitLimits);
    result_.transmission_texture = slot(transmission, "transmissionTexture");
    read_specular(material_.extension("KHR_materials_specular"));
    read_sheen(material_.extension("KHR_materials_sheen"));
    read_clearcoat(material_.extension("KHR_materials_clearcoat"));
    read_iridescence(material_.extension("KHR_materials_iridescence"));
    const Properties anisotropy = material_.extension("KHR_materials_anisotropy");
    result_.anisotropy.strength = anisotropy.number("anisotropyStrength", 0, kUnitLimits);
    result_.anisotropy.rotation = anisotropy.number("anisotropyRotation", 0);
    result_.anisotropy.texture = slot(anisotropy, "anisotropyTexture");
  }

  // Indices are 0, which has a meaning of its own, or at least 1.
  static float ior(const Properties& owner, std::string_view name, float absent) {
    const float value = owner.number(name, absent, kPositiveLimits);
    return value > 0 && value < 1 ? 1 : value;
  }

  void read_specular(const Properties& from) {
    Specular& to = result_.specular;
    to.factor = from.number("specularFactor", 1, kUnitLimits);
    to.texture = slot(from, "specularTexture");
    to.color_factor = from.numbers("specularColorFactor", to.color_factor, kPositiveLimits);
    to.color_texture = slot(from, "specularColorTexture");
  }

  void read_sheen(const Properties& from) {
    Sheen& to = result_.sheen;
    to.color_factor = from.numbers("sheenColorFactor", to.color_factor, kUnitLimits);
    to.color_texture = slot(from, "sheenColorTexture");
    to.roughness_factor = from.number("sheenRoughnessFactor", 0, kUnitLimits);
    to.roughness_texture = slot(from, "sheenRoughnessTexture");
  }

  void read_clearcoat(const Properties& from) {
    Clearcoat& to = result_.clearcoat;
    to.factor = from.number("clearcoatFactor", 0, kUnitLimits);
    to.texture = slot(from, "clearcoatTexture");
    to.roughness_factor = from.number("clearcoatRoughnessFactor", 0, kUnitLimits);
    to.roughness_texture = slot(from, "clearcoatRoughnessTexture");
    to.normal_texture = slot(from, "clearcoatNormalTexture");
    to.normal_scale = from.object("clearcoatNormalTexture").number("scale", 1);
  }

  void read_iridescence(const Properties& from) {
    Iridescence& to = result_.iridescence;
    to.factor = from.number("iridescenceFactor", 0, kUnitLimits);
    to.texture = slot(from, "iridescenceTexture");
    to.ior = from.number("iridescenceIor", to.ior, {1, kPositiveLimits.most});
    to.thickness_minimum =
        from.number("iridescenceThicknessMinimum", to.thickness_minimum, kPositiveLimits);
    to.thickness_maximum =
        from.number("iridescenceThicknessMaximum", to.thickness_maximum, kPositiveLimits);
    to.thickness_texture = slot(from, "iridescenceThicknessTexture");
  }

  const Asset& asset_;
  const Properties& material_;
  Material result_;
};

}  // namespace

Material read_material(const Asset& asset, std::uint32_t index, const AnimatedValues* animated) {
  const Properties properties(asset.document(), asset.elements(RootArray::materials)[index],
                              animated, "/materials/" + std::to_string(index));
  return MaterialReader(asset, properties).read();
}

}  // namespace gltfx::model

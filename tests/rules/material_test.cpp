// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

Lines of_material(const std::string& material, Profile profile = Profile::standard) {
  return selected(asset_with(R"("materials": [)" + material + "]"),
                  {"MATERIAL_ALPHA_CUTOFF_INVALID_MODE", "VALUE_NOT_IN_RANGE", "VALUE_NOT_IN_LIST"},
                  profile);
}

TEST(Material, ACutoffNeedsTheMaskMode) {
  const Lines found{"MATERIAL_ALPHA_CUTOFF_INVALID_MODE /materials/0/alphaCutoff"};
  EXPECT_EQ(of_material(R"({"alphaCutoff": 0.5})"), found);
  EXPECT_EQ(of_material(R"({"alphaCutoff": 0.5, "alphaMode": "BLEND"})"), found);
  EXPECT_EQ(of_material(R"({"alphaCutoff": 0.5, "alphaMode": "MASK"})"), Lines{});
  EXPECT_EQ(of_material(R"({"alphaMode": "BLEND"})"), Lines{});
}

TEST(Material, AWrongCutoffOrModeIsReportedOnce) {
  EXPECT_EQ(of_material(R"({"alphaCutoff": -1})"),
            Lines{"VALUE_NOT_IN_RANGE /materials/0/alphaCutoff"});
  EXPECT_EQ(of_material(R"({"alphaCutoff": 1, "alphaMode": "mask"})"),
            Lines{"VALUE_NOT_IN_LIST /materials/0/alphaMode"});
  EXPECT_EQ(of_material(R"({"alphaCutoff": -1})", Profile::khronos),
            (Lines{"VALUE_NOT_IN_RANGE /materials/0/alphaCutoff",
                   "MATERIAL_ALPHA_CUTOFF_INVALID_MODE /materials/0/alphaCutoff"}));
}

// --- Extensions ---

// An asset with one material, which declares all extensions.
Lines of_extensions(const std::string& members, const std::string& declared,
                    Profile profile = Profile::standard) {
  const std::string asset = asset_with(R"("extensionsUsed": [)" + declared + R"(], "textures": [{}],
    "materials": [{)" + members + "}]");
  ValidateOptions options;
  options.profile = profile;
  Lines lines = verdict(asset, options);
  std::erase_if(lines,
                [](const std::string& line) { return line.rfind("KHR_MATERIALS_", 0) != 0; });
  for (std::string& line : lines) line.erase(0, std::string("KHR_MATERIALS_").size());
  return lines;
}

const std::string kPath = " /materials/0/extensions/KHR_materials_";

TEST(MaterialExtensions, TransformsCountAsTextureCoordinates) {
  const auto coat = [](const std::string& transform, Profile profile = Profile::standard) {
    return of_extensions(R"("normalTexture": {"index": 0}, "extensions": {"KHR_materials_clearcoat":
      {"clearcoatNormalTexture": {"index": 0, "extensions": {"KHR_texture_transform": {)" +
                             transform + "}}}}}",
                         R"("KHR_materials_clearcoat", "KHR_texture_transform")", profile);
  };
  const Lines found{"CLEARCOAT_CLEARCOAT_NORMAL_TEXTURE_TEXCOORD" + kPath +
                    "clearcoat/clearcoatNormalTexture"};
  EXPECT_EQ(coat(""), Lines{});
  EXPECT_EQ(coat(R"("texCoord": 1)"), found);
  EXPECT_EQ(coat(R"("texCoord": 1)", Profile::khronos), Lines{});
  EXPECT_EQ(coat(R"("rotation": 1)"), found) << "which turns the tangents";
  EXPECT_EQ(coat(R"("scale": [4, 4])"), Lines{}) << "which is a matter of taste";
  EXPECT_EQ(coat(R"("scale": [4, 4])", Profile::strict), found);
}

TEST(MaterialExtensions, NormalMapsAndTheirCompanionsShareTextureCoordinates) {
  const auto clearcoat = [](const char* normal, const char* coat) {
    return of_extensions(
        std::string(R"("normalTexture": {"index": 0)") + normal +
            R"(}, "extensions": {"KHR_materials_clearcoat": {"clearcoatNormalTexture":
          {"index": 0)" +
            coat + "}}}",
        R"("KHR_materials_clearcoat")");
  };
  const Lines found{"CLEARCOAT_CLEARCOAT_NORMAL_TEXTURE_TEXCOORD" + kPath +
                    "clearcoat/clearcoatNormalTexture"};
  EXPECT_EQ(clearcoat("", R"(, "texCoord": 1)"), found);
  EXPECT_EQ(clearcoat(R"(, "texCoord": 1)", ""), found);
  EXPECT_EQ(clearcoat(R"(, "texCoord": 1)", R"(, "texCoord": 1)"), Lines{});
  EXPECT_EQ(clearcoat("", R"(, "texCoord": 0)"), Lines{});
  EXPECT_EQ(
      of_extensions(R"("normalTexture": {"index": 0}, "extensions": {"KHR_materials_anisotropy":
      {"anisotropyTexture": {"index": 0, "texCoord": 1}}})",
                    R"("KHR_materials_anisotropy")"),
      Lines{"ANISOTROPY_ANISOTROPY_TEXTURE_TEXCOORD" + kPath + "anisotropy/anisotropyTexture"});
  EXPECT_EQ(of_extensions(R"("extensions": {"KHR_materials_anisotropy":
      {"anisotropyTexture": {"index": 0, "texCoord": 1}}})",
                          R"("KHR_materials_anisotropy")"),
            Lines{})
      << "without a normal texture there is nothing to share with";
}

TEST(MaterialExtensions, DispersionNeedsAVolume) {
  const std::string used =
      R"("KHR_materials_dispersion", "KHR_materials_volume", "KHR_materials_transmission")";
  EXPECT_EQ(of_extensions(R"("extensions": {"KHR_materials_dispersion": {}})", used),
            Lines{"DISPERSION_NO_VOLUME" + kPath + "dispersion"});
  EXPECT_EQ(
      of_extensions(R"("extensions": {"KHR_materials_dispersion": {}, "KHR_materials_volume": {},
              "KHR_materials_transmission": {}})",
                    used),
      Lines{});
}

TEST(MaterialExtensions, EmissiveStrengthMultipliesAFactor) {
  const auto emissive = [](const std::string& factor, const std::string& strength) {
    return of_extensions(
        factor + R"("extensions": {"KHR_materials_emissive_strength": {)" + strength + "}}",
        R"("KHR_materials_emissive_strength")");
  };
  const Lines found{"EMISSIVE_STRENGTH_ZERO_FACTOR" + kPath + "emissive_strength"};
  EXPECT_EQ(emissive("", R"("emissiveStrength": 2)"), found);
  EXPECT_EQ(emissive(R"("emissiveFactor": [0, 0, 0.0], )", R"("emissiveStrength": 2)"), found);
  EXPECT_EQ(emissive(R"("emissiveFactor": [0, 0, 1], )", R"("emissiveStrength": 2)"), Lines{});
  EXPECT_EQ(emissive(R"("emissiveFactor": [0, 0], )", R"("emissiveStrength": 2)"), Lines{});
  EXPECT_EQ(emissive("", R"("emissiveStrength": 1)"), Lines{});
  EXPECT_EQ(emissive("", R"("emissiveStrength": -2)"), Lines{});
  EXPECT_EQ(emissive("", ""), Lines{});
}

TEST(MaterialExtensions, ThicknessOfAFilmVariesOnlyWithATextureAndARange) {
  const auto film = [](const std::string& members) {
    return of_extensions(R"("extensions": {"KHR_materials_iridescence": {)" + members + "}}",
                         R"("KHR_materials_iridescence")");
  };
  const std::string texture = R"(, "iridescenceThicknessTexture": {"index": 0})";
  const Lines without{"IRIDESCENCE_THICKNESS_RANGE_WITHOUT_TEXTURE" + kPath +
                      "iridescence/iridescenceThicknessMinimum"};
  const Lines unused{"IRIDESCENCE_THICKNESS_TEXTURE_UNUSED" + kPath +
                     "iridescence/iridescenceThicknessTexture"};
  EXPECT_EQ(film(R"("iridescenceThicknessMinimum": 5)"), without);
  EXPECT_EQ(film(R"("iridescenceThicknessMinimum": -5)"), Lines{}) << "out of range";
  EXPECT_EQ(film(R"("iridescenceThicknessMaximum": 5)"), Lines{});
  EXPECT_EQ(film(R"("iridescenceThicknessMinimum": 5)" + texture), Lines{});
  EXPECT_EQ(film(R"("iridescenceThicknessMinimum": 400)" + texture), unused)
      << "the default maximum";
  EXPECT_EQ(film(R"("iridescenceThicknessMaximum": 100)" + texture), unused)
      << "the default minimum";
}

TEST(MaterialExtensions, AVolumeNeedsASurfaceThatLetsLightThrough) {
  const auto beside = [](const std::string& name, Profile profile = Profile::standard) {
    const std::string other = name.empty() ? "" : ", \"" + name + "\": {}";
    return of_extensions(R"("extensions": {"KHR_materials_volume": {})" + other + "}",
                         R"("KHR_materials_volume")" + (name.empty() ? "" : ", \"" + name + "\""),
                         profile);
  };
  const Lines found{"VOLUME_NO_TRANSMISSION" + kPath + "volume"};
  EXPECT_EQ(beside(""), found);
  EXPECT_EQ(beside("KHR_materials_ior"), found);
  for (const char* name : {"KHR_materials_transmission", "KHR_materials_diffuse_transmission",
                           "KHR_materials_translucency", "ACME_glass"}) {
    EXPECT_EQ(beside(name), Lines{}) << name;
    EXPECT_EQ(beside(name, Profile::khronos), Lines{}) << name;
  }
}

TEST(MaterialExtensions, AThickVolumeHasOneSide) {
  const auto thick = [](const std::string& thickness, const std::string& sides) {
    return of_extensions(
        R"("doubleSided": )" + sides +
            R"(, "extensions": {"KHR_materials_transmission": {}, "KHR_materials_volume": {)" +
            thickness + "}}",
        R"("KHR_materials_volume", "KHR_materials_transmission")");
  };
  EXPECT_EQ(thick(R"("thicknessFactor": 0.1)", "true"),
            Lines{"VOLUME_DOUBLE_SIDED" + kPath + "volume"});
  EXPECT_EQ(thick(R"("thicknessFactor": 0)", "true"), Lines{});
  EXPECT_EQ(thick("", "true"), Lines{});
  EXPECT_EQ(thick(R"("thicknessFactor": 0.1)", "false"), Lines{});
}

TEST(MaterialExtensions, TheKhronosProfileLooksOnlyIntoDeclaredOnes) {
  const std::string members = R"("extensions": {"KHR_materials_dispersion": {}})";
  EXPECT_EQ(of_extensions(members, R"("A_b")", Profile::khronos), Lines{});
  EXPECT_EQ(of_extensions(members, R"("A_b")").size(), 1U);
}

}  // namespace
}  // namespace gltfx::test

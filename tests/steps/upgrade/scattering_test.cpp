// SPDX-License-Identifier: Apache-2.0
// Media that scatter light: the numbers, and the objects that contain them.
#include "steps/upgrade/scattering.hpp"

#include <array>
#include <cmath>

#include <gmock/gmock.h>

#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

auto is_near(double r, double g, double b, double within) {
  return ElementsAre(DoubleNear(r, within), DoubleNear(g, within), DoubleNear(b, within));
}

constexpr Rgb kSkin{0.572, 0.227, 0.075};

// The fit of Kulla and Conty, as in KHR_materials_volume_scatter.
double single_scatter_albedo(double m) {
  const double s = 4.09712 + 4.20863 * m - std::sqrt(9.59217 + 41.6808 * m + 17.7126 * m * m);
  return 1 - s * s;
}

TEST(Scattering, ACoefficientIsWhatAColourLosesOverADistance) {
  EXPECT_THAT(coefficient(kSkin, 0.01), is_near(55.86, 148.28, 259.03, 0.005));
  EXPECT_THAT(coefficient({0.9, 0.9, 0.9}, 0.01), is_near(10.54, 10.54, 10.54, 0.005));
  EXPECT_THAT(coefficient({1, 1e-6, 0}, 1), is_near(0, 13.8155, 13.8155, 1e-4));
}

TEST(Scattering, TheAlbedosAreInversesOfEachOther) {
  EXPECT_NEAR(multi_scatter_albedo(0.5), 0.14453, 5e-6);
  EXPECT_NEAR(multi_scatter_albedo(0.9), 0.47717, 5e-6);
  EXPECT_NEAR(multi_scatter_albedo(0.99), 0.79452, 1e-5);
  EXPECT_EQ(multi_scatter_albedo(1), 1);
  EXPECT_NEAR(multi_scatter_albedo(0), 0, 1e-6);
  for (double share = 0; share < 1; share += 1.0 / 1024) {
    EXPECT_NEAR(single_scatter_albedo(multi_scatter_albedo(share)), share, 1e-5) << share;
    // The fit has its root a little below 1, where two albedos have the result 1.
    EXPECT_NEAR(multi_scatter_albedo(single_scatter_albedo(share)), share, 1e-9) << share;
  }
}

TEST(Scattering, WithoutAbsorptionTheColourIsInTheAttenuationAlone) {
  const Medium medium = medium_of(coefficient(kSkin, 0.01), {});
  EXPECT_THAT(medium.multi_scatter_color, ElementsAre(1, 1, 1));
  EXPECT_NEAR(medium.attenuation_distance, 0.006477, 5e-7);
  EXPECT_THAT(medium.attenuation_color, is_near(0.69641, 0.38273, 0.18679, 5e-6));
}

TEST(Scattering, WithAbsorptionAttenuationCountsBoth) {
  const Medium medium = medium_of(coefficient(kSkin, 0.01), coefficient({0.9, 0.9, 0.9}, 0.01));
  EXPECT_THAT(medium.multi_scatter_color, is_near(0.38766, 0.55008, 0.63367, 1e-5));
  EXPECT_NEAR(medium.attenuation_distance, 0.006063, 5e-7);
  EXPECT_THAT(medium.attenuation_color, is_near(0.66859, 0.38176, 0.19506, 5e-6));
  for (std::size_t i = 0; i < 3; ++i) {
    const double albedo = single_scatter_albedo(medium.multi_scatter_color[i]);
    EXPECT_NEAR(albedo, (std::array{0.84132, 0.93366, 0.96091})[i], 5e-6);
  }
}

// A document with one material: members of its volume and of its scattering, and other extensions.
std::string document(const std::string& volume, const std::string& legacy,
                     const std::string& others = "") {
  return R"({"materials":[{"extensions":{)" + others + R"("KHR_materials_volume":{)" + volume +
         R"(},"KHR_materials_sss":{)" + legacy + "}}}]}";
}

const std::string kLegacy = R"("scatterDistance":0.01,"scatterColor":[0.572,0.227,0.075])";

UpgradeOptions to(const std::string& name, bool unsafe = false) {
  UpgradeOptions options;
  options.to = {name};
  options.unsafe = unsafe;
  return options;
}

Upgraded scattered(const std::string& text, bool unsafe = false) {
  return upgraded(text, to("KHR_materials_volume_scatter", unsafe));
}

TEST(ConvertScattering, ChangesTheVolumeAndItself) {
  const Upgraded result =
      scattered(document(R"("attenuationDistance":0.01,"attenuationColor":[0.9,0.9,0.9])",
                         kLegacy + R"(,"extras":1)"));
  EXPECT_EQ(result.json()["materials"][0]["extensions"].dump(),
            R"({"KHR_materials_volume":{"attenuationDistance":0.0060633373,)"
            R"("attenuationColor":[0.668585139,0.381761779,0.195059627]},)"
            R"("KHR_materials_volume_scatter":{"extras":1,)"
            R"("multiscatterColorFactor":[0.387658516,0.550077432,0.633669655]}})");
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::safe);
  EXPECT_TRUE(result.only().lossy);
  EXPECT_THAT(result.only().notes, Contains(HasSubstr("darker")));
}

TEST(ConvertScattering, TheLaterNameGoesTheSameWay) {
  std::string later = document("", kLegacy);
  const std::string old = "KHR_materials_sss";
  later.replace(later.find(old), old.size(), "KHR_materials_subsurface");
  EXPECT_EQ(scattered(later).text, scattered(document("", kLegacy)).text);
}

TEST(ConvertScattering, TheOtherSuccessorNeedsTransmissionAndThickness) {
  const auto result = [](const std::string& volume, const std::string& others) {
    return upgraded(document(volume, kLegacy, others), to("KHR_materials_scatter"));
  };
  const std::string transmission = R"("KHR_materials_transmission":{},)";
  const Json done =
      result(R"("thicknessFactor":1)", transmission).json()["materials"][0]["extensions"];
  EXPECT_EQ(done["KHR_materials_scatter"].dump(),
            R"({"scatterStrengthFactor":1,"multiscatterColorFactor":[1,1,1]})");
  for (const auto& [volume, others, says] : std::vector<std::array<std::string, 3>>{
           {R"("thicknessFactor":1)", "", "KHR_materials_transmission"},
           {"", transmission, "thin-walled"},
           {R"("thicknessFactor":1)", transmission + R"("KHR_materials_diffuse_transmission":{},)",
            "KHR_materials_diffuse_transmission"}}) {
    const Upgraded left = result(volume, others);
    EXPECT_EQ(left.only().outcome, UpgradeOutcome::impossible) << says;
    EXPECT_THAT(left.only().notes, Contains(HasSubstr(says)));
  }
}

TEST(ConvertScattering, WhatNeverScattersGoes) {
  for (const char* legacy : {"", R"("scatterColor":[0.5,0.5,0.5])", R"("scatterDistance":1)",
                             R"("scatterDistance":1,"scatterColor":[1,1.0,1])"}) {
    const Upgraded result = scattered(document(R"("thicknessFactor":1)", legacy));
    EXPECT_TRUE(result.only().removed);
    EXPECT_EQ(result.json()["materials"][0]["extensions"].dump(),
              R"({"KHR_materials_volume":{"thicknessFactor":1}})");
  }
}

TEST(ConvertScattering, ABlackColourIsAContradiction) {
  const std::string text = document("", R"("scatterDistance":1,"scatterColor":[0,0,0])");
  const Upgraded left = scattered(text);
  EXPECT_EQ(left.text, text);
  EXPECT_EQ(left.only().outcome, UpgradeOutcome::impossible);
  EXPECT_TRUE(scattered(text, true).only().removed);
}

TEST(ConvertScattering, ABlackChannelIsTakenForAlmostBlack) {
  const Upgraded result = scattered(document("", R"("scatterDistance":1,"scatterColor":[1,0,1])"));
  EXPECT_TRUE(result.only().done);
  EXPECT_THAT(result.only().notes, Contains(HasSubstr("1e-6")));
  const Json extensions = result.json()["materials"][0]["extensions"];
  EXPECT_EQ(extensions["KHR_materials_volume_scatter"]["multiscatterColorFactor"].dump(),
            "[0,1,0]");
  EXPECT_EQ(extensions["KHR_materials_volume"]["attenuationColor"][0], 1);
}

struct Case {
  const char* name;
  std::string text;
  const char* says;
};

class ScatteringLeft : public testing::TestWithParam<Case> {};

TEST_P(ScatteringLeft, Alone) {
  const Upgraded result = scattered(GetParam().text, true);
  EXPECT_EQ(result.text, GetParam().text);
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::impossible);
  EXPECT_THAT(result.only().notes, Contains(HasSubstr(GetParam().says)));
}

std::string animated_scattering(const std::string& pointer) {
  return "{" + animated("/materials/0/extensions/" + pointer) + document("", kLegacy).substr(1);
}

INSTANTIATE_TEST_SUITE_P(
    Upgrade, ScatteringLeft,
    testing::Values(
        Case{"volume", R"({"materials":[{"extensions":{"KHR_materials_sss":{)" + kLegacy + "}}}]}",
             "no KHR_materials_volume"},
        Case{"distance", document("", R"("scatterDistance":0,"scatterColor":[1,1,0])"),
             "scatterDistance is invalid"},
        Case{"tiny", document("", R"("scatterDistance":1e-320,"scatterColor":[1,1,0])"),
             "out of range"},
        Case{"color", document("", R"("scatterDistance":1,"scatterColor":[1,1])"),
             "scatterColor is invalid"},
        Case{"range", document("", R"("scatterDistance":1,"scatterColor":[1,2,1])"),
             "scatterColor is invalid"},
        Case{"attenuation", document(R"("attenuationDistance":-1)", kLegacy), "attenuation"},
        Case{"attenuation_color", document(R"("attenuationColor":[1,1,1,1])", kLegacy),
             "attenuation"},
        Case{"unlit", document("", kLegacy, R"("KHR_materials_unlit":{},)"), "KHR_materials_unlit"},
        Case{"animated", animated_scattering("KHR_materials_sss/scatterColor"),
             "scatterColor is animated"},
        Case{"animated_volume", animated_scattering("KHR_materials_volume/attenuationDistance"),
             "attenuationDistance of the volume is animated"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace gltfx::upgrade::test

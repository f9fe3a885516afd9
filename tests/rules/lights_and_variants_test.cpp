// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

Lines of_light(const std::string& light, Profile profile = Profile::standard) {
  return selected(asset_with(R"("extensionsUsed": ["KHR_lights_punctual"],
      "extensions": {"KHR_lights_punctual": {"lights": [)" +
                             light + "]}}"),
                  {"KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES", "EXTRA_PROPERTY", "UNDEFINED_PROPERTY"},
                  profile);
}

const std::string kLight = "/extensions/KHR_lights_punctual/lights/0";

TEST(Lights, TheInnerConeLiesInsideTheOuterOne) {
  const auto cone = [](const std::string& spot) {
    return of_light(R"({"type": "spot", "spot": {)" + spot + "}}");
  };
  const Lines found{"KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES " + kLight + "/spot/outerConeAngle"};
  EXPECT_EQ(cone(R"("innerConeAngle": 0.5, "outerConeAngle": 0.6)"), Lines{});
  EXPECT_EQ(cone(R"("innerConeAngle": 0.6, "outerConeAngle": 0.6)"), found);
  EXPECT_EQ(cone(R"("innerConeAngle": 0.6, "outerConeAngle": 0.5)"), found);
  EXPECT_EQ(cone(R"("innerConeAngle": 0.8)"), found) << "the outer angle is 0.785 by default";
  EXPECT_EQ(cone(R"("innerConeAngle": 0.7)"), Lines{});
  EXPECT_EQ(cone(R"("outerConeAngle": 0.1)"), Lines{});
  EXPECT_EQ(cone(R"("innerConeAngle": -1, "outerConeAngle": 0.1)"), Lines{}) << "out of range";
  EXPECT_EQ(cone(R"("innerConeAngle": 1, "outerConeAngle": 9)"), Lines{}) << "out of range";
}

TEST(Lights, MembersGoWithTheKindOfLight) {
  EXPECT_EQ(of_light(R"({"type": "point", "range": 1, "spot": {}})"),
            Lines{"EXTRA_PROPERTY " + kLight + "/spot"});
  EXPECT_EQ(of_light(R"({"type": "directional", "range": 1})"),
            Lines{"EXTRA_PROPERTY " + kLight + "/range"});
  EXPECT_EQ(of_light(R"({"type": "spot", "range": 1, "spot": {}})"), Lines{});
  EXPECT_EQ(of_light(R"({"type": "spot"})"), Lines{"UNDEFINED_PROPERTY " + kLight});
}

TEST(Lights, ANodeInAnAssetWithoutLightsIsReportedOnce) {
  const std::string asset = asset_with(R"("extensionsUsed": ["KHR_lights_punctual"],
    "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}])");
  const std::set<std::string, std::less<>> codes{"UNSATISFIED_DEPENDENCY", "UNRESOLVED_REFERENCE"};
  EXPECT_EQ(selected(asset, codes),
            Lines{"UNRESOLVED_REFERENCE /nodes/0/extensions/KHR_lights_punctual/light"});
  EXPECT_EQ(selected(asset, codes, Profile::khronos),
            Lines{"UNSATISFIED_DEPENDENCY /nodes/0/extensions/KHR_lights_punctual"});
}

Lines of_mappings(const std::string& mappings, Profile profile = Profile::standard) {
  return selected(asset_with(R"("extensionsUsed": ["KHR_materials_variants"], "materials": [{}],
      "extensions": {"KHR_materials_variants": {"variants": [{"name": "a"}, {"name": "b"}]}},
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0},
        "extensions": {"KHR_materials_variants": {"mappings": [)" +
                             mappings + "]}}}]}]"),
                  {"KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT", "DUPLICATE_ELEMENTS"}, profile);
}

const std::string kMappings = "/meshes/0/primitives/0/extensions/KHR_materials_variants/mappings/";

TEST(Variants, EachHasOneMaterialAPrimitive) {
  EXPECT_EQ(of_mappings(R"({"material": 0, "variants": [0]}, {"material": 0, "variants": [1]})"),
            Lines{});
  EXPECT_EQ(of_mappings(R"({"material": 0, "variants": [0]}, {"material": 0, "variants": [1, 0]})"),
            Lines{"KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT " + kMappings + "1/variants/1"});
}

TEST(Variants, ARepeatInOneMappingIsOneErrorButForTheKhronosProfile) {
  const std::string twice = R"({"material": 0, "variants": [0, 0]})";
  const std::string at = kMappings + "0/variants/1";
  EXPECT_EQ(of_mappings(twice), Lines{"DUPLICATE_ELEMENTS " + at});
  EXPECT_EQ(of_mappings(twice, Profile::khronos),
            (Lines{"DUPLICATE_ELEMENTS " + at, "KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT " + at}));
}

}  // namespace
}  // namespace gltfx::test

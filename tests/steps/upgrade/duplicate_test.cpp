// SPDX-License-Identifier: Apache-2.0
// A legacy object next to its successor, and two legacy objects with one successor.
#include <gmock/gmock.h>

#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

// A document with one material: its extensions, and the members before them.
std::string material(const std::string& members, const std::string& extensions) {
  return R"({"textures":[{},{}],"materials":[{)" + members + R"("extensions":{)" + extensions +
         "}}]}";
}

std::vector<std::string> notes_of(const std::string& members, const std::string& legacy,
                                  const std::string& successor) {
  const Upgraded result =
      upgraded(material(members, R"("KHR_materials_diffuse_transmission":{)" + successor +
                                     R"(},"KHR_materials_translucency":{)" + legacy + "}"));
  EXPECT_TRUE(result.only().removed);
  EXPECT_EQ(result.only().notes.front(),
            "the object already has KHR_materials_diffuse_transmission, which viewers use");
  return {result.only().notes.begin() + 1, result.only().notes.end()};
}

TEST(Duplicate, WhatSaysTheSameGoesWithoutAWord) {
  EXPECT_THAT(notes_of("", "", ""), SizeIs(0));
  EXPECT_THAT(notes_of("", R"("translucencyFactor":0.5)", R"("diffuseTransmissionFactor":5e-1)"),
              SizeIs(0));
  EXPECT_THAT(notes_of(R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,0.3]},)",
                       R"("translucencyFactor":0.5)",
                       R"("diffuseTransmissionFactor":0.5,)"
                       R"("diffuseTransmissionColorFactor":[0.50,1,1])"),
              SizeIs(0));
  // If another channel is read, the texture is always different.
  EXPECT_THAT(notes_of("", R"("translucencyFactor":1,"translucencyTexture":{"index":0})",
                       R"("diffuseTransmissionFactor":1,"diffuseTransmissionTexture":{"index":1})"),
              SizeIs(0));
}

TEST(Duplicate, ValuesThatDifferAreNamed) {
  EXPECT_THAT(notes_of("", R"("translucencyFactor":0.5)", R"("diffuseTransmissionFactor":0.7)"),
              ElementsAre("translucencyFactor is '0.5', but diffuseTransmissionFactor is '0.7'"));
  EXPECT_THAT(notes_of("", R"("translucencyFactor":0.5)", ""),
              ElementsAre("translucencyFactor is '0.5', but diffuseTransmissionFactor is '0'"));
  EXPECT_THAT(notes_of(R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1]},)",
                       R"("translucencyFactor":1,"translucencyTexture":{"index":0})",
                       R"("diffuseTransmissionFactor":1)"),
              ElementsAre("translucencyTexture is '{\"index\":0}', but diffuseTransmissionTexture "
                          "is missing",
                          "pbrMetallicRoughness/baseColorFactor is '[0.5,1,1]', but "
                          "diffuseTransmissionColorFactor is '[1,1,1]'"));
}

TEST(Duplicate, OfAVendorsValuesThoseOutsideTheSuccessorCount) {
  const Upgraded result =
      upgraded(material("", R"("ADOBE_materials_thin_transparency":{"ior":1.5},)"
                            R"("KHR_materials_transmission":{"transmissionFactor":1},)"
                            R"("KHR_materials_ior":{"ior":1.4})"),
               only({"ADOBE_materials_thin_transparency"}));
  EXPECT_TRUE(result.only().removed);
  EXPECT_THAT(result.only().notes,
              Contains("ior is '1.5', but extensions/KHR_materials_ior/ior is '1.4'"));
}

TEST(Duplicate, ASuccessorThatIsBrokenTakesNoPlace) {
  for (const char* successor : {"null", "7", R"({"diffuseTransmissionFactor":2})"}) {
    const std::string text =
        material("", R"("KHR_materials_translucency":{"translucencyFactor":1},)"
                     R"("KHR_materials_diffuse_transmission":)" +
                         std::string(successor));
    const Upgraded result = upgraded(text);
    EXPECT_EQ(result.text, text);
    EXPECT_THAT(result.only().notes, Contains(HasSubstr("but it is invalid")));
  }
}

TEST(Duplicate, OfTwoLegacyObjectsTheSecondGoesWithItsValuesNamed) {
  const std::string volume = R"("KHR_materials_volume":{"thicknessFactor":1},)";
  const auto second = [&](const std::string& values) {
    const Upgraded result = upgraded(
        material("", volume +
                         R"("KHR_materials_sss":{"scatterDistance":1,"scatterColor":[0,1,1]},)" +
                         R"("KHR_materials_subsurface":)" + values),
        only({"KHR_materials_sss", "KHR_materials_subsurface"}));
    EXPECT_TRUE(result.plan.actions.at(1).removed);
    return result.plan.actions.at(1).notes;
  };
  EXPECT_THAT(second(R"({"scatterColor":[0,1,1],"scatterDistance":1})"), SizeIs(1));
  EXPECT_THAT(second(R"({"scatterDistance":2})"),
              Contains(R"(its own values are '{"scatterDistance":2}')"));
}

TEST(Duplicate, AnotherSuccessorCountsAsOne) {
  const std::string text = material(
      "", R"("KHR_materials_volume":{"thicknessFactor":1},"KHR_materials_transmission":{},)"
          R"("KHR_materials_scatter":{"scatterStrengthFactor":1},)"
          R"("KHR_materials_sss":{"scatterDistance":1,"scatterColor":[0.5,1,1]})");
  const Upgraded result = upgraded(text, only({"KHR_materials_sss"}));
  EXPECT_TRUE(result.only().removed);
  EXPECT_EQ(result.json()["materials"][0]["extensions"]["KHR_materials_volume"].dump(),
            R"({"thicknessFactor":1})");
  EXPECT_THAT(result.only().notes, Contains(HasSubstr("already has KHR_materials_scatter")));
}

}  // namespace
}  // namespace gltfx::upgrade::test

// SPDX-License-Identifier: Apache-2.0
// Upgrades of one legacy object.
#include <gmock/gmock.h>

#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

UpgradeOptions as(const std::string& generation) {
  UpgradeOptions options;
  options.generation = generation;
  return options;
}

UpgradeOptions unsafe() {
  UpgradeOptions options;
  options.unsafe = true;
  return options;
}

TEST(Plan, WithoutLegacyObjectsThereIsNothingToDo) {
  const Upgraded result = upgraded(R"({"asset":{"version":"2.0"},"materials":[{}]})");
  EXPECT_THAT(result.plan.actions, IsEmpty());
  EXPECT_THAT(result.plan.change.edits, IsEmpty());
}

TEST(Plan, TheFirstGenerationTakesItsTintFromTheBaseColour) {
  const Upgraded result = upgraded(document_with(
      R"("pbrMetallicRoughness":{"baseColorFactor":[0.50,8e-1,0.2,1],"baseColorTexture":{"index":1,)"
      R"("texCoord":1,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}}},)",
      R"("translucencyFactor":0.7)"));
  EXPECT_EQ(extension_of(result).dump(),
            R"({"diffuseTransmissionFactor":0.7,"diffuseTransmissionColorFactor":[0.5,0.8,0.2],)"
            R"("diffuseTransmissionColorTexture":{"index":1,"texCoord":1,"extensions":)"
            R"({"KHR_texture_transform":{"scale":[2,2]}}}})");
  EXPECT_THAT(result.text, HasSubstr("[0.50,8e-1,0.2]"));  // numbers keep their spelling
  EXPECT_EQ(result.only().generation, "v1");
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::safe);
  EXPECT_TRUE(result.only().done);
  EXPECT_EQ(result.only().decision,
            "it has no translucencyColorFactor or translucencyColorTexture; it may also be v2/v3");
  EXPECT_THAT(result.json()["extensionsUsed"], ElementsAre(std::string(kNew)));
}

TEST(Plan, AWhiteTintIsTheDefaultAndLeftOut) {
  const Upgraded result = upgraded(document_with(
      R"("pbrMetallicRoughness":{"baseColorFactor":[1,1.0,1,0.5]},)", R"("translucencyFactor":1)"));
  EXPECT_EQ(extension_of(result).dump(), R"({"diffuseTransmissionFactor":1})");
}

TEST(Plan, ALaterGenerationOnlyChangesNames) {
  const std::string legacy =
      R"( "translucencyTexture" : { "index":0 }, "translucencyFactor":5E-1,)"
      R"("translucencyColorFactor":[ 1,0.25 ,1.0 ],"extras":{"translucencyFactor":1} )";
  const std::string text =
      document_with(R"("pbrMetallicRoughness":{"baseColorFactor":[0.5,0.8,0.2,1]},)", legacy);
  std::string wanted = text;
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {R"("translucencyTexture")", R"("diffuseTransmissionTexture")"},
           {R"("translucencyFactor")", R"("diffuseTransmissionFactor")"},
           {R"("translucencyColorFactor")", R"("diffuseTransmissionColorFactor")"},
           {std::string(kOld), std::string(kNew)},
           {std::string(kOld), std::string(kNew)}}) {
    wanted.replace(wanted.find(from), from.size(), to);
  }
  const Upgraded result = upgraded(text);
  EXPECT_EQ(result.text, wanted);
  EXPECT_EQ(result.only().generation, "v2/v3");
  EXPECT_EQ(result.only().decision, "it has translucencyColorFactor");
}

TEST(Plan, AFactorMapOfTheFirstGenerationNeedsANewImage) {
  const std::string text =
      document_with("", R"("translucencyFactor":1,"translucencyTexture":{"index":1})");
  const Upgraded result = upgraded(text, unsafe());
  EXPECT_EQ(result.text, text);
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::needs_image);
  EXPECT_FALSE(result.only().done);
  EXPECT_TRUE(result.plan.change.additions.empty());
  EXPECT_THAT(result.only().notes,
              Contains("texture 1 has its data in r, but diffuseTransmissionTexture reads a; "
                       "the pixels of its image are not available"));
}

TEST(Plan, TheUserMayNameTheGeneration) {
  const std::string text =
      document_with("", R"("translucencyFactor":1,"translucencyTexture":{"index":1})");
  for (const char* name : {"v2", "v3"}) {
    const Upgraded result = upgraded(text, as(name));
    EXPECT_EQ(extension_of(result)["diffuseTransmissionTexture"]["index"], 1);
    EXPECT_EQ(result.only().decision, std::string("--generation ").append(name));
  }
}

TEST(Plan, AGenerationThatDoesNotFitIsRefused) {
  const std::string text =
      document_with("", R"("translucencyFactor":1,"translucencyColorFactor":[1,0,0])");
  const Upgraded result = upgraded(text, as("v1"));
  EXPECT_EQ(result.text, text);
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::impossible);
  EXPECT_THAT(result.only().notes, Contains(HasSubstr("has translucencyColorFactor")));
}

TEST(Plan, ABareIndexBecomesAnObject) {
  const Upgraded result =
      upgraded(document_with("", R"("translucencyFactor":1,"translucencyTexture":1)"), as("v2"));
  EXPECT_EQ(extension_of(result).dump(),
            R"({"diffuseTransmissionFactor":1,"diffuseTransmissionTexture":{"index":1}})");
  EXPECT_THAT(result.only().notes, Contains(HasSubstr("is an index and")));
}

TEST(Plan, MembersThatNobodyKnowsStay) {
  const Upgraded result = upgraded(
      document_with("", R"("translucencyFactor":1,"x":[1],"extensions":{"ACME_x":{}},"extras":7)"));
  EXPECT_EQ(extension_of(result).dump(),
            R"({"diffuseTransmissionFactor":1,"x":[1],"extensions":{"ACME_x":{}},"extras":7})");
}

struct Error {
  const char* legacy;
  const char* says;
};

class PlanOfFaulty : public testing::TestWithParam<Error> {};

TEST_P(PlanOfFaulty, ObjectLeavesItAlone) {
  const std::string text = document_with("", GetParam().legacy);
  const Upgraded result = upgraded(text, unsafe());
  EXPECT_EQ(result.text, text);
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::impossible);
  EXPECT_THAT(result.only().notes, Contains(HasSubstr(GetParam().says)));
}

INSTANTIATE_TEST_SUITE_P(
    Upgrade, PlanOfFaulty,
    testing::Values(
        Error{R"("translucencyFactor":1.5)", "translucencyFactor is invalid"},
        Error{R"("translucencyFactor":"1")", "translucencyFactor is invalid"},
        Error{R"("translucencyFactor":1,"translucencyTexture":2)", "does not reference a texture"},
        Error{R"("translucencyFactor":1,"translucencyTexture":{"index":2})",
              "does not reference a texture"},
        Error{R"("translucencyFactor":1,"translucencyTexture":{"index":-1})", "is invalid"},
        Error{R"("translucencyFactor":1,"translucencyTexture":{})", "is invalid"},
        Error{R"("translucencyFactor":1,"translucencyColorFactor":[1,1])", "is invalid"},
        Error{R"("translucencyFactor":1,"diffuseTransmissionFactor":1)", "already"}));

TEST(Plan, AErrorInWhatWouldBeCopiedIsNotSpread) {
  for (const char* base :
       {R"("baseColorFactor":[2,0,0,1])", R"("baseColorFactor":[0,0])", R"("baseColorFactor":"x")",
        R"("baseColorTexture":{"index":2})", R"("baseColorTexture":0)"}) {
    const std::string text =
        document_with(std::string(R"("pbrMetallicRoughness":{)").append(base).append("},"),
                      R"("translucencyFactor":1)");
    const Upgraded result = upgraded(text, unsafe());
    EXPECT_EQ(result.text, text);
    EXPECT_EQ(result.only().outcome, UpgradeOutcome::impossible) << base;
  }
}

TEST(Plan, SomethingElseThanAnObjectIsLeftAlone) {
  const std::string text =
      R"({"materials":[{"extensions":{"KHR_materials_translucency":[1]}},7,{"extensions":8}]})";
  const Upgraded result = upgraded(text);
  EXPECT_EQ(result.text, text);
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::impossible);
}

TEST(Plan, BesideAnExtensionThatExcludesTheSuccessorItStays) {
  const std::string text =
      R"({"materials":[{"extensions":{"KHR_materials_pbrSpecularGlossiness":{},)"
      R"("KHR_materials_volume":{},"KHR_materials_translucency":{"translucencyFactor":1}}}]})";
  const Upgraded result = upgraded(text);
  EXPECT_EQ(result.text, text);
  EXPECT_THAT(result.plan.actions.at(0).notes, Contains(HasSubstr("KHR_materials_volume")));
  EXPECT_THAT(result.plan.actions.at(1).notes,
              Contains(HasSubstr("KHR_materials_pbrSpecularGlossiness")));
}

TEST(Plan, ObjectsWithoutEffectGoWithAllThatIsEmptyThen) {
  for (const char* legacy : {"", R"("translucencyFactor":0)", R"("translucencyFactor":-0.0)",
                             R"("translucencyTexture":{"index":0})"}) {
    const Upgraded result = upgraded(document_with(R"("name":"m",)", legacy));
    EXPECT_TRUE(result.only().removed);
    EXPECT_EQ(result.text,
              R"({"asset":{"version":"2.0"},"textures":[{},{}],"materials":[{"name":"m"}]})");
  }
}

TEST(Plan, WhatHidesTheEffectOrReplacesItMakesTheOldObjectGo) {
  const Upgraded result = upgraded(
      R"({"extensionsUsed":["KHR_materials_unlit","KHR_materials_translucency"],"materials":[)"
      R"({"extensions":{"KHR_materials_unlit":{},"KHR_materials_translucency":{"translucencyFactor":1}}},)"
      R"({"extensions":{"KHR_materials_translucency":{"translucencyFactor":1},)"
      R"("KHR_materials_diffuse_transmission":{}}}]})");
  EXPECT_EQ(result.text, R"({"extensionsUsed":["KHR_materials_unlit"],"materials":[)"
                         R"({"extensions":{"KHR_materials_unlit":{}}},)"
                         R"({"extensions":{"KHR_materials_diffuse_transmission":{}}}]})");
}

TEST(Plan, VertexColoursAreALossForTheFirstGeneration) {
  const std::string coloured =
      R"("meshes":[{"primitives":[{"attributes":{"COLOR_0":0},"material":0}]}],)";
  const std::string text = document_with("", R"("translucencyFactor":1)", coloured);
  const Upgraded left = upgraded(text);
  EXPECT_EQ(left.text, text);
  EXPECT_EQ(left.only().outcome, UpgradeOutcome::unsafe);
  EXPECT_THAT(left.only().notes, Contains(HasSubstr("COLOR_0")));
  EXPECT_EQ(extension_of(upgraded(text, unsafe()))["diffuseTransmissionFactor"], 1);
  EXPECT_EQ(upgraded(text, as("v2")).only().outcome, UpgradeOutcome::safe);
}

TEST(Plan, VertexColoursCountByWayOfVariantsToo) {
  const std::string coloured =
      R"("meshes":[{"primitives":[{"attributes":{"COLOR_0":0},"extensions":)"
      R"({"KHR_materials_variants":{"mappings":[{"material":0,"variants":[0]}]}}},)"
      R"({"attributes":{"POSITION":0},"material":0}]}],)";
  EXPECT_EQ(upgraded(document_with("", R"("translucencyFactor":1)", coloured)).only().outcome,
            UpgradeOutcome::unsafe);
  const std::string plain = R"("meshes":[{"primitives":[{"attributes":{"COLOR_0":0},"material":1},)"
                            R"({"attributes":{"POSITION":0},"material":0}]}],)";
  EXPECT_EQ(upgraded(document_with("", R"("translucencyFactor":1)", plain)).only().outcome,
            UpgradeOutcome::safe);
}

TEST(Plan, TheSameDocumentIsNotChangedTwice) {
  const Upgraded once = upgraded(document_with("", R"("translucencyFactor":1)"));
  const Upgraded twice = upgraded(once.text);
  EXPECT_THAT(twice.plan.actions, IsEmpty());
  EXPECT_EQ(twice.text, once.text);
}

}  // namespace
}  // namespace gltfx::upgrade::test

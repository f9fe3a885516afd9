// SPDX-License-Identifier: Apache-2.0
// The legacy extensions of a run, and extensions without a successor.
#include <array>

#include <gmock/gmock.h>

#include "steps/upgrade/choice.hpp"
#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::string kBoth =
    R"({"materials":[{"extensions":{"KHR_materials_translucency":{"translucencyFactor":1}}},)"
    R"({"extensions":{"KHR_materials_volume":{"thicknessFactor":1},)"
    R"("KHR_materials_transmission":{},)"
    R"("KHR_materials_sss":{"scatterDistance":1,"scatterColor":[0.5,0.5,0.5]}}}]})";

std::vector<std::string> became(const std::string& text, const UpgradeOptions& options) {
  std::vector<std::string> names;
  for (const UpgradeAction& action : upgraded(text, options).plan.actions) {
    names.push_back(action.from + (action.done ? " > " + action.to : ""));
  }
  return names;
}

TEST(Selection, WithoutNamesDraftsAreOnlyOffered) {
  const Upgraded result = upgraded(kBoth);
  EXPECT_THAT(became(kBoth, {}),
              ElementsAre("KHR_materials_translucency > KHR_materials_diffuse_transmission",
                          "KHR_materials_sss"));
  const UpgradeAction& offered = result.plan.actions[1];
  EXPECT_EQ(offered.outcome, UpgradeOutcome::on_request);
  EXPECT_FALSE(offered.is_due());
  EXPECT_THAT(offered.notes, ElementsAre(StartsWith("--only KHR_materials_sss: ")));
}

TEST(Selection, ALegacyNameLimitsTheRunToIt) {
  EXPECT_THAT(became(kBoth, only({"KHR_materials_sss"})),
              ElementsAre("KHR_materials_sss > KHR_materials_volume_scatter"));
  EXPECT_THAT(became(kBoth, only({"KHR_materials_translucency"})),
              ElementsAre("KHR_materials_translucency > KHR_materials_diffuse_transmission"));
  EXPECT_THAT(became(kBoth, only({"KHR_xmp"})), IsEmpty());
}

TEST(Selection, ASuccessorLimitsTheRunAndChooses) {
  UpgradeOptions options;
  options.to = {"KHR_materials_scatter"};
  EXPECT_THAT(became(kBoth, options), ElementsAre("KHR_materials_sss > KHR_materials_scatter"));
  options.to = {"KHR_materials_volume_scatter", "KHR_materials_diffuse_transmission"};
  EXPECT_THAT(became(kBoth, options),
              ElementsAre("KHR_materials_translucency > KHR_materials_diffuse_transmission",
                          "KHR_materials_sss > KHR_materials_volume_scatter"));
  options.only = {"KHR_materials_sss"};
  EXPECT_THAT(became(kBoth, options),
              ElementsAre("KHR_materials_sss > KHR_materials_volume_scatter"));
}

TEST(Selection, AllNamesAreKnown) {
  const schema::Set& set = *schema::builtin_set();
  EXPECT_THAT(
      legacy_names(set),
      ElementsAre("3DS_materials_translucency", "ADOBE_materials_thin_transparency", "CESIUM_RTC",
                  "EXT_meshopt_compression", "KHR_materials_pbrSpecularGlossiness",
                  "KHR_materials_sss", "KHR_materials_subsurface", "KHR_materials_translucency",
                  "KHR_xmp", "VRMC_materials_hdr_emissiveMultiplier"));
  EXPECT_THAT(
      successor_names(set),
      ElementsAre("KHR_materials_diffuse_transmission", "KHR_materials_emissive_strength",
                  "KHR_materials_scatter", "KHR_materials_specular", "KHR_materials_transmission",
                  "KHR_materials_volume_scatter", "KHR_meshopt_compression", "KHR_xmp_json_ld"));
}

TEST(Selection, WhatHasNoSuccessorIsNamedAndIsNoTask) {
  const std::string text = R"({"extensions":{"KHR_techniques_webgl":{}},"materials":[)"
                           R"({"extensions":{"KHR_materials_subsurface":{"power":2}}}]})";
  const Upgraded result = upgraded(text);
  EXPECT_EQ(result.text, text);
  ASSERT_EQ(result.plan.actions.size(), 2U);
  for (const UpgradeAction& action : result.plan.actions) {
    EXPECT_EQ(action.outcome, UpgradeOutcome::no_successor);
    EXPECT_FALSE(action.is_due());
    EXPECT_EQ(action.notes.size(), 1U);
  }
  EXPECT_EQ(result.plan.actions[1].generation, "2019");
}

TEST(Selection, WhatWasAskedForAndHasNoSuccessorIsLeftToDo) {
  const Upgraded result =
      upgraded(R"({"materials":[{"extensions":{"KHR_materials_subsurface":{"power":2}}}]})",
               only({"KHR_materials_subsurface"}));
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::impossible);
  EXPECT_TRUE(result.only().is_due());
}

TEST(Selection, AnotherVersionOfTheFormatIsLeftToDo) {
  for (const auto& [head, from, pointer] : std::vector<std::array<std::string, 3>>{
           {R"("asset":{"version":"1.1"})", "glTF 1.1", "/asset/version"},
           {R"("asset":{"version":1})", "glTF 1.0", "/asset/version"},
           {R"("shaders":{},"meshes":{})", "glTF 1.0", ""}}) {
    const std::string text =
        "{" + head + R"(,"materials":[{"extensions":{"KHR_materials_translucency":{}}}]})";
    const Upgraded result = upgraded(text);
    EXPECT_EQ(result.text, text);
    EXPECT_EQ(result.only().outcome, UpgradeOutcome::impossible);
    EXPECT_TRUE(result.only().is_due());
    EXPECT_EQ(result.only().from, from);
    EXPECT_EQ(result.only().pointer, pointer);
    EXPECT_THAT(result.only().notes, Contains(HasSubstr("gltf-pipeline")));
    EXPECT_FALSE(upgraded(text, only({"KHR_xmp"})).only().is_due());
  }
}

TEST(Selection, FirstDraftsAreNamed) {
  const auto note = [](const std::string& text) {
    const Upgraded result = upgraded(text);
    EXPECT_EQ(result.text, text);
    EXPECT_FALSE(result.plan.actions.empty()) << text;
    return result.plan.actions.empty() ? "" : result.plan.actions[0].notes.at(0);
  };
  EXPECT_THAT(note(R"({"materials":[{"extensions":{"KHR_technique_webgl":{"technique":0}}}]})"),
              HasSubstr("earlier name of KHR_techniques_webgl"));
  EXPECT_THAT(note(R"({"meshes":[{"extensions":{"KHR_XMP":{"dc:format":"x"}}}]})"),
              HasSubstr("first draft of KHR_xmp"));
  EXPECT_THAT(note(R"({"extensions":{"KHR_xmp":{"xmps":[{}]}}})"), HasSubstr("first draft"));
  EXPECT_THAT(note(R"({"meshes":[{"extensions":{"KHR_xmp":{"xmp":0}}}]})"),
              HasSubstr("first draft"));
}

TEST(Selection, AGenerationOfAnotherExtensionSaysNothing) {
  UpgradeOptions options = only({"KHR_materials_sss", "KHR_materials_subsurface"});
  options.generation = "v1";
  const Upgraded result = upgraded(
      R"({"materials":[{"extensions":{"KHR_materials_volume":{},"KHR_materials_subsurface":)"
      R"({"scatterDistance":1,"scatterColor":[0.5,0.5,0.5]}}}]})",
      options);
  EXPECT_TRUE(result.only().done);
  EXPECT_EQ(result.only().generation, "2023");
}

// Vendor names whose objects need only steps.

TEST(Selection, TheAliasOfTranslucencyIsReadAsTheLastGeneration) {
  const Upgraded result = upgraded(
      R"({"extensionsUsed":["3DS_materials_translucency"],"textures":[{}],"materials":[{)"
      R"("pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]},"extensions":)"
      R"({"3DS_materials_translucency":{"translucencyFactor":0.5,"translucencyTexture":0}}}]})",
      only({"3DS_materials_translucency"}));
  EXPECT_EQ(extension_of(result).dump(), R"({"diffuseTransmissionFactor":0.5,)"
                                         R"("diffuseTransmissionTexture":{"index":0}})");
  EXPECT_THAT(result.json()["extensionsUsed"], ElementsAre(std::string(kNew)));
}

TEST(Selection, TheAliasBesideTheNameGoes) {
  const Upgraded result = upgraded(
      R"({"materials":[{"extensions":{"3DS_materials_translucency":{"translucencyFactor":0.5},)"
      R"("KHR_materials_translucency":{"translucencyFactor":1}}}]})",
      only({"3DS_materials_translucency", "KHR_materials_translucency"}));
  EXPECT_EQ(result.json()["materials"][0]["extensions"].dump(),
            R"({"KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":1}})");
}

TEST(Selection, DefaultsThatDifferAreWrittenOut) {
  const std::string name = "ADOBE_materials_thin_transparency";
  const auto after = [&](const std::string& legacy) {
    const std::string text = R"({"extensionsUsed":[")" + name + R"("],"extensionsRequired":[")" +
                             name + R"("],"textures":[{}],"materials":[{"extensions":{")" + name +
                             R"(":{)" + legacy + "}}}]}";
    return upgraded(text, only({name})).json();
  };
  EXPECT_EQ(after("").dump(),
            R"({"extensionsUsed":["KHR_materials_transmission","KHR_materials_ior"],)"
            R"("extensionsRequired":["KHR_materials_transmission","KHR_materials_ior"],)"
            R"("textures":[{}],"materials":[{"extensions":{"KHR_materials_transmission":)"
            R"({"transmissionFactor":1.0},"KHR_materials_ior":{"ior":1.33}}}]})");
  EXPECT_EQ(after(R"("ior":1.5,"transmissionTexture":{"index":0},"transmissionFactor":0.25)")
                ["materials"][0]["extensions"]
                    .dump(),
            R"({"KHR_materials_transmission":{"transmissionTexture":{"index":0},)"
            R"("transmissionFactor":0.25},"KHR_materials_ior":{"ior":1.5}})");
}

TEST(Selection, AnIndexOfRefractionThatIsThereStandsInTheWay) {
  const std::string text = R"({"materials":[{"extensions":{"ADOBE_materials_thin_transparency":{},)"
                           R"("KHR_materials_ior":{"ior":1.4}}}]})";
  const Upgraded result = upgraded(text, only({"ADOBE_materials_thin_transparency"}));
  EXPECT_EQ(result.text, text);
  EXPECT_THAT(result.only().notes, Contains(HasSubstr("KHR_materials_ior")));
}

std::string compressed(const std::string& view) {
  return R"({"extensionsUsed":["EXT_meshopt_compression"],)"
         R"("extensionsRequired":["EXT_meshopt_compression"],)"
         R"("buffers":[{"byteLength":1},{"byteLength":1,"extensions":)"
         R"({"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews":[{"buffer":1,)"
         R"("extensions":{"EXT_meshopt_compression":{"mode":"ATTRIBUTES"}}},)" +
         view + "]}";
}

TEST(Selection, CompressedBytesKeepAllButTheName) {
  const std::string text = compressed(R"({"buffer":0})");
  std::string wanted = text;
  for (std::size_t at = wanted.find("EXT_"); at != wanted.npos; at = wanted.find("EXT_")) {
    wanted.replace(at, 4, "KHR_");
  }
  EXPECT_EQ(upgraded(text, only({"EXT_meshopt_compression"})).text, wanted);
  EXPECT_EQ(upgraded(text).text, text);
}

TEST(Selection, CompressedBytesGoTogetherOrNotAtAll) {
  for (const char* view : {R"({"extensions":{"EXT_meshopt_compression":7}})",
                           R"({"x":{"extensions":{"EXT_meshopt_compression":{}}}})"}) {
    const std::string text = compressed(view);
    const Upgraded result = upgraded(text, only({"EXT_meshopt_compression"}));
    EXPECT_EQ(result.text, text);
    for (const UpgradeAction& action : result.plan.actions) {
      EXPECT_EQ(action.outcome, UpgradeOutcome::impossible);
    }
  }
}

const std::string kStream =
    R"({"buffer":0,"byteLength":1,"byteStride":4,"count":1,"mode":"ATTRIBUTES"})";

TEST(Selection, NoObjectIsCompressedTwice) {
  const Upgraded result =
      upgraded(compressed(R"({"extensions":{"EXT_meshopt_compression":)" + kStream +
                          R"(,"KHR_meshopt_compression":)" + kStream + "}}"),
               only({"EXT_meshopt_compression"}));
  EXPECT_EQ(result.json()["bufferViews"][1].dump(),
            R"({"extensions":{"KHR_meshopt_compression":)" + kStream + "}}");
}

}  // namespace
}  // namespace gltfx::upgrade::test

// SPDX-License-Identifier: Apache-2.0
// Extras in an object, and extensions on it, are not lost when an upgrade removes it.
#include <gmock/gmock.h>

#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

UpgradeOptions unsafe_removal() {
  UpgradeOptions options;
  options.unsafe = true;
  return options;
}

TEST(Removal, WithoutEffectButWithExtrasTheObjectIsConverted) {
  for (const std::string kept :
       {R"("extras":{"by":"me"})", R"("extensions":{"ACME_a":{"b":1}})", R"("note":"x")"}) {
    const Upgraded result = upgraded(document_with("", R"("translucencyFactor":0,)" + kept));
    EXPECT_FALSE(result.only().removed);
    EXPECT_TRUE(result.only().done);
    EXPECT_EQ(extension_of(result).dump(), R"({"diffuseTransmissionFactor":0,)" + kept + "}");
    EXPECT_THAT(result.only().notes, Contains(HasSubstr("no effect")));
    EXPECT_THAT(upgraded(result.text).plan.actions, IsEmpty());
  }
}

// Documents in which a legacy object with extras has no effect, or is next to its successor.
const std::string kHidden = R"({"extensionsUsed":["KHR_materials_translucency","ACME_a"],)"
                            R"("materials":[{"extensions":{"KHR_materials_unlit":{},)"
                            R"("KHR_materials_translucency":{"extensions":{"ACME_a":{}}}}}]})";
const std::string kDouble =
    R"({"extensionsUsed":["KHR_materials_translucency","ACME_a"],)"
    R"("materials":[{"extensions":{"KHR_materials_diffuse_transmission":{},)"
    R"("KHR_materials_translucency":{"translucencyTexture":{"index":0,)"
    R"("extensions":{"ACME_a":{}}}}}}]})";

TEST(Removal, WhereNothingTakesItsPlaceTheObjectStaysUnlessAskedFor) {
  for (const std::string& text : {kHidden, kDouble}) {
    const Upgraded left = upgraded(text);
    EXPECT_EQ(left.text, text);
    EXPECT_EQ(left.only().outcome, UpgradeOutcome::unsafe);
    EXPECT_THAT(left.only().notes, Contains("this also removes 'ACME_a'"));
    const Upgraded gone = upgraded(text, unsafe_removal());
    EXPECT_TRUE(gone.only().removed);
    EXPECT_FALSE(gone.json().contains("extensionsUsed")) << gone.text;
    EXPECT_THAT(gone.only().notes,
                Contains("ACME_a is no longer used; its declaration is removed"));
  }
}

TEST(Removal, ScatteringWithoutDistanceKeepsItsExtras) {
  const std::string text = R"({"materials":[{"extensions":{"KHR_materials_volume":{},)"
                           R"("KHR_materials_sss":{"extras":{"by":"me"}}}}]})";
  const Upgraded left = upgraded(text, only({"KHR_materials_sss"}));
  EXPECT_EQ(left.text, text);
  EXPECT_EQ(left.only().outcome, UpgradeOutcome::unsafe);
}

TEST(Removal, NamesStayWhileAnotherObjectHasThem) {
  const std::string transform =
      R"({"index":0,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}})";
  const auto names_after = [&](const std::string& material) {
    const std::string text =
        R"({"extensionsUsed":["KHR_materials_translucency","KHR_texture_transform"],)"
        R"("extensionsRequired":["KHR_texture_transform"],"textures":[{}],"materials":[{)" +
        material + R"("extensions":{"KHR_materials_translucency":{"translucencyTexture":)" +
        transform + "}}}]}";
    const Json root = upgraded(text).json();
    return root.value("extensionsUsed", Json()).dump() +
           root.value("extensionsRequired", Json()).dump();
  };
  EXPECT_EQ(names_after(""), "nullnull");
  EXPECT_EQ(names_after(R"("emissiveTexture":)" + transform + ","),
            R"(["KHR_texture_transform"]["KHR_texture_transform"])");
}

TEST(Removal, WhatIsOverwrittenIsNotLostUnasked) {
  const auto text_with = [](const std::string& info) {
    return R"({"extensionsUsed":["KHR_materials_pbrSpecularGlossiness","KHR_texture_transform"],)"
           R"("textures":[{}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,)" +
           info + R"(}},"extensions":{"KHR_materials_pbrSpecularGlossiness":{}}}]})";
  };
  const Upgraded left = upgraded(text_with(R"("extras":{"by":"me"})"));
  EXPECT_EQ(left.only().outcome, UpgradeOutcome::unsafe);
  EXPECT_THAT(
      left.only().notes,
      Contains(
          "pbrMetallicRoughness/baseColorTexture is overwritten, which also removes its extras"));
  const Upgraded done = upgraded(text_with(R"("extensions":{"KHR_texture_transform":{}})"));
  EXPECT_TRUE(done.only().done);
  EXPECT_THAT(done.json()["extensionsUsed"],
              ElementsAre("KHR_materials_specular", "KHR_materials_ior"));
}

}  // namespace
}  // namespace gltfx::upgrade::test

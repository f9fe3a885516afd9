// SPDX-License-Identifier: Apache-2.0
// Names of legacy extensions in the document's lists that have no object.
#include <gmock/gmock.h>

#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

std::string listed(const std::string& name, const std::string& others = "") {
  return R"({"extensionsUsed":["A_a",")" + name + R"("],"extensionsRequired":[")" + name + R"("])" +
         others + "}";
}

TEST(UnusedNames, GoFromBothLists) {
  for (const std::string name : {"KHR_materials_translucency", "KHR_xmp", "KHR_techniques_webgl",
                                 "KHR_materials_pbrSpecularGlossiness", "KHR_materials_sss"}) {
    const Upgraded result = upgraded(listed(name, R"(,"materials":[{}])"));
    EXPECT_EQ(result.text, R"({"extensionsUsed":["A_a"],"materials":[{}]})");
    ASSERT_THAT(result.plan.actions, SizeIs(2)) << name;
    const UpgradeAction& action = result.plan.actions[0];
    EXPECT_EQ(action.pointer, "/extensionsUsed/1");
    EXPECT_EQ(result.plan.actions[1].pointer, "/extensionsRequired/0");
    EXPECT_EQ(action.from, name);
    EXPECT_EQ(action.outcome, UpgradeOutcome::safe);
    EXPECT_TRUE(action.is_due() && action.done && action.removed);
    EXPECT_THAT(action.notes, ElementsAre("no object has " + name));
    EXPECT_THAT(upgraded(result.text).plan.actions, IsEmpty());
  }
}

TEST(UnusedNames, StayWhileAnObjectHasThemAnywhere) {
  for (const char* others : {R"(,"textures":[{"extensions":{"KHR_xmp":{}}}])",
                             R"(,"extensions":{"ACME_a":{"b":[{"extensions":{"KHR_xmp":{}}}]}})"}) {
    const std::string text = listed("KHR_xmp", others);
    EXPECT_EQ(upgraded(text).text, text);
  }
}

TEST(UnusedNames, OfWhatIsNotLegacyAreNobodysBusiness) {
  for (const std::string name :
       {"EXT_meshopt_compression", "ADOBE_materials_thin_transparency", "KHR_materials_subsurface",
        "KHR_materials_diffuse_transmission", "ACME_a"}) {
    EXPECT_EQ(upgraded(listed(name)).text, listed(name));
    EXPECT_THAT(upgraded(listed(name)).plan.actions, IsEmpty());
  }
  EXPECT_EQ(upgraded(listed("EXT_meshopt_compression"), only({"EXT_meshopt_compression"})).text,
            R"({"extensionsUsed":["A_a"]})");
}

TEST(UnusedNames, AreLeftByARunThatIsLimitedToOthers) {
  const std::string text = listed("KHR_xmp");
  EXPECT_EQ(upgraded(text, only({"KHR_materials_sss"})).text, text);
}

}  // namespace
}  // namespace gltfx::upgrade::test

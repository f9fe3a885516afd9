// SPDX-License-Identifier: Apache-2.0
// A center that positions are relative to becomes the translation of new root nodes.
#include <gmock/gmock.h>

#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::string tile(const std::string& center, const std::string& scenes = R"({"nodes":[0,1]})",
                 const std::string& more = {}) {
  return R"({"asset":{"version":"2.0"},"extensionsUsed":["CESIUM_RTC"],"extensionsRequired":["CESIUM_RTC"],)"
         R"("extensions":{"CESIUM_RTC":{"center":)" +
         center + R"(}},"scenes":[)" + scenes + R"(],"nodes":[{"name":"a"},{"name":"b"}])" + more +
         "}";
}

UpgradeOptions unsafe_options() {
  UpgradeOptions options;
  options.unsafe = true;
  return options;
}

TEST(RootTranslation, TheCenterMovesANewRoot) {
  const Upgraded result = upgraded(tile("[1000.5,2000.25,-300]"));
  const Json root = result.json();
  EXPECT_FALSE(root.contains("extensions"));
  EXPECT_FALSE(root.contains("extensionsUsed"));
  EXPECT_FALSE(root.contains("extensionsRequired"));
  EXPECT_EQ(root["scenes"].dump(), R"([{"nodes":[2]}])");
  EXPECT_EQ(root["nodes"][2].dump(), R"({"translation":[1000.5,-300,-2000.25],"children":[0,1]})");
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::safe);
  EXPECT_TRUE(result.only().removed);
  EXPECT_EQ(result.only().to, "");
  EXPECT_THAT(result.only().notes, Contains(HasSubstr("0.00006103515625 m")));
}

TEST(RootTranslation, WhatIsLostBeyondAMillimetreIsUnsafe) {
  const std::string earth = tile("[1215107.76,-4736682.90,4081926.10]");
  EXPECT_EQ(upgraded(earth).only().outcome, UpgradeOutcome::unsafe);
  EXPECT_EQ(upgraded(earth).text, earth);
  EXPECT_THAT(upgraded(earth).only().notes, Contains(HasSubstr("0.25 m")));
  const Json root = upgraded(earth, unsafe_options()).json();
  EXPECT_EQ(root["nodes"][2]["translation"].dump(), "[1215107.76,4081926.1,4736682.9]");
  EXPECT_EQ(upgraded(tile("[32000,0,0]")).only().outcome, UpgradeOutcome::safe);
  EXPECT_EQ(upgraded(tile("[0,33000,0]")).only().outcome, UpgradeOutcome::unsafe);
}

TEST(RootTranslation, EachSceneGetsARoot) {
  const std::string two = R"({"nodes":[0]},{"name":"empty"},{"nodes":[1]},{"nodes":[0]})";
  const Json root = upgraded(tile("[1,2,3]", two)).json();
  EXPECT_EQ(root["scenes"].dump(),
            R"([{"nodes":[2]},{"name":"empty"},{"nodes":[3]},{"nodes":[2]}])");
  EXPECT_EQ(root["nodes"].size(), 4U);
  EXPECT_EQ(root["nodes"][3]["children"].dump(), "[1]");
}

TEST(RootTranslation, ANodeNeverGetsTwoParents) {
  const std::string shared = tile("[1,2,3]", R"({"nodes":[0,1]},{"nodes":[1]})");
  EXPECT_EQ(upgraded(shared).only().outcome, UpgradeOutcome::impossible);
  EXPECT_THAT(upgraded(shared).only().notes, Contains(HasSubstr("share")));
  EXPECT_EQ(upgraded(shared).text, shared);
}

TEST(RootTranslation, WhatIsInvalidStays) {
  for (const std::string center : {"[1,2]", "7", "[1,2,\"3\"]"}) {
    const Upgraded result = upgraded(tile(center), unsafe_options());
    EXPECT_EQ(result.only().outcome, UpgradeOutcome::impossible) << center;
    EXPECT_EQ(result.text, tile(center));
  }
  for (const std::string scene : {R"({"nodes":[7]})", R"({"nodes":7})", R"({"nodes":[0,"1"]})"}) {
    EXPECT_EQ(upgraded(tile("[1,2,3]", scene)).only().outcome, UpgradeOutcome::impossible) << scene;
  }
}

TEST(RootTranslation, ACenterOfZeroJustGoes) {
  const Json root = upgraded(tile("[0,0,0]")).json();
  EXPECT_EQ(root["nodes"].size(), 2U);
  EXPECT_EQ(root["scenes"].dump(), R"([{"nodes":[0,1]}])");
  EXPECT_FALSE(root.contains("extensions"));
}

TEST(FirstAvatars, StayBecauseOfTheirTerms) {
  const std::string avatar =
      R"({"asset":{"version":"2.0"},"extensionsUsed":["VRM"],"extensions":{"VRM":{"meta":{}}}})";
  const Upgraded result = upgraded(avatar);
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::no_successor);
  EXPECT_THAT(result.only().notes, Contains(HasSubstr("the owner of the avatar has to confirm")));
  EXPECT_EQ(result.text, avatar);
}

}  // namespace
}  // namespace gltfx::upgrade::test

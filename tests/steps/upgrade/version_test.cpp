// SPDX-License-Identifier: Apache-2.0
// Upgrades to glTF 2.1: the version, what it has in another form, and nothing else.
#include <gmock/gmock.h>

#include "support.hpp"

namespace gltfx::upgrade::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

UpgradeOptions to_gltf(bool unsafe = false) {
  UpgradeOptions options;
  options.gltf = "2.1";
  options.unsafe = unsafe;
  return options;
}

Upgraded raised(const std::string& text, bool unsafe = false) {
  return upgraded(text, to_gltf(unsafe));
}

std::vector<std::string> pointers_of(const Plan& plan) {
  std::vector<std::string> pointers;
  for (const UpgradeAction& action : plan.actions) pointers.push_back(action.pointer);
  return pointers;
}

TEST(Version, ChangesNothingButItsString) {
  const std::string text = R"({ "asset" :{"version": "2.0", "minVersion":"2.0"},
  "nodes": [ {"name":"é", "translation":[1.50, 0,0]} ] })";
  std::string expected = text;
  expected.replace(expected.find("2.0"), 3, "2.1");
  const Upgraded result = raised(text);
  EXPECT_EQ(result.text, expected);
  EXPECT_EQ(result.only().from, "glTF 2.0");
  EXPECT_EQ(result.only().to, "glTF 2.1");
  EXPECT_TRUE(result.only().done);
  EXPECT_THAT(raised(result.text).plan.actions, IsEmpty());
}

TEST(Version, StaysUnlessItIsAskedFor) {
  EXPECT_THAT(upgraded(R"({"asset":{"version":"2.0"}})").plan.actions, IsEmpty());
}

TEST(Version, OfOtherAssetsCannotBeRaised) {
  for (const char* text :
       {R"({"asset":{"version":"3.0"}})", R"({"asset":{"version":2}})", R"({"asset":{}})", "{}"}) {
    const Upgraded result = raised(text);
    EXPECT_EQ(result.text, text);
    EXPECT_EQ(result.only().outcome, UpgradeOutcome::impossible) << text;
  }
  EXPECT_THAT(raised(R"({"asset":{"version":"2.10"}})").plan.actions, IsEmpty());
}

TEST(Version, LeavesLegacyExtensionsAlone) {
  const std::string text = document_with("", R"("translucencyFactor":1)");
  const Upgraded result = raised(text);
  EXPECT_EQ(result.only().pointer, "/asset/version");
}

TEST(Version, MakesAThumbnailAMember) {
  const Upgraded result = raised(
      R"({"asset":{"version":"2.0","extras":{"thumbnail":1}},"images":[{"uri":"a"},{"uri":"b"}]})");
  EXPECT_EQ(result.text,
            R"({"asset":{"version":"2.1","thumbnail":1},"images":[{"uri":"a"},{"uri":"b"}]})");
  const Upgraded other = raised(
      R"({"asset":{"version":"2.0","extras":{"a":1,"thumbnail":0}},"images":[{"uri":"a"}]})");
  EXPECT_EQ(other.json()["asset"].dump(), R"({"version":"2.1","extras":{"a":1},"thumbnail":0})");
}

TEST(Version, KeepsWhatIsNoIndexOfAThumbnail) {
  for (const char* thumbnail : {"1", "\"a.png\"", "-1", "0.5"}) {
    const std::string extras = std::string(R"("extras":{"thumbnail":)") + thumbnail + "}";
    const Upgraded result =
        raised(R"({"asset":{"version":"2.0",)" + extras + R"(},"images":[{"uri":"a"}]})");
    EXPECT_THAT(result.text, HasSubstr(extras));
    ASSERT_EQ(result.plan.actions.size(), 2U) << thumbnail;
    EXPECT_FALSE(result.plan.actions[1].is_due());
    EXPECT_THAT(result.plan.actions[1].notes, ElementsAre("it is not an index of images"));
  }
}

TEST(Version, RemovesTargetsOfViewsWithoutVertices) {
  const Upgraded result = raised(R"({"asset":{"version":"2.1"},"buffers":[{"byteLength":96}],
"bufferViews":[{"buffer":0,"byteLength":12,"target":34962},
{"buffer":0,"byteLength":4,"target":34963},{"buffer":0,"byteLength":4,"target":34962}],
"images":[{"bufferView":1,"mimeType":"image/png"}],
"accessors":[{"bufferView":0,"componentType":5126,"count":1,"type":"VEC3"}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})");
  EXPECT_THAT(pointers_of(result.plan), ElementsAre("/bufferViews/1/target"));
  EXPECT_TRUE(result.only().removed);
  EXPECT_EQ(result.json()["bufferViews"].dump(),
            R"([{"buffer":0,"byteLength":12,"target":34962},{"buffer":0,"byteLength":4},)"
            R"({"buffer":0,"byteLength":4,"target":34962}])");
}

TEST(Version, KeepsScenesAndPromotedExtensionsWithAReason) {
  const std::string text =
      R"({"asset":{"version":"2.1"},"extensionsUsed":["X_y","KHR_mesh_quantization"],)"
      R"("scenes":[{},{}]})";
  const Upgraded result = raised(text);
  EXPECT_EQ(result.text, text);
  EXPECT_THAT(pointers_of(result.plan), ElementsAre("/scenes", "/extensionsUsed/1"));
  for (const UpgradeAction& action : result.plan.actions) {
    EXPECT_FALSE(action.is_due());
    EXPECT_EQ(action.notes.size(), 1U);
  }
}

std::string with_shapes(const std::string& shapes, const std::string& more = "") {
  return R"({"asset":{"version":"2.1"},"extensionsUsed":["KHR_implicit_shapes"],)" + more +
         R"("extensions":{"KHR_implicit_shapes":{"shapes":[)" + shapes + "]}}}";
}

TEST(Version, WritesOutTheNumbersOfShapesOnRequest) {
  const std::string text =
      with_shapes(R"({"type":"capsule","capsule":{"height":2}},{"type":"box","name":"b"},)"
                  R"({"type":"plane","plane":{"sizeX":1}})");
  const Upgraded asked = raised(text);
  EXPECT_EQ(asked.text, text);
  EXPECT_EQ(asked.only().outcome, UpgradeOutcome::on_request);
  const Upgraded result = raised(text, true);
  EXPECT_EQ(result.only().outcome, UpgradeOutcome::unsafe);
  EXPECT_EQ(
      result.text,
      R"({"asset":{"version":"2.1"},"shapes":[{"type":"capsule","capsule":{"height":2,)"
      R"("radiusBottom":0.25,"radiusTop":0.25}},{"type":"box","name":"b","box":{"size":[1,1,1]}},)"
      R"({"type":"plane","plane":{"sizeX":1}}]})");
}

TEST(Version, KeepsShapesThatCannotMove) {
  const std::string two_sided = with_shapes(R"({"type":"plane","plane":{"doubleSided":true}})");
  const std::string used = with_shapes(
      R"({"type":"box"})",
      R"("nodes":[{"extensions":{"KHR_physics_rigid_bodies":{"collider":{"geometry":{"shape":0}}}}}],)");
  for (const std::string& text : {two_sided, used}) {
    const Upgraded result = raised(text, true);
    EXPECT_EQ(result.text, text);
    EXPECT_EQ(result.only().outcome, UpgradeOutcome::no_successor);
  }
}

}  // namespace
}  // namespace gltfx::upgrade::test

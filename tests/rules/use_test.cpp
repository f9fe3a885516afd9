// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "selected.hpp"

namespace gltfx::test {
namespace {

const std::set<std::string, std::less<>> kUseCodes{
    "BUFFER_VIEW_TARGET_MISSING", "BUFFER_VIEW_TARGET_OVERRIDE", "ACCESSOR_USAGE_OVERRIDE",
    "IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE"};

constexpr const char* kUseAccessors = R"("accessors": [
  {"bufferView": 0, "type": "VEC3", "componentType": 5126, "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"bufferView": 1, "type": "SCALAR", "componentType": 5123, "count": 1}], "buffers": [{"byteLength": 100}], )";

Lines of_members(const std::string& members, Profile profile = Profile::strict) {
  return selected(asset_with(kUseAccessors + members), kUseCodes, profile);
}

constexpr const char* kUseMesh =
    R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}], )";

TEST(Use, TheFirstUseOfAViewWithoutTargetIsHinted) {
  const std::string views =
      R"("bufferViews": [{"buffer": 0, "byteLength": 12}, {"buffer": 0, "byteLength": 2}])";
  EXPECT_EQ(of_members(kUseMesh + views),
            (Lines{"BUFFER_VIEW_TARGET_MISSING /meshes/0/primitives/0/attributes/POSITION",
                   "BUFFER_VIEW_TARGET_MISSING /meshes/0/primitives/0/indices"}));
}

TEST(Use, ATargetMustSayWhatTheViewHolds) {
  EXPECT_EQ(of_members(std::string(kUseMesh) +
                       R"("bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34963},
    {"buffer": 0, "byteLength": 2, "target": 34963}])"),
            Lines{"BUFFER_VIEW_TARGET_OVERRIDE /meshes/0/primitives/0/attributes/POSITION"});
  EXPECT_EQ(of_members(std::string(kUseMesh) +
                       R"("bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962},
    {"buffer": 0, "byteLength": 2, "target": 34963}])"),
            Lines{});
}

TEST(Use, AViewHoldsOneKindOfDataAfterItsFirstUse) {
  const std::string image = R"("images": [{"bufferView": 0, "mimeType": "image/png"}], )";
  EXPECT_EQ(of_members(kUseMesh + image + R"("bufferViews": [{"buffer": 0, "byteLength": 12},
    {"buffer": 0, "byteLength": 2, "target": 34963}])"),
            Lines{"BUFFER_VIEW_TARGET_OVERRIDE /meshes/0/primitives/0/attributes/POSITION"})
      << "images come before meshes";
  EXPECT_EQ(of_members(image +
                       R"("bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962}, {}])"),
            Lines{"BUFFER_VIEW_TARGET_OVERRIDE /images/0/bufferView"});
}

TEST(Use, AnAccessorHasOneUse) {
  EXPECT_EQ(
      of_members(
          R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0, "_A": 1}, "indices": 1}]}],
    "bufferViews": [])"),
      Lines{"ACCESSOR_USAGE_OVERRIDE /meshes/0/primitives/0/indices"});
}

TEST(Use, SkinsAndAnimationsUseAccessorsToo) {
  const std::string rest = R"("nodes": [{}], "skins": [{"joints": [0], "inverseBindMatrices": 0}],
    "animations": [{"samplers": [{"input": 0, "output": 1}],
      "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34962},
      {"buffer": 0, "byteLength": 2, "target": 34962}])";
  const Lines once{"ACCESSOR_USAGE_OVERRIDE /skins/0/inverseBindMatrices",
                   "BUFFER_VIEW_TARGET_OVERRIDE /skins/0/inverseBindMatrices",
                   "ACCESSOR_USAGE_OVERRIDE /animations/0/samplers/0/input",
                   "BUFFER_VIEW_TARGET_OVERRIDE /animations/0/samplers/0/input",
                   "BUFFER_VIEW_TARGET_OVERRIDE /animations/0/samplers/0/output"};
  EXPECT_EQ(of_members(rest), once);
  Lines twice = once;
  twice.push_back(once.back());
  EXPECT_EQ(of_members(rest, Profile::khronos), twice) << "that validator counts outputs twice";
}

TEST(Use, TheMessageTellsBothUses) {
  EXPECT_EQ(message(asset_with(
                        std::string(kUseAccessors) + kUseMesh +
                        R"("bufferViews": [{"buffer": 0, "byteLength": 12, "target": 34963}, {}])"),
                    "BUFFER_VIEW_TARGET_OVERRIDE"),
            "Buffer view 0 is used for vertex attributes, but its target is for vertex indices.");
}

TEST(ImageSource, TheViewOfAnImageHasNoStride) {
  const std::string image = R"("images": [{"bufferView": 0, "mimeType": "image/png"}], )";
  EXPECT_EQ(
      of_members(image + R"("bufferViews": [{"buffer": 0, "byteLength": 12, "byteStride": 4}])"),
      Lines{"IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE /images/0/bufferView"});
  EXPECT_EQ(of_members(image + R"("bufferViews": [{"buffer": 0, "byteLength": 12}])"), Lines{});
}

}  // namespace
}  // namespace gltfx::test

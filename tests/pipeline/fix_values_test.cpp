// SPDX-License-Identifier: Apache-2.0
// Fixes of values: null, quotes, rounding, bounds, strides, members in the wrong object.
#include <gltfx/pipeline.hpp>

#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "container/base64.hpp"
#include "container/temp_folder.hpp"
#include "model/packed_bytes.hpp"
#include "support/asset_builder.hpp"

namespace gltfx {
namespace {

using container::test::TempFolder;

// The text that a run makes of another one, `code` also unsafely; a second run changes nothing.
std::string text_after_fix(const std::string& text, const char* code = nullptr) {
  const TempFolder folder;
  const auto path = folder.write("a.gltf", text);
  FixOptions options;
  options.in_place = true;
  if (code != nullptr) {
    options.unsafe = true;
    options.only = {code};
  }
  EXPECT_EQ(fix_file(path.native(), options).error, "");
  EXPECT_FALSE(fix_file(path.native(), options).changes);
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string asset_of_members(std::string_view members) {
  return fmt::format(R"({{"asset": {{"version": "2.0"}}, {}}})", members);
}

// What becomes of members of the root.
std::string members_after_fix(std::string_view members, const char* code = nullptr) {
  const std::string text = text_after_fix(asset_of_members(members), code);
  const std::size_t begin = asset_of_members("").size() - 1;
  return text.size() > begin ? text.substr(begin, text.size() - begin - 1) : text;
}

// A list is corrected as a whole or not at all, and one that cannot be keeps no other from it.
TEST(FixIndices, OfOneListStayTogether) {
  const TempFolder folder;
  const auto path = folder.write(
      "a.gltf", asset_of_members(R"("scenes": [{"nodes": ["0", "0", "0"]}, {"nodes": ["0", "1"]}],
                                     "nodes": [{"name": "a"}, {"name": "b"}])"));
  FixOptions options;
  options.in_place = true;
  const FixReport report = fix_file(path.native(), options);
  EXPECT_TRUE(report.changes);
  ASSERT_EQ(report.actions.size(), 2U);
  EXPECT_TRUE(report.actions[0].done);
  EXPECT_EQ(report.actions[0].count, 2U);
  EXPECT_FALSE(report.actions[1].done);
  EXPECT_EQ(report.actions[1].count, 3U);
  EXPECT_EQ(report.actions[1].why_not,
            "the new file would have the new finding DUPLICATE_ELEMENTS");
}

// A reference that is read only now makes a view a view of vertices, which should have a target.
TEST(FixIndices, AHintOnWhatTheyReferToIsNoReason) {
  const char* const broken = R"("meshes": [{"primitives": [{"attributes": {"POSITION": "0"}}]}],
      "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0,
      "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3,
                     "min": [0, 0, 0], "max": [0, 0, 0]}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAA)"
                             R"(AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"}])";
  std::string sound = broken;
  sound.replace(sound.find("\"0\""), 3, "0");
  EXPECT_EQ(members_after_fix(broken), sound);
}

TEST(FixNull, GoesFromMembersThatNeedNotBeThere) {
  EXPECT_EQ(members_after_fix(
                R"("nodes": [{"skin": null, "name": "a", "children": null}], "cameras": null)"),
            R"("nodes": [{"name": "a"}])");
  EXPECT_EQ(members_after_fix(R"("nodes": [{"name": null, "extensions": null, "rotation": null}])"),
            R"("nodes": [{}])");
}

TEST(FixNull, StaysWhereAValueIsMissing) {
  const char* const kRequired = R"("buffers": [{"byteLength": null}])";
  const char* const kElement = R"("materials": [{"emissiveFactor": [1, null, 1]}])";
  const char* const kOfNobody = R"("nodes": [{"extras": {"a": null}}])";
  for (const char* const text : {kRequired, kElement, kOfNobody})
    EXPECT_EQ(members_after_fix(text), text);
}

TEST(FixQuotes, GoWhereTheTextCanMeanOneThingOnly) {
  const auto metallic = [](std::string_view value) {
    return fmt::format(R"("materials": [{{"pbrMetallicRoughness": {{"metallicFactor": {}}}}}])",
                       value);
  };
  EXPECT_EQ(members_after_fix(metallic(R"("0.5")")), metallic("0.5"));
  EXPECT_EQ(members_after_fix(metallic(R"("0,5")")), metallic("0.5"));
  EXPECT_EQ(members_after_fix(metallic(R"("0,500")")), metallic("0.500"));
  for (const char* const unclear : {R"("1,500")", R"("half")", R"("")", R"("05")", R"("0.5.1")",
                                    R"("1,2,3")", R"("1.0,5")", R"("0x1")"}) {
    EXPECT_EQ(members_after_fix(metallic(unclear)), metallic(unclear));
  }
}

TEST(FixQuotes, GoFromIndicesFlagsAndLists) {
  EXPECT_EQ(
      members_after_fix(
          R"("scene": "0", "scenes": [{"nodes": ["0", "1"]}], "nodes": [{"extras": {}}, {"extras": {}}])"),
      R"("scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [{"extras": {}}, {"extras": {}}])");
  EXPECT_EQ(members_after_fix(
                R"("materials": [{"doubleSided": "true", "emissiveFactor": ["1", 0, "0,5"]}])"),
            R"("materials": [{"doubleSided": true, "emissiveFactor": [1, 0, 0.5]}])");
  // None of them goes unless all can.
  const char* const kMixed = R"("materials": [{"emissiveFactor": ["1", "x", 1]}])";
  EXPECT_EQ(members_after_fix(kMixed), kMixed);
  const char* const kNoIndex = R"("scene": "0.5", "scenes": [{}])";
  EXPECT_EQ(members_after_fix(kNoIndex), kNoIndex);
}

TEST(FixType, NumbersBecomeWhatTheyStandFor) {
  EXPECT_EQ(members_after_fix(R"("nodes": [{"name": 5}])"), R"("nodes": [{"name": "5"}])");
  const char* const kFlag = R"("materials": [{"doubleSided": 1}])";
  EXPECT_EQ(members_after_fix(kFlag), kFlag);
  EXPECT_EQ(members_after_fix(kFlag, "TYPE_MISMATCH"), R"("materials": [{"doubleSided": true}])");
  EXPECT_EQ(text_after_fix(R"({"asset": {"version": 2.0}})"), R"({"asset": {"version": "2.0"}})");
  EXPECT_EQ(text_after_fix(R"({"asset": {"version": 2}})"), R"({"asset": {"version": "2.0"}})");
  const char* const kEnum = R"("materials": [{"alphaMode": 1}])";
  EXPECT_EQ(members_after_fix(kEnum), kEnum);
}

TEST(FixCommas, BecomePointsWhereSpacesTellThemApart) {
  const auto node = [](std::string_view value) {
    return fmt::format(R"("nodes": [{{"translation": {}}}])", value);
  };
  EXPECT_EQ(members_after_fix(node("[0,5, 0,0, 1,25]")), node("[0.5, 0.0, 1.25]"));
  EXPECT_EQ(members_after_fix(node("[-0,5, 3, 1,25]")), node("[-0.5, 3, 1.25]"));
  for (const char* const unclear : {"[0,5,0,0,1,25]", "[0,5, 0,0]", "[0,5,1, 0,0, 1]",
                                    "[0, 5, 0, 0, 1, 25]", "[0,-5, 0, 0]", "[0.5,5, 1, 1]"}) {
    EXPECT_EQ(members_after_fix(node(unclear)), node(unclear));
  }
}

TEST(FixRange, RoundingAtALimitGoes) {
  const auto color = [](std::string_view numbers) {
    return fmt::format(R"("materials": [{{"pbrMetallicRoughness": {{"baseColorFactor": [{}]}}}}])",
                       numbers);
  };
  EXPECT_EQ(members_after_fix(color("1.00000012, 0.5, -0.0000001, 1.0000001")),
            color("1, 0.5, 0, 1"));
  EXPECT_EQ(members_after_fix(color("1.00001, 0.5, 1.00000012, 1")), color("1.00001, 0.5, 1, 1"));
  EXPECT_EQ(members_after_fix(color("-0.0001, 2, 1, 1")), color("-0.0001, 2, 1, 1"));
  EXPECT_EQ(members_after_fix(R"("nodes": [{"rotation": [0, 0, 0, 1.0000001]}])"),
            R"("nodes": [{"rotation": [0, 0, 0, 1]}])");
  // There is no least number above 0.
  const char* const kOpen =
      R"("cameras": [{"type": "perspective", "perspective": {"znear": 0, "yfov": 1}}])";
  EXPECT_EQ(members_after_fix(kOpen), kOpen);
}

// Three positions, and what their accessor and its view say besides.
std::string asset_of_positions(std::string_view accessor, std::string_view view) {
  const std::string bytes =
      std::string(8, '\0') + std::string("\0\0\x80\x3f", 4) + std::string(24, '\0');
  return fmt::format(R"("scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3, {}}}],
"bufferViews": [{{"buffer": 0, "byteLength": 36, {}"target": 34962}}],
"buffers": [{{"byteLength": 36, "uri": "data:application/octet-stream;base64,{}"}}])",
                     accessor, view, container::encode_base64(bytes));
}

constexpr std::string_view kSoundBounds = R"("min": [0, 0, 0], "max": [0, 0, 1])";

TEST(FixBounds, AreWrittenAnewWhateverStandsThere) {
  for (const char* const least : {"[0, 0]", "[0, 0, 0, 0]", "[]", "0", "null", R"("0 0 0")", "{}",
                                  R"(["0", "0", "0"])", "[0, null, 0]"}) {
    EXPECT_EQ(members_after_fix(
                  asset_of_positions(fmt::format(R"("min": {}, "max": [0, 0, 1])", least), "")),
              asset_of_positions(kSoundBounds, ""))
        << least;
  }
  EXPECT_EQ(members_after_fix(asset_of_positions(R"("min": [], "max": [0])", "")),
            asset_of_positions(kSoundBounds, ""));
}

TEST(FixBounds, OfIntegersAreIntegers) {
  const auto indices = [](std::string_view most) {
    return fmt::format(R"("scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1, "mode": 0}}]}}],
"accessors": [{{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}},
{{"componentType": 5121, "type": "SCALAR", "count": 1, "min": [0], "max": [{}]}}])",
                       most);
  };
  for (const char* const most : {"0.5", "300", "-1", R"("x")"}) {
    EXPECT_EQ(members_after_fix(indices(most)), indices("0")) << most;
  }
}

// A finding marks the sampler of the second channel of the second animation.
TEST(FixKeyframes, AreThoseOfTheChannel) {
  const auto with_last_rotation = [](float w) {
    test::AssetBuilder made;
    made.accessor("SCALAR", 5126, 2, test::floats({0, 1}),
                  test::AssetBuilder::members_of(R"("min": [0], "max": [1])"));
    made.accessor("VEC4", 5126, 2, test::floats({0, 0, 0, 1, 0, 0, 0, 1}));
    made.accessor("VEC4", 5126, 2, test::floats({0, 0, 0, 1, 0, 0, 0, w}));
    return made.text(test::buffer_uri(made.bytes),
                     R"("scenes": [{"nodes": [0, 1]}], "nodes": [{}, {}], "animations": [
        {"samplers": [{"input": 0, "output": 1}],
         "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}]},
        {"samplers": [{"input": 0, "output": 1}, {"input": 0, "output": 2}],
         "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}},
                      {"sampler": 1, "target": {"node": 1, "path": "rotation"}}]}])");
  };
  EXPECT_EQ(text_after_fix(with_last_rotation(2)), with_last_rotation(1));
}

TEST(FixStride, GoesWhereElementsLiePacked) {
  for (const char* const stride : {"0", "4", "8"}) {
    const std::string view = fmt::format(R"("byteStride": {}, )", stride);
    EXPECT_EQ(members_after_fix(asset_of_positions(kSoundBounds, view)),
              asset_of_positions(kSoundBounds, ""))
        << stride;
  }
}

// Two accessors of one view.
std::string asset_of_pair(std::string_view stride, unsigned second, std::string_view type) {
  return fmt::format(R"("scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "{}": 1}}, "mode": 0}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 2, "min": [0, 0, 0], "max": [0, 0, 0]}},
{{"bufferView": 0, "byteOffset": {}, "componentType": 5126, "type": "{}", "count": 2}}],
"bufferViews": [{{"buffer": 0, "byteLength": 48, {}"target": 34962}}],
"buffers": [{{"byteLength": 48, "uri": "data:application/octet-stream;base64,{}"}}])",
                     type == "VEC3" ? "_A" : "TEXCOORD_0", second, type, stride,
                     container::encode_base64(std::string(48, '\0')));
}

TEST(FixStride, IsThatOfAllElementsWhereAttributesShareAView) {
  EXPECT_EQ(members_after_fix(asset_of_pair(R"("byteStride": 0, )", 24, "VEC3")),
            asset_of_pair(R"("byteStride": 12, )", 24, "VEC3"));
  const std::string interleaved = asset_of_pair(R"("byteStride": 0, )", 12, "VEC3");
  EXPECT_EQ(members_after_fix(interleaved), interleaved);
  const std::string different = asset_of_pair(R"("byteStride": 0, )", 24, "VEC2");
  EXPECT_EQ(members_after_fix(different), different);
}

TEST(FixStride, StaysWhereItMayBeMisspelt) {
  const std::string large = asset_of_positions(kSoundBounds, R"("byteStride": 256, )");
  EXPECT_EQ(members_after_fix(large), large);
  std::string gaps = asset_of_positions(kSoundBounds, R"("byteStride": 0, )");
  gaps.replace(gaps.find(R"("count": 3)"), 10, R"("count": 2)");
  EXPECT_EQ(members_after_fix(gaps), gaps);
}

TEST(FixMisplaced, WhatNobodyDrawsMovesIntoTheAsset) {
  EXPECT_EQ(
      text_after_fix(R"({"asset": {"version": "2.0"}, "copyright": "CC0", "generator": "x"})"),
      R"({"asset": {"version": "2.0", "copyright": "CC0", "generator": "x"}})");
  const char* const kThere = R"({"asset": {"version": "2.0", "copyright": "a"}, "copyright": "b"})";
  EXPECT_EQ(text_after_fix(kThere), kThere);
  const char* const kDrawn = R"("materials": [{"metallicFactor": 0}])";
  EXPECT_EQ(members_after_fix(kDrawn), kDrawn);
}

TEST(FixMisplaced, OthersMoveIfAskedFor) {
  constexpr const char* kCode = "UNEXPECTED_PROPERTY";
  EXPECT_EQ(
      members_after_fix(R"("materials": [{"metallicFactor": 0, "baseColorFactor": [1, 0, 0, 1]}])",
                        kCode),
      R"("materials": [{"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [1, 0, 0, 1]}}])");
  EXPECT_EQ(members_after_fix(R"("materials": [{"pbrMetallicRoughness": {"alphaMode": "BLEND"}}])",
                              kCode),
            R"("materials": [{"pbrMetallicRoughness": {}, "alphaMode": "BLEND"}])");
  // It is unclear which of the two is meant, and what is right.
  for (const char* const unclear :
       {R"("materials": [{"texCoord": 1}])", R"("materials": [{"metallicFactor": 5}])",
        R"("nodes": [{"arrayIndex": 3}])", R"("nodes": [{}], "camera": 0)",
        R"("materials": [{"metallicFactor": 0, "pbrMetallicRoughness": {"metallicFactor": 1}}])"}) {
    EXPECT_EQ(members_after_fix(unclear, kCode), unclear);
  }
}

TEST(FixMisplaced, MovesAcrossAnArrayOfOne) {
  constexpr const char* kCode = "UNEXPECTED_PROPERTY";
  const auto mesh = [](std::string_view of_mesh, std::string_view primitives) {
    return fmt::format(R"("meshes": [{{{}"primitives": [{}]}}], "accessors": [
{{"componentType": 5126, "type": "VEC3", "count": 1, "min": [0, 0, 0], "max": [0, 0, 0]}}])",
                       of_mesh, primitives);
  };
  EXPECT_EQ(members_after_fix(mesh(R"("mode": 0, )", R"({"attributes": {"POSITION": 0}})"), kCode),
            mesh("", R"({"attributes": {"POSITION": 0}, "mode": 0})"));
  const std::string two =
      mesh(R"("mode": 0, )", R"({"attributes": {"POSITION": 0}}, {"attributes": {"POSITION": 0}})");
  EXPECT_EQ(members_after_fix(two, kCode), two);
}

}  // namespace
}  // namespace gltfx

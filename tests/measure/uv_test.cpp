// SPDX-License-Identifier: Apache-2.0
// Measures of texture coordinates, by construction.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/taken.hpp"
#include "measure/uv_asset.hpp"

namespace gltfx {
namespace {

using test::operator+;
using test::quad;
using test::Taken;
using test::UvAsset;
using test::UvTriangles;
using testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Taken taken(const UvTriangles& triangles) {
  UvAsset asset;
  asset.made.add("materials", {{"name", "paint"}});
  return Taken(asset.add(triangles).text());
}

TEST(Uv, OutsideIsMoreThanTheNoiseOfCoordinates) {
  EXPECT_EQ(taken(quad(0, 0, 1, 1)).number("uv-outside"), 0);
  const float noise = 1.0F / 65536;
  EXPECT_EQ(taken(quad(-noise, 0, 1 + noise, 1)).number("uv-outside"), 0);
  EXPECT_EQ(taken(quad(0, 0, 1 + 2 * noise, 1)).number("uv-outside"), 2);
  EXPECT_EQ(taken(quad(0, -2 * noise, 1, 1)).number("uv-outside"), 2);
}

TEST(Uv, CoordinatesThatAreNotFiniteAreOutsideAndNothingElse) {
  const UvTriangles broken{{{{kNaN, 0}, {1, 0}, {1, 1}}}, {{{0, 0}, {1, 0}, {INFINITY, 1}}}};
  const Taken values = taken(broken + quad(0, 0, 1, 1));
  EXPECT_EQ(values.number("uv-outside"), 2);
  for (const char* name : {"uv-overlap", "uv-overlap-area", "uv-inverted", "uv-degenerate"}) {
    EXPECT_EQ(values.number(name), 0) << name;
  }
  EXPECT_EQ(values.number("uv-islands"), 1);
  EXPECT_EQ(values.number("uv-coverage"), 1);
}

TEST(Uv, TrianglesThatTouchDoNotOverlap) {
  const UvTriangles grid = quad(0, 0, 0.5, 0.5) + quad(0.5, 0, 1, 0.5) + quad(0, 0.5, 1, 1);
  EXPECT_EQ(taken(grid).number("uv-overlap"), 0);
  EXPECT_EQ(taken(grid).number("uv-overlap-area"), 0);
  EXPECT_EQ(taken(grid).number("uv-coverage"), 1);
}

TEST(Uv, OverlapCountsEachTriangleThatSharesArea) {
  EXPECT_EQ(taken(quad(0, 0, 1, 1) + quad(0.25, 0.5, 0.5, 0.75)).number("uv-overlap"), 4);
  EXPECT_EQ(taken(quad(0, 0, 1, 1) + quad(1, 0, 2, 1)).number("uv-overlap"), 0) << "another tile";
  const float noise = 1.0F / 65536;
  EXPECT_EQ(taken(quad(0, 0, 0.5, 1) + quad(0.5F - noise / 2, 0, 1, 1)).number("uv-overlap"), 0);
  EXPECT_EQ(taken(quad(0, 0, 0.5, 1) + quad(0.5F - 2 * noise, 0, 1, 1)).number("uv-overlap"), 4);
}

TEST(Uv, OverlapAreaIsAShareOfTheAreaInUse) {
  const auto share = [](const UvTriangles& triangles) {
    return taken(triangles).number("uv-overlap-area");
  };
  EXPECT_EQ(share(quad(0, 0, 0.5, 0.5) + quad(0, 0, 0.5, 0.5)), 1);
  EXPECT_NEAR(share(quad(0, 0, 0.5, 0.5) + quad(0.25, 0, 0.75, 0.5)), 1.0 / 3, 0.003);
  EXPECT_NEAR(share(quad(0, 0, 1, 1) + quad(0.25, 0.25, 0.75, 0.75)), 0.25, 0.003);
  EXPECT_NEAR(share(quad(0, 0, 0.5, 1) + quad(0, 0, 0.5, 1) + quad(0.5, 0, 1, 1)), 0.5, 0.003);
}

TEST(Uv, CoverageCountsOverlapsOnceAndNothingOutside) {
  EXPECT_EQ(taken(quad(0, 0, 0.5, 0.5)).number("uv-coverage"), 0.25);
  EXPECT_DOUBLE_EQ(taken(quad(-1, -1, 0.5, 3)).number("uv-coverage"), 0.5);
  EXPECT_EQ(taken(quad(2, 2, 3, 3)).number("uv-coverage"), 0);
  EXPECT_NEAR(taken(quad(0, 0, 0.5, 0.5) + quad(0.25, 0, 0.75, 0.5)).number("uv-coverage"), 0.375,
              0.002);
  EXPECT_NEAR(taken(quad(0, 0, 0.01F, 0.01F) + quad(0, 0, 0.01F, 0.01F)).number("uv-coverage"),
              0.0001, 1e-6);
}

TEST(Uv, TrianglesOfTwoMaterialsDoNotOverlap) {
  UvAsset asset;
  asset.made.add("materials", {{"name", "a"}});
  asset.made.add("materials", {{"name", "b"}});
  asset.add(quad(0, 0, 1, 1), 0).add(quad(0, 0, 1, 1), 1).add(quad(0, 0, 1, 1), -1);
  const Taken values(asset.text());
  for (const std::size_t material : {0U, 1U, 2U})
    EXPECT_EQ(values.number("uv-overlap", material), 0);
  EXPECT_TRUE(values.all().has_plain_primitives);
  EXPECT_EQ(values.number("uv-islands", 2), 1);
  EXPECT_EQ(values.of_asset("uv-islands"), 3);
}

TEST(Uv, PrimitivesOfOneMaterialAreMeasuredTogether) {
  UvAsset asset;
  asset.made.add("materials", {{"name", "a"}});
  asset.add(quad(0, 0, 0.5, 1)).add(quad(0.5, 0, 1, 1)).add(quad(0.75, 0, 0.875, 1));
  const Taken values(asset.text());
  EXPECT_EQ(values.number("uv-overlap"), 4);
  EXPECT_EQ(values.number("uv-islands"), 2) << "the first two have a common edge";
}

TEST(Uv, TheSetIsThatOfTheBaseColor) {
  UvAsset asset;
  asset.texture(8, 8);
  asset.made.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
  asset.made.json["materials"][0]["normalTexture"]["index"] = 0;
  asset.add(quad(0, 0, 2, 2), 0, 1, "TEXCOORD_1").add(quad(0, 0, 3, 1));
  const Taken values(asset.text());
  EXPECT_EQ(values.number("uv-outside"), 2);
  EXPECT_EQ(values.number("uv-overlap"), 0) << "the second primitive has no such set";
}

TEST(Uv, WithoutBaseColorTheSetIsTheLeast) {
  UvAsset asset;
  asset.made.add("textures", UvAsset::Json::object());
  asset.made.json["materials"][0]["normalTexture"] = {{"index", 0}, {"texCoord", 2}};
  asset.made.json["materials"][0]["emissiveTexture"] = {{"index", 0}, {"texCoord", 1}};
  asset.add(quad(0, 0, 2, 2), 0, 1, "TEXCOORD_1");
  EXPECT_EQ(Taken(asset.text()).number("uv-outside"), 2);
}

TEST(Uv, WithoutCoordinatesThereIsNoValue) {
  UvAsset asset;
  asset.made.add("materials", {{"name", "used"}});
  asset.made.add("materials", {{"name", "unused"}});
  asset.add(quad(0, 0, 1, 1), 0, 1, {});
  const Taken values(asset.text());
  for (const char* name : {"uv-overlap", "uv-border", "uv-gutter", "uv-coverage"}) {
    EXPECT_FALSE(values.reason(name).fault);
    EXPECT_THAT(values.reason(name).text, HasSubstr("No primitive has the texture coordinates"));
    EXPECT_THAT(values.reason(name, 1).text, HasSubstr("No triangles have the material"));
  }
  EXPECT_FALSE(values.reason("uv-overlap", 0, MeasureScope::asset).fault);
}

TEST(Uv, CoordinatesThatCannotBeReadAreAFault) {
  UvAsset asset;
  asset.made.add("materials", {{"name", "a"}});
  asset.add(quad(0, 0, 1, 1));
  asset.made.json["bufferViews"][1]["byteOffset"] = 1 << 20;
  const Taken values(asset.text());
  EXPECT_TRUE(values.reason("uv-overlap").fault);
  EXPECT_TRUE(values.reason("uv-overlap", 0, MeasureScope::asset).fault);
}

TEST(Uv, DegenerateTrianglesHaveNoOtherValue) {
  const UvTriangles flat{{{{0.5F, 0.5F}, {0.5F, 0.5F}, {0.5F, 0.5F}}},
                         {{{0.1F, 0.1F}, {0.2F, 0.2F}, {0.3F, 0.3F}}},
                         {{{0, 0}, {0, 0}, {1, 0}}}};
  const Taken values = taken(flat + flat + quad(0, 0, 1, 1));
  EXPECT_EQ(values.number("uv-degenerate"), 6);
  EXPECT_EQ(values.number("uv-overlap"), 0);
  EXPECT_EQ(values.number("uv-islands"), 1);
  EXPECT_EQ(taken(quad(0, 0, 0.001F, 1)).number("uv-degenerate"), 0) << "thin, but with an area";
}

TEST(Uv, MirroredTrianglesAreInverted) {
  EXPECT_EQ(taken(quad(0, 0, 1, 1)).number("uv-inverted"), 0);
  EXPECT_EQ(taken(quad(1, 0, 0, 1)).number("uv-inverted"), 2);
  EXPECT_EQ(taken(quad(1, 1, 0, 0)).number("uv-inverted"), 0) << "turned by half a turn";
}

TEST(Uv, IslandsAreJoinedByEdgesWithEqualCoordinates) {
  EXPECT_EQ(taken(quad(0, 0, 0.5, 1) + quad(0.5, 0, 1, 1)).number("uv-islands"), 1);
  EXPECT_EQ(taken(quad(0, 0, 0.5, 0.5) + quad(0.5, 0.5, 1, 1)).number("uv-islands"), 2);
  EXPECT_EQ(taken(quad(0, 0, 0.5, 1) + quad(0.5, 0, 1, 0.5)).number("uv-islands"), 2) << "T";
  EXPECT_EQ(taken(quad(-0.0F, 0, 0.5, 1) + quad(-0.5, 0, 0.0F, 1)).number("uv-islands"), 1);
}

// Of a texture of 512 x 256 texels.
Taken with_texture(const UvTriangles& triangles, int wrap = 33071) {
  return Taken(
      UvAsset().texture(512, 256, {{"wrapS", wrap}, {"wrapT", wrap}}).add(triangles).text());
}

TEST(Uv, GutterIsADistanceInTexels) {
  const UvTriangles left = quad(0.25, 0.25, 0.375, 0.5);
  EXPECT_EQ(with_texture(left + quad(0.375F + 4.0F / 512, 0.25, 0.75, 0.5)).number("uv-gutter"), 4);
  EXPECT_EQ(with_texture(left + quad(0.25, 0.5F + 4.0F / 256, 0.5, 0.75)).number("uv-gutter"), 4);
  const float u = 0.375F + 3.0F / 512;
  const float v = 0.5F + 4.0F / 256;
  EXPECT_EQ(with_texture(left + quad(u, v, 1, 1)).number("uv-gutter"), 5)
      << "from corner to corner";
  EXPECT_EQ(with_texture(left + quad(0.375, 0.375, 0.5, 1)).number("uv-gutter"), 0) << "touches";
  EXPECT_EQ(with_texture(left + quad(0.75, 0.25, 1, 0.5)).number("uv-gutter"), 64) << "or more";
  EXPECT_THAT(with_texture(left).reason("uv-gutter").text, HasSubstr("no two islands"));
}

TEST(Uv, GutterIsMeasuredOverTheEdgesOfATextureThatRepeats) {
  const UvTriangles sides =
      quad(2.0F / 512, 0.25, 0.25, 0.5) + quad(0.75, 0.25, 1 - 3.0F / 512, 0.5);
  EXPECT_EQ(with_texture(sides).number("uv-gutter"), 64);
  EXPECT_EQ(with_texture(sides, 10497).number("uv-gutter"), 5);
  const UvTriangles corners =
      quad(1.0F / 512, 2.0F / 256, 0.25, 0.25) + quad(0.75, 0.75, 1 - 2.0F / 512, 1 - 2.0F / 256);
  EXPECT_EQ(with_texture(corners, 10497).number("uv-gutter"), 5);
}

TEST(Uv, GutterCanBeMeasuredAtAnotherSize) {
  measure::Request request;
  request.parameters.gutter_at = 1024;
  UvAsset asset;
  asset.made.add("materials", {{"name", "a"}});
  asset.add(quad(0.125, 0.125, 0.25, 0.5) + quad(0.25F + 1.0F / 128, 0.125, 0.5, 0.5));
  EXPECT_EQ(Taken(asset.text(), request).number("uv-gutter"), 8);
  EXPECT_THAT(Taken(asset.text()).reason("uv-gutter").text, HasSubstr("no texture"));
}

TEST(Uv, StackedCopiesOfAnIslandAreOneIsland) {
  const UvTriangles island = quad(0.25, 0.25, 0.375, 0.5);
  const UvTriangles other = quad(0.375F + 4.0F / 512, 0.25, 0.75, 0.5);
  const Taken values = with_texture(island + island + other);
  EXPECT_EQ(values.number("uv-islands"), 2);
  EXPECT_EQ(values.number("uv-gutter"), 4);
}

TEST(Uv, BorderIsTheDistanceFromTheEdgesInTexels) {
  EXPECT_EQ(with_texture(quad(3.0F / 512, 0.25, 0.5, 0.5)).number("uv-border"), 3);
  EXPECT_EQ(with_texture(quad(0.25, 0.25, 0.5, 1 - 2.0F / 256)).number("uv-border"), 2);
  EXPECT_EQ(with_texture(quad(0.25, 0.25, 0.5, 1)).number("uv-border"), 0);
  EXPECT_EQ(with_texture(quad(0.25, 0.25, 0.5, 2)).number("uv-border"), 0);
  EXPECT_THAT(taken(quad(0, 0, 1, 1)).reason("uv-border").text, HasSubstr("no texture"));
}

TEST(Uv, AnImageWithoutHeaderIsAFault) {
  UvAsset asset;
  asset.texture("no image").add(quad(0, 0, 0.5, 0.5));
  EXPECT_TRUE(Taken(asset.text()).reason("uv-border").fault);
}

}  // namespace
}  // namespace gltfx

// SPDX-License-Identifier: Apache-2.0
// Limits as a user writes them.
#include "measure/limit.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "measure/quantity.hpp"

namespace gltfx::measure {
namespace {

using testing::HasSubstr;

// "mesh.triangles max 20,000" for each limit, with ", " between them; or the mistake.
std::string read(const std::string& text) {
  const auto changes = read_budget(text, "here");
  if (!changes) return changes.error().message;
  std::string all;
  for (const LimitChange& change : *changes) {
    for (const Limit& limit : change.limits) {
      if (!all.empty()) all += ", ";
      all.append(measure_scope_name(limit.on)).append(".").append(limit.measure->name).append(" ");
      all.append(limit_op_name(limit.op)).append(" ").append(value_words(limit));
    }
    if (change.limits.empty()) all += change.op ? limit_op_name(*change.op) : "all";
  }
  return all;
}

TEST(Budgets, ABareValueIsAMaximum) {
  EXPECT_EQ(read("triangles=100000"), "asset.triangles max 100,000");
  EXPECT_EQ(read("mesh.triangles=20000"), "mesh.triangles max 20,000");
  EXPECT_EQ(read("asset.triangles=1"), "asset.triangles max 1");
  EXPECT_EQ(read("image.power-of-two=true"), "image.power-of-two equal true");
}

TEST(Budgets, RangesHaveTwoEnds) {
  EXPECT_EQ(read("size-y=0.01..5"), "asset.size-y min 0.01 m, asset.size-y max 5 m");
  EXPECT_EQ(read("size-y=1 cm..5"), "asset.size-y min 0.01 m, asset.size-y max 5 m");
  EXPECT_EQ(read("size-y=..5"), "asset.size-y max 5 m");
  EXPECT_EQ(read("size-y=1.."), "asset.size-y min 1 m");
}

TEST(Budgets, OpsAreNamed) {
  EXPECT_EQ(read("mesh.triangles.min=1"), "mesh.triangles min 1");
  EXPECT_EQ(read("mesh.name.match=^SM_[a-z]+$"), "mesh.name match ^SM_[a-z]+$");
  EXPECT_EQ(read("mesh.name.unique=true"), "mesh.name unique true");
  EXPECT_EQ(read("extensions.allow=KHR_a,KHR_texture_*"),
            "asset.extensions allow KHR_a, KHR_texture_*");
  EXPECT_EQ(read("image.power-of-two.equal=false"), "image.power-of-two equal false");
}

TEST(Budgets, FalseLifts) {
  EXPECT_EQ(read("triangles=false"), "all");
  EXPECT_EQ(read("mesh.name.unique=false"), "unique");
}

TEST(Budgets, MistakesNameWhatIsMeant) {
  EXPECT_THAT(read("triangels=1"), HasSubstr("did you mean 'triangles'?"));
  EXPECT_THAT(read("mash.triangles=1"), HasSubstr("did you mean 'mesh'?"));
  EXPECT_THAT(read("mesh.name.mtach=A"), HasSubstr("did you mean 'match'?"));
  EXPECT_THAT(read("node.triangles=1"),
              HasSubstr("is not a measure of node; it is one of the asset, mesh and primitive"));
  EXPECT_THAT(read("mesh.triangles.match=A"),
              HasSubstr("is not an operator of triangles, which is a number; its operators are "
                        "min, max and equal"));
  EXPECT_THAT(read("mesh.name=A"), HasSubstr("name an operator"));
  EXPECT_THAT(read("triangles"), HasSubstr("MEASURE=LIMIT"));
  EXPECT_THAT(read("mesh.triangles.max.more=1"), HasSubstr("SCOPE.MEASURE"));
  EXPECT_THAT(read("=1"), HasSubstr("no measure"));
  EXPECT_THAT(read("mesh.name.match=("), HasSubstr("not a pattern"));
  EXPECT_THAT(read("extensions.allow=K*R"), HasSubstr("at the end"));
  EXPECT_THAT(read("file-name.unique=true"), HasSubstr("not an operator"));
  EXPECT_THAT(read("image.power-of-two.max=true"), HasSubstr("a flag; its operator is equal"));
  EXPECT_EQ(read("mesh.name.unique=1"), "unique of name must be true or false");
}

TEST(Budgets, RangesHaveAnEnd) {
  EXPECT_THAT(read("images=.."), HasSubstr("'..' has neither end"));
  EXPECT_THAT(read("size-y=.."), HasSubstr("neither end"));
}

TEST(Budgets, PixelsOfAGutterAreWhole) {
  MeasureParameters parameters;
  EXPECT_TRUE(set_parameter(parameters, "at", 0.5));
  EXPECT_TRUE(set_parameter(parameters, "at", std::string("1024.5 px")));
  EXPECT_FALSE(set_parameter(parameters, "at", 1024.0));
  EXPECT_EQ(parameters.gutter_at, 1024U);
}

TEST(Budgets, NumbersAreFinite) {
  for (const char* const number : {"nan", "inf", "1e999", "", "x", "--1"}) {
    EXPECT_THAT(read("triangles.max=" + std::string(number)), HasSubstr("not a number")) << number;
  }
}

TEST(Budgets, UnitsAreThoseOfTheMeasure) {
  EXPECT_EQ(read("file-size=5 MiB"), "asset.file-size max 5,242,880 bytes");
  EXPECT_EQ(read("file-size=1.5kB"), "asset.file-size max 1,500 bytes");
  EXPECT_EQ(read("size-x=250 mm"), "asset.size-x max 0.25 m");
  EXPECT_THAT(read("file-size=5 m"), HasSubstr("is not in B, kB, MB, GB, KiB, MiB or GiB"));
  EXPECT_THAT(read("file-size=5 kb"), HasSubstr("did you mean 'kB'?"));
  EXPECT_THAT(read("triangles=5 m"), HasSubstr("the measure has none"));
}

TEST(Quantities, HaveThousandsAndUnits) {
  EXPECT_EQ(quantity_words(1234567, "B"), "1,234,567 bytes");
  EXPECT_EQ(quantity_words(1, "B"), "1 byte");
  EXPECT_EQ(quantity_words(16, "bit"), "16 bits");
  EXPECT_EQ(quantity_words(-1234, ""), "-1,234");
  EXPECT_EQ(quantity_words(999, ""), "999");
  EXPECT_EQ(quantity_words(0.1 + 0.2, "m"), "0.3 m");
  EXPECT_EQ(number_words(1e300), "1e+300");
}

TEST(Limits, ParametersHaveWords) {
  MeasureParameters parameters;
  EXPECT_EQ(parameter_words(parameters), "");
  EXPECT_FALSE(set_parameter(parameters, "weld", "1 mm"));
  EXPECT_FALSE(set_parameter(parameters, "angle", 30.0));
  EXPECT_EQ(parameter_words(parameters), "weld 0.001 m, angle 30 deg");
  EXPECT_FALSE(set_parameter(parameters, "at", 1024.0));
  EXPECT_FALSE(set_parameter(parameters, "slot", "normalTexture"));
  EXPECT_EQ(parameter_words(parameters),
            "weld 0.001 m, angle 30 deg, at 1024 px, slot normalTexture");
}

TEST(Limits, LaterOnesReplaceThoseOfTheSameMeasureAndOp) {
  std::vector<Limit> limits;
  for (const char* const text : {"triangles=1..5", "mesh.triangles=7", "triangles=3", "nodes=2"}) {
    const auto changes = read_budget(text, {});
    for (const LimitChange& change : *changes) measure::apply(limits, change);
  }
  std::string all;
  for (const Limit& limit : limits) {
    all.append(limit.measure->name).append(" ").append(limit_op_name(limit.op)).append(" ");
    all.append(value_words(limit)).append("\n");
  }
  EXPECT_EQ(all, "nodes max 2\ntriangles min 1\ntriangles max 3\ntriangles max 7\n");
  measure::apply(limits, (*read_budget("triangles=false", {})).front());
  EXPECT_EQ(limits.size(), 2U);
}

}  // namespace
}  // namespace gltfx::measure

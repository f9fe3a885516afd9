// SPDX-License-Identifier: Apache-2.0
#include "base/loss_bounds.hpp"

#include <gmock/gmock.h>

namespace gltfx {
namespace {

std::string error_of(std::string_view text) {
  const auto bounds = parse_loss_bounds(text);
  return bounds ? std::string() : bounds.error().message;
}

TEST(LossBounds, HaveDefaults) {
  const auto bounds = parse_loss_bounds("normal=0.5deg");
  ASSERT_TRUE(bounds);
  EXPECT_EQ(bounds->position, 1e-4);
  EXPECT_EQ(bounds->normal, 0.5);
  EXPECT_EQ(bounds->texcoord, 0.25);
  EXPECT_EQ(bounds->color, 0.5 / 255);
  EXPECT_EQ(bounds->weight, 5e-4);
  EXPECT_EQ(bounds->animation, std::nullopt);
}

TEST(LossBounds, HaveUnits) {
  const auto bounds = parse_loss_bounds(
      "position=1e-3%,normal=2deg,texcoord=1texel,color=1/255,weight=off,animation=0.1%");
  ASSERT_TRUE(bounds) << error_of("");
  EXPECT_DOUBLE_EQ(bounds->position.value_or(0), 1e-5);
  EXPECT_EQ(bounds->normal, 2);
  EXPECT_EQ(bounds->texcoord, 1);
  EXPECT_EQ(bounds->color, 1.0 / 255);
  EXPECT_EQ(bounds->weight, std::nullopt);
  EXPECT_DOUBLE_EQ(bounds->animation.value_or(0), 1e-3);
  EXPECT_EQ(parse_loss_bounds("color=0.25")->color, 0.25);
}

TEST(LossBounds, NameTheNearestBound) {
  EXPECT_EQ(error_of("postion=1%"), "'postion' is no bound of a loss; did you mean 'position'?");
  EXPECT_EQ(error_of(""), "'' is no bound of a loss");
  EXPECT_EQ(error_of("normal=1deg,"), "'' is no bound of a loss");
}

TEST(LossBounds, NeedAValueWithItsUnit) {
  EXPECT_EQ(error_of("position=0.1"),
            "'0.1' is no bound of position; write position=0.01% or position=off");
  for (const char* text : {"position", "position=", "position=%", "position=-1%", "position=0%",
                           "position=nan%", "position=1e999%", "normal=1%", "color=1/0",
                           "color=/255", "color=1/2/3", "weight=1%%", "texcoord=1 texel"}) {
    EXPECT_NE(error_of(text), "") << text;
  }
}

}  // namespace
}  // namespace gltfx

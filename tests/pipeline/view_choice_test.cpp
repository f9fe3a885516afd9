// SPDX-License-Identifier: Apache-2.0
// From which side many things are shown.
#include <gmock/gmock.h>

#include "pipeline/rooms.hpp"

namespace gltfx::test {
namespace {

class ViewChoice : public Baking {
 protected:
  ViewChoice() {
    options.sizes = {{24, 24}};
    options.samples = 2;
  }

  std::vector<std::uint8_t> seen_from(AssetText& asset, const char* camera) {
    options.cameras = {camera};
    const BakeReport done = report(asset);
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
    return done.pixels.bytes;
  }
  // Whether the picture without a camera is that of these angles.
  bool is_shown_from(const char* angles, AssetText asset) {
    return seen_from(asset, "") == seen_from(asset, angles);
  }
};

constexpr const char* kUsual = "32,18";

AssetText balls(int wide, int high, int deep) {
  AssetText asset;
  const int ball = asset.mesh(render::sphere(0.5F, 12), asset.material(plastic()));
  for (int i = 0; i < wide * high * deep; ++i) {
    const Json place{i % wide * 1.2, i / wide % high * 1.2, i / wide / high * 1.2};
    asset.node({{"mesh", ball}, {"translation", place}});
  }
  return asset;
}

// Furniture between walls: without a ceiling, or on a floor alone.
AssetText furniture(bool walls) {
  AssetText asset;
  const int wall = asset.material(dielectric({0.85, 0.8, 0.7, 1}, 0.9));
  const auto add = [&](const Float3& from, const Float3& to) {
    asset.node({{"mesh", asset.mesh(box(from, to), wall)}});
  };
  add({-2.7F, -0.2F, -2.2F}, {2.7F, 0, 2.2F});
  if (walls) {
    add({-2.7F, 0, -2.2F}, {-2.5F, 2.6F, 2.2F});
    add({2.5F, 0, -2.2F}, {2.7F, 2.6F, 2.2F});
    add({-2.5F, 0, -2.2F}, {2.5F, 2.6F, -2});
    add({-2.5F, 0, 2}, {2.5F, 2.6F, 2.2F});
  }
  furnish(asset);
  return asset;
}

TEST_F(ViewChoice, UprightRowsAreShownFromTheFront) {
  EXPECT_TRUE(is_shown_from("8,6", balls(7, 7, 1)));
  EXPECT_TRUE(is_shown_from("8,6", balls(7, 5, 1)));
  EXPECT_TRUE(is_shown_from("82,6", balls(1, 6, 6))) << "from their own front";
}

TEST_F(ViewChoice, OtherThingsAreShownAsUsual) {
  EXPECT_TRUE(is_shown_from(kUsual, balls(1, 1, 1)));
  EXPECT_TRUE(is_shown_from(kUsual, balls(3, 3, 3)));
  EXPECT_TRUE(is_shown_from("32,38", balls(6, 1, 6))) << "level rows";
  EXPECT_TRUE(is_shown_from(kUsual, furniture(false)));
}

TEST_F(ViewChoice, OpenRoomsAreShownFromAbove) {
  EXPECT_TRUE(is_shown_from("32,45", furniture(true)));
}

// Boxes below a ceiling.
AssetText hall(float half) {
  AssetText asset;
  const int grey = asset.material(dielectric({0.8, 0.8, 0.8, 1}, 0.9));
  for (const float y : {-0.2F, 2.6F}) {
    asset.node({{"mesh", asset.mesh(box({-half, y, -half}, {half, y + 0.2F, half}), grey)}});
  }
  const int thing = asset.mesh(render::cube(0.4F), asset.material(plastic()));
  for (int i = 0; i < 25; ++i) {
    const float step = half / 2.5F;
    asset.node(
        {{"mesh", thing},
         {"translation",
          {static_cast<float>(i % 5 - 2) * step, 0.4, static_cast<float>(i / 5 - 2) * step}}});
  }
  return asset;
}

TEST_F(ViewChoice, HallsWithoutWallsAreShownFromBelowTheirCeiling) {
  EXPECT_TRUE(is_shown_from("32,5", hall(12)));
  EXPECT_TRUE(is_shown_from(kUsual, hall(3))) << "all of it is seen below the ceiling";
}

}  // namespace
}  // namespace gltfx::test

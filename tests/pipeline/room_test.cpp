// SPDX-License-Identifier: Apache-2.0
// A furnished room whose walls are single-sided, as in scans of flats and hotels: the camera looks
// in through the walls that turn their backs to it, and light comes in there.
#include "pipeline/rooms.hpp"

namespace gltfx::test {
namespace {

class Room : public Baking {
 protected:
  Room() {
    options.cameras.clear();
    options.sizes = {{24, 24}};
    options.samples = 32;
  }

  // The mean of what is seen of the scene, as numbers of a picture for the screen.
  double brightness(AssetText asset) {
    options.background = {BakeBackground::Kind::transparent};
    const BakeReport done = report(asset);
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
    double sum = 0;
    double covered = 0;
    for (std::size_t i = 0; i + 3 < done.pixels.bytes.size(); i += 4) {
      if (done.pixels.bytes[i + 3] < 255) continue;
      for (std::size_t c = 0; c < 3; ++c) sum += done.pixels.bytes[i + c] / 3.0;
      ++covered;
    }
    EXPECT_GT(covered, 100);
    return sum / covered;
  }
};

TEST_F(Room, IsLitThroughTheWallsThatTheCameraLooksThrough) {
  EXPECT_GT(brightness(room(false)), 100);
  EXPECT_GT(brightness(room(false, false)), 110);
  for (const char* angles : {"0,0", "120,30", "250,5", "45,80"}) {
    options.cameras = {angles};
    EXPECT_GT(brightness(room(false)), 90) << angles;
  }
}

TEST_F(Room, IsLitAroundACameraInside) {
  AssetText asset = room(false);
  asset.camera({{"type", "perspective"}, {"perspective", {{"yfov", 1.2}, {"znear", 0.01}}}},
               {{"translation", {-1, 1.5, 1.8}}});
  options.cameras = {"0"};
  EXPECT_GT(brightness(std::move(asset)), 100);
}

// What stands in the light throws a shadow onto the floor, be it single-sided.
TEST_F(Room, FurnitureThrowsShadows) {
  surround(1);
  options.samples = 64;
  const auto under_the_table = [&](bool with_table) {
    AssetText asset = room(false, false);
    if (with_table) {
      asset.draw(box({-1, 0.5F, -1}, {1, 0.55F, 1}), dielectric({0.5, 0.5, 0.5, 1}, 1));
    }
    asset.camera({{"type", "perspective"}, {"perspective", {{"yfov", 0.1}, {"znear", 0.01}}}},
                 {{"translation", {0, 0.3, 1.9}}, {"rotation", {-0.0784591, 0, 0, 0.9969173}}});
    options.cameras = {"0"};
    return bake(asset).mean(1);
  };
  EXPECT_LT(under_the_table(true), 0.7 * under_the_table(false));
}

}  // namespace
}  // namespace gltfx::test

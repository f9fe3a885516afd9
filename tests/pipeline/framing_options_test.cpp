// SPDX-License-Identifier: Apache-2.0
// What the picture is of, and how it is projected: an asset and options in, pixels out.
#include <gmock/gmock.h>

#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

using testing::HasSubstr;

render::Mesh block(const Float3& middle, const Float3& half) {
  render::Mesh mesh = render::cube();
  for (Float3& p : mesh.positions) {
    for (std::size_t i = 0; i < 3; ++i) p[i] = middle[i] + (p[i] < 0 ? -half[i] : half[i]);
  }
  return mesh;
}

// The extent of what is seen, in pixels, and how many pixels it takes.
struct Seen {
  int left = 1 << 20, right = -1, upper = 1 << 20, lower = -1, count = 0;
  int width() const { return right - left + 1; }
  int height() const { return lower - upper + 1; }
};

class FramingOptions : public Baking {
 protected:
  FramingOptions() {
    options.cameras = {"front"};
    options.sizes = {{64, 64}};
    options.samples = 4;
    options.background = {BakeBackground::Kind::transparent};
  }

  // `wanted` takes red, green and blue.
  template <class Wanted>
  static Seen seen(const BakedPixels& pixels, const Wanted& wanted) {
    Seen seen;
    for (std::size_t i = 0; 4 * i < pixels.bytes.size(); ++i) {
      const std::uint8_t* p = &pixels.bytes[4 * i];
      if (p[3] < 128 || !wanted(p[0], p[1], p[2])) continue;
      const int x = static_cast<int>(i % pixels.width);
      const int y = static_cast<int>(i / pixels.width);
      seen.left = std::min(seen.left, x);
      seen.right = std::max(seen.right, x);
      seen.upper = std::min(seen.upper, y);
      seen.lower = std::max(seen.lower, y);
      ++seen.count;
    }
    return seen;
  }
  static Seen red(const BakedPixels& pixels) {
    return seen(pixels, [](int r, int, int b) { return r > b + 30; });
  }
  static Seen blue(const BakedPixels& pixels) {
    return seen(pixels, [](int r, int, int b) { return b > r + 30; });
  }
  BakedPixels pixels(AssetText& asset) {
    const BakeReport done = report(asset);
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
    return done.pixels;
  }
};

// A red tower, and a blue toy of two parts at its foot.
AssetText tower_and_toy() {
  AssetText asset;
  asset.draw(block({-2, 5, 0}, {1, 5, 1}), dielectric({0.8, 0.05, 0.05, 1}, 1),
             {{"name", "tower"}});
  const int blue = asset.material(dielectric({0.05, 0.05, 0.8, 1}, 1));
  const int part = asset.mesh(block({0, 0.2F, 0}, {0.2F, 0.2F, 0.2F}), blue);
  const int left = asset.add("nodes", {{"mesh", part}, {"translation", {-0.5, 0, 0}}});
  const int right = asset.add("nodes", {{"mesh", part}, {"translation", {0.5, 0, 0}}});
  asset.node({{"name", "toy"}, {"children", {left, right}}});
  asset.node({{"name", "nothing"}});
  return asset;
}

TEST_F(FramingOptions, ANodeIsFramedWithItsChildren) {
  AssetText asset = tower_and_toy();
  const Seen before = blue(pixels(asset));
  EXPECT_LT(before.width(), 10);
  options.frame = "toy";
  const BakedPixels framed = pixels(asset);
  const Seen toy = blue(framed);
  EXPECT_GT(toy.width(), 50) << "both parts, as large as they go";
  EXPECT_LT(toy.width(), 62);
  EXPECT_NEAR((toy.left + toy.right) / 2.0, 31.5, 2) << "in the middle";
  EXPECT_GT(red(framed).count, 20) << "the tower beside it is drawn all the same";
  options.frame = "3";
  EXPECT_EQ(pixels(asset).bytes, framed.bytes);
  options.frame = "/nodes/3";
  EXPECT_EQ(pixels(asset).bytes, framed.bytes);
  options.projection = BakeProjection::orthographic;
  EXPECT_GT(blue(pixels(asset)).width(), 50);
}

// The tower stands between the toy and the light.
TEST_F(FramingOptions, WhatIsNotFramedThrowsShadows) {
  options.samples = 32;
  options.frame = "toy";
  const auto brightness = [this](bool with_tower) {
    AssetText asset = tower_and_toy();
    if (!with_tower) asset.json()["scenes"][0]["nodes"] = {3};
    double sum = 0;
    const BakedPixels drawn = pixels(asset);
    for (std::size_t i = 0; i < drawn.bytes.size(); i += 4) {
      if (drawn.bytes[i + 3] == 255 && drawn.bytes[i + 2] > drawn.bytes[i] + 30) {
        sum += drawn.bytes[i + 2];
      }
    }
    return sum / blue(drawn).count;
  };
  EXPECT_LT(brightness(true), 0.95 * brightness(false));
}

TEST_F(FramingOptions, ANodeThatCannotBeFramedIsNamed) {
  AssetText asset = tower_and_toy();
  const auto complaint = [&](const char* node, BakeProblem problem) {
    options.frame = node;
    const BakeReport done = report(asset);
    EXPECT_EQ(done.problem, problem);
    return done.error;
  };
  EXPECT_THAT(complaint("tyo", BakeProblem::refused),
              AllOf(HasSubstr("it has no node 'tyo'"), HasSubstr("Did you mean 'toy'?")));
  EXPECT_THAT(complaint("/nodes/9", BakeProblem::refused), HasSubstr("it has no node '/nodes/9'"));
  EXPECT_EQ(complaint("nothing", BakeProblem::nothing_to_see),
            "nothing of node 'nothing' and its children is visible in the scene");
  asset.json()["scenes"][0]["nodes"] = {0};
  EXPECT_THAT(complaint("toy", BakeProblem::nothing_to_see), HasSubstr("node 'toy'"));
  asset.camera({{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.01}}}}, {});
  options.cameras = {"0"};
  EXPECT_THAT(complaint("tower", BakeProblem::refused), HasSubstr("has a fixed place"));
}

// A red block before a blue one of the same size.
TEST_F(FramingOptions, OrthographicSizesDoNotDependOnTheDistance) {
  AssetText asset;
  asset.draw(block({-2, 0, 5}, {1, 1, 1}), dielectric({0.8, 0.05, 0.05, 1}, 1));
  asset.draw(block({2, 0, -5}, {1, 1, 1}), dielectric({0.05, 0.05, 0.8, 1}, 1));
  const BakedPixels perspective = pixels(asset);
  EXPECT_GT(red(perspective).width(), blue(perspective).width() + 4);
  options.projection = BakeProjection::orthographic;
  const BakedPixels drawn = pixels(asset);
  EXPECT_NEAR(red(drawn).width(), blue(drawn).width(), 1);
  EXPECT_NEAR(red(drawn).width(), red(drawn).height(), 1);
  EXPECT_NEAR(blue(drawn).right - red(drawn).left, 0.9 * 64, 2) << "as large as it goes";
  options.sizes = {{128, 64}};
  EXPECT_NEAR(red(pixels(asset)).width(), 2 * red(drawn).width(), 2) << "in a wide picture too";
}

// Seen along its diagonal a cube is a regular hexagon.
TEST_F(FramingOptions, OrthographicIsoIsIsometric) {
  AssetText asset;
  asset.draw(render::cube(), plastic());
  options.cameras = {"iso"};
  options.projection = BakeProjection::orthographic;
  options.sizes = {{128, 128}};
  const Seen cube = seen(pixels(asset), [](int, int, int) { return true; });
  EXPECT_NEAR(cube.height(), 0.9 * 128, 2);
  EXPECT_NEAR(cube.width(), std::sqrt(0.75) * cube.height(), 2);
  EXPECT_NEAR(cube.count, 0.75 * cube.width() * cube.height(), 0.02 * 128 * 128);
  for (const char* side : {"front", "top", "left"}) {
    options.cameras = {side};
    const Seen square = seen(pixels(asset), [](int, int, int) { return true; });
    EXPECT_NEAR(square.width(), 0.9 * 128, 2) << side;
    EXPECT_NEAR(square.count, square.width() * square.height(), 64) << side;
  }
}

TEST_F(FramingOptions, ACameraOfTheAssetHasItsOwnProjection) {
  AssetText asset;
  asset.draw(render::cube(), plastic());
  asset.orthographic(2, 5);
  asset.camera({{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.01}}}},
               {{"translation", {0, 0, 5}}});
  options.cameras = {"0"};
  const BakedPixels own = pixels(asset);
  options.projection = BakeProjection::orthographic;
  EXPECT_EQ(pixels(asset).bytes, own.bytes);
  options.cameras = {"1"};
  EXPECT_THAT(report(asset).error, HasSubstr("has its own projection"));
}

}  // namespace
}  // namespace gltfx::test

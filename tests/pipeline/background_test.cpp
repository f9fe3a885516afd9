// SPDX-License-Identifier: Apache-2.0
// What is behind the asset, which way its light comes from, and tone curves.
#include <gmock/gmock.h>

#include "pipeline/baking.hpp"
#include "render/tone_curve.hpp"
#include "render/tonemap.hpp"

namespace gltfx::test {
namespace {

using Kind = BakeBackground::Kind;
using testing::ElementsAre;

class Backgrounds : public Baking {
 protected:
  Backgrounds() {
    options.cameras = {"front"};
    options.sizes = {{32, 32}};
    cube_.draw(render::cube(), dielectric({0.6, 0.6, 0.6, 1}, 1));
  }
  /// A picture of a cube, as OpenEXR.
  Numbers light() { return bake(cube_); }
  /// The same, in 8 bits.
  BakedPixels pixels() {
    options.output.clear();
    BakeReport done = report(cube_);
    EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
    return std::move(done.pixels);
  }
  /// A bright column of an environment with four; its middle is at azimuth 45, 135, 225 or 315.
  void shine_from(int azimuth) {
    options.environment = (folder.path() / "side.exr").native();
    preview::Picture sky{4, 2, 3, {}, std::vector<float>(24, 0.1F)};
    const std::size_t column = 3 - static_cast<std::size_t>(azimuth / 90);
    for (std::size_t row = 0; row < 2; ++row) {
      for (std::size_t c = 0; c < 3; ++c) sky.floats[(row * 4 + column) * 3 + c] = 3;
    }
    EXPECT_FALSE(write_picture(sky, options.environment));
  }
  static std::vector<int> corner(const BakedPixels& pixels) {
    return {pixels.bytes[0], pixels.bytes[1], pixels.bytes[2]};
  }

 private:
  AssetText cube_;
};

TEST_F(Backgrounds, AColorIsShownAsItIs) {
  options.background = {Kind::color, {255, 128, 3}};
  for (const double exposure : {0.0, 2.0}) {
    options.exposure = exposure;
    for (const BakeToneMap curve : {BakeToneMap::neutral, BakeToneMap::agx}) {
      options.tone_map = curve;
      const BakedPixels drawn = pixels();
      EXPECT_EQ(drawn.channels, 3U);
      EXPECT_THAT(corner(drawn), ElementsAre(255, 128, 3));
      for (std::size_t x = 0; x < drawn.width; ++x) {
        const std::size_t below = (std::size_t{31} * 32 + x) * 3;
        EXPECT_EQ(drawn.bytes[below + 1], 128) << "no shadow";
      }
    }
  }
}

TEST_F(Backgrounds, AColorShinesThroughWhereTransparencyWouldBe) {
  options.background = {Kind::transparent};
  const Numbers clear = light();
  options.background = {Kind::color, {0, 255, 0}};
  const Numbers green = light();
  ASSERT_EQ(clear.channels, 4U);
  ASSERT_EQ(green.channels, 3U);
  for (std::uint32_t y = 0; y < 32; ++y) {
    for (std::uint32_t x = 0; x < 32; ++x) {
      const double alpha = clear.at(x, y, 3);
      for (std::uint32_t c = 0; c < 3; ++c) {
        const double behind = c == 1 ? 1 - alpha : 0;
        EXPECT_NEAR(green.at(x, y, c), clear.at(x, y, c) * alpha + behind, 1e-4);
      }
    }
  }
}

TEST_F(Backgrounds, TheStudioStaysBehindAnEnvironment) {
  options.cameras = {"20,15"};
  const Numbers studio = light();
  surround(1);
  const Numbers around = light();
  EXPECT_NEAR(around.at(0, 0), 1, 1e-4);
  options.background = {Kind::studio};
  const Numbers both = light();
  EXPECT_NEAR(both.at(0, 0), studio.at(0, 0), 1e-3);
  double darkest = 1;
  for (std::uint32_t y = 0; y < 32; ++y) {
    for (std::uint32_t x = 0; x < 32; ++x) darkest = std::min(darkest, both.at(x, y));
  }
  EXPECT_LT(darkest, both.at(31, 31) * 0.9) << "darker than the corners: the shadow of the asset";
  options.environment.clear();
  options.background = {Kind::environment};
  EXPECT_GT(std::abs(light().at(0, 0) - studio.at(0, 0)), 0.02) << "the studio as it shines";
}

// A cube that is lit from one side, and turned around with its light, looks the same.
TEST_F(Backgrounds, RotationFollowsTheAzimuth) {
  options.samples = 256;
  shine_from(45);
  options.cameras = {"0,10"};
  const Numbers first = light();
  for (const double turned : {90.0, 180.0, -90.0, 450.0}) {
    options.environment_rotation = turned;
    options.cameras = {std::to_string(turned) + ",10"};
    const Numbers drawn = light();
    EXPECT_NEAR(drawn.at(0, 0), first.at(0, 0), 1e-3) << turned;
    for (std::uint32_t c = 0; c < 3; ++c) EXPECT_NEAR(drawn.mean(c), first.mean(c), 0.02) << turned;
  }
  options.cameras = {"0,10"};
  options.environment_rotation = 45;
  const Numbers between = light();
  options.environment_rotation = 90;
  const Numbers next = light();
  EXPECT_NEAR(between.at(0, 16), (first.at(0, 16) + next.at(0, 16)) / 2, 0.02)
      << "half a column is the mean of two";
}

TEST_F(Backgrounds, RotationTurnsTheStudioToo) {
  options.background = {Kind::transparent};
  const auto red = [this](std::uint32_t x) { return light().at(x, 16); };
  options.cameras = {"45,0"};  // two sides of the cube
  const double left = red(10);
  const double right = red(22);
  EXPECT_GT(left, right * 1.2) << "the key light is on the left";
  options.environment_rotation = 90;
  EXPECT_LT(red(10), red(22)) << "and now on the right";
}

TEST_F(Backgrounds, ToneCurvesAreThoseOfTheLight) {
  options.exposure = 1;
  const Numbers numbers = light();
  std::vector<std::vector<std::uint8_t>> all;
  for (const BakeToneMap curve :
       {BakeToneMap::neutral, BakeToneMap::aces, BakeToneMap::agx, BakeToneMap::none}) {
    options.tone_map = curve;
    const BakedPixels drawn = pixels();
    for (std::uint32_t i = 0; i < 32 * 32; ++i) {
      Float3 value{};
      for (std::uint32_t c = 0; c < 3; ++c) value[c] = numbers.values[i * 3 + c];
      const Float3 shown = render::tone_map(value, static_cast<render::ToneCurve>(curve));
      for (std::uint32_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(drawn.bytes[i * 3 + c], render::to_byte(render::srgb_encode(shown[c])), 1);
      }
    }
    EXPECT_THAT(all, testing::Not(testing::Contains(drawn.bytes)));
    all.push_back(drawn.bytes);
    EXPECT_EQ(light().values, numbers.values) << "OpenEXR holds the light itself";
  }
}

TEST_F(Backgrounds, ANumberThatIsNoneIsRefused) {
  AssetText asset;
  asset.draw(render::cube(), plastic());
  options.environment_rotation = std::numeric_limits<double>::infinity();
  EXPECT_EQ(report(asset).problem, BakeProblem::refused);
}

}  // namespace
}  // namespace gltfx::test

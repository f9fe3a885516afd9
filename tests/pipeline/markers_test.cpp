// SPDX-License-Identifier: Apache-2.0
// Pictures of points and lines, from a .gltf on the disk to the numbers of an OpenEXR file.
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "pipeline/baking.hpp"

namespace gltfx::test {
namespace {

using Points = std::vector<Float3>;
constexpr int kPoints = 0, kLines = 1, kLineLoop = 2;

class Markers : public Baking {
 protected:
  Markers() {
    options.cameras = {"0,0"};
    options.sizes = {{64, 64}};
    options.samples = 16;
    options.background = {BakeBackground::Kind::transparent};
    surround(1);
  }

  // A mesh of one primitive, red with a green glow.
  int add_mesh(int mode, const Points& points, const Json& more = Json::object()) {
    Json attributes{{"POSITION", asset.positions(points)}};
    attributes.update(more);
    Json material = dielectric({0.5, 0, 0, 1}, 1);
    material["emissiveFactor"] = {0, 0.25, 0};
    return asset.add(
        "meshes",
        {{"primitives",
          {{{"attributes", attributes}, {"mode", mode}, {"material", asset.material(material)}}}}});
  }
  double alpha(const Numbers& picture, std::uint32_t x, std::uint32_t y) const {
    return picture.at(x, y, 3);
  }
  static double covered(const Numbers& picture) { return picture.mean(3); }

  AssetText asset;
};

TEST_F(Markers, LinesWithoutNormalsShowBaseColorAndEmission) {
  asset.node({{"mesh", add_mesh(kLineLoop, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}})}});
  const Numbers picture = bake(asset);
  EXPECT_GT(covered(picture), 0.02);
  EXPECT_LT(covered(picture), 0.15);
  EXPECT_EQ(alpha(picture, 32, 32), 0);  // the inside of the loop
  std::uint32_t seen = 0;
  for (std::uint32_t i = 0; i < 64 * 64; ++i) {
    const double a = alpha(picture, i % 64, i / 64);
    if (a < 0.99) continue;
    ++seen;
    EXPECT_NEAR(picture.at(i % 64, i / 64, 0), 0.5, 0.01);
    EXPECT_NEAR(picture.at(i % 64, i / 64, 1), 0.25, 0.01);
    EXPECT_NEAR(picture.at(i % 64, i / 64, 2), 0, 0.01);
  }
  EXPECT_GT(seen, 20U);
}

TEST_F(Markers, APointIsAsLargeInASceneOfAnyUnit) {
  const std::vector<double> scales{1e-4, 1, 1e5};
  std::vector<double> sizes;
  for (const double scale : scales) {
    asset = AssetText();
    const int mesh = add_mesh(kPoints, {{-1, -1, 0}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}});
    asset.node({{"mesh", mesh}, {"scale", {scale, scale, scale}}});
    sizes.push_back(covered(bake(asset)));
  }
  EXPECT_GT(sizes[1], 0.0005);
  EXPECT_NEAR(sizes[0], sizes[1], 0.0005);
  EXPECT_NEAR(sizes[2], sizes[1], 0.0005);
}

TEST_F(Markers, ASinglePointFillsThePicture) {
  asset.node({{"mesh", add_mesh(kPoints, {{3, 4, 5}})}});
  EXPECT_GT(covered(bake(asset)), 0.2);
}

// A white furnace: what scatters all light shows as the light around it.
TEST_F(Markers, PointsWithNormalsAreLit) {
  const Points points{{3, 4, 5}};
  Json material = dielectric({1, 1, 1, 1}, 1, no_specular());
  const int normals = asset.accessor("VEC3", 5126, 1, packed(Points{{0, 0, 1}}));
  const int mesh = add_mesh(kPoints, points, {{"NORMAL", normals}});
  asset.json()["materials"][0] = material;
  asset.uses("KHR_materials_specular");
  asset.node({{"mesh", mesh}});
  options.samples = 64;
  const Numbers picture = bake(asset);
  double sum = 0;
  int count = 0;
  for (std::uint32_t i = 0; i < 64 * 64; ++i) {
    if (alpha(picture, i % 64, i / 64) < 0.99) continue;
    sum += picture.at(i % 64, i / 64);
    ++count;
  }
  ASSERT_GT(count, 500);
  EXPECT_NEAR(sum / count, 1, 0.01);
}

TEST_F(Markers, ManyPointsAreThinnedOut) {
  Points points;
  for (int i = 0; i < 200001; ++i) {
    points.push_back({static_cast<float>(i % 640), static_cast<float>(i / 640), 0});
  }
  asset.node({{"mesh", add_mesh(kPoints, points)}});
  options.output = (folder.path() / "picture.exr").native();
  options.samples = 1;
  const BakeReport done = report(asset);
  EXPECT_EQ(done.problem, BakeProblem::none) << done.error;
  EXPECT_THAT(done.notes, testing::Contains("Primitive 0 of mesh 0 has more than 100000 points or "
                                            "lines; some are drawn."));
}

TEST_F(Markers, LinesOfLengthZeroAreNothingToSee) {
  asset.node({{"mesh", add_mesh(kLines, {{1, 1, 1}, {1, 1, 1}})}});
  EXPECT_EQ(report(asset).problem, BakeProblem::nothing_to_see);
  asset = AssetText();
  asset.node({{"mesh", add_mesh(kLines, {{1, 1, 1}})}});
  EXPECT_EQ(report(asset).problem, BakeProblem::nothing_to_see);
}

// The scene grows, but nothing changes its thickness.
TEST_F(Markers, HaveOneSizeInAllFramesOfAClip) {
  const int mesh = add_mesh(kPoints, {{0, 0, 0}});
  asset.node({{"mesh", mesh}});
  const int moved = asset.node({{"mesh", mesh}});
  asset.orthographic(1, 3);
  const int input = asset.accessor("SCALAR", 5126, 2, floats({0, 1}), {{"min", {0}}, {"max", {1}}});
  const int output = asset.accessor("VEC3", 5126, 2, floats({0.5F, 0, 0, 0.5F, 0, -50}));
  const Json channel{{"sampler", 0}, {"target", {{"node", moved}, {"path", "translation"}}}};
  asset.add("animations", {{"channels", Json::array({channel})},
                           {"samplers", Json::array({{{"input", input}, {"output", output}}})}});
  options.cameras = {"0"};
  options.clip = "0";
  options.fps = 3;
  options.output = (folder.path() / "picture.exr").native();
  const BakeReport done = report(asset);
  ASSERT_EQ(done.written.size(), 3U) << done.error;
  const double first = covered(read_numbers(done.written[0]));
  EXPECT_GT(first, 0.01);
  EXPECT_NEAR(covered(read_numbers(done.written[1])), first, 0.1 * first);
  EXPECT_NEAR(covered(read_numbers(done.written[2])), first, 0.1 * first);
}

// Eight frames decide where the camera is; these points are in none of them.
TEST_F(Markers, AreSeenInFramesThatDecideNothing) {
  asset.draw(render::quad(0.25F), dielectric({0, 0, 0, 1}, 1));
  asset.uses("KHR_node_visibility");
  asset.uses("KHR_animation_pointer");
  Points points;
  for (int i = 0; i < 9; ++i) points.push_back({0.5F, static_cast<float>(i) / 10, 0});
  const int point = asset.node({{"mesh", add_mesh(kPoints, points)},
                                {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
  asset.orthographic(1, 3);
  const int input =
      asset.accessor("SCALAR", 5126, 4, floats({0, 0.46F, 0.52F, 1}), {{"min", {0}}, {"max", {1}}});
  const int output = asset.accessor("SCALAR", 5121, 4, std::string("\0\1\0\0", 4));
  const std::string pointer =
      "/nodes/" + std::to_string(point) + "/extensions/KHR_node_visibility/visible";
  const Json target{{"path", "pointer"},
                    {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
  asset.add("animations",
            {{"channels", Json::array({{{"sampler", 0}, {"target", target}}})},
             {"samplers",
              Json::array({{{"input", input}, {"output", output}, {"interpolation", "STEP"}}})}});
  options.cameras = {"0"};
  options.clip = "0";
  options.fps = 17;
  options.output = (folder.path() / "picture.exr").native();
  const BakeReport done = report(asset);
  ASSERT_EQ(done.written.size(), 17U) << done.error;
  const double without = covered(read_numbers(done.written[7]));
  EXPECT_GT(covered(read_numbers(done.written[8])), without + 0.0002);
  EXPECT_EQ(covered(read_numbers(done.written[9])), without);
}

}  // namespace
}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
// The size of a scene, in meters.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rules/data_asset.hpp"

namespace gltfx::test {
namespace {

// Two points, one meter apart, drawn by the nodes.
std::string points(const std::string& nodes, const std::string& more = {}) {
  DataAsset asset;
  asset.accessor("VEC3", kFloat, 2, floats({0, 0, 0, 1, 0, 0}),
                 R"(, "min": [0, 0, 0], "max": [1, 0, 0])");
  return asset.text(R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
      "nodes": [)" + nodes +
                    "]" + more);
}

std::string scaled(const std::string& by) {
  return fmt::format(R"({{"mesh": 0, "scale": [{0}, {0}, {0}]}})", by);
}

Lines about_size(const std::string& asset, Profile profile = Profile::standard) {
  return selected(asset, {"UNUSUAL_SCALE"}, profile);
}

const std::string kScene = R"(, "scene": 0, "scenes": [{"nodes": [0]}])";

TEST(UnusualScale, IsBelowATenthOfAMillimetreAndBeyondPlanets) {
  EXPECT_EQ(about_size(points(scaled("1"), kScene)), Lines());
  EXPECT_EQ(about_size(points(scaled("1.1e-4"), kScene)), Lines());
  EXPECT_EQ(about_size(points(scaled("9e-5"), kScene)), Lines{"UNUSUAL_SCALE /scenes/0"});
  EXPECT_EQ(about_size(points(scaled("0.9e8"), kScene)), Lines());
  EXPECT_EQ(about_size(points(scaled("1.1e8"), kScene)), Lines{"UNUSUAL_SCALE /scenes/0"});
}

TEST(UnusualScale, IsOfTheWholeSceneNotOfItsParts) {
  const std::string small_beside_large = scaled("1e-6") + ", " + scaled("1");
  const std::string both = R"(, "scenes": [{"nodes": [0, 1]}])";
  EXPECT_EQ(about_size(points(small_beside_large, both)), Lines());
  const std::string far = R"({"mesh": 0, "translation": [1e9, 0, 0]}, {"mesh": 0})";
  EXPECT_EQ(about_size(points(far, both)), Lines{"UNUSUAL_SCALE /scenes/0"});
  EXPECT_EQ(about_size(points(far, kScene)), Lines()) << "far away, but of a usual size";
}

TEST(UnusualScale, IsOfTheDefaultScene) {
  const std::string nodes = scaled("1") + ", " + scaled("1e12");
  const std::string scenes = R"(, "scenes": [{"nodes": [0]}, {"nodes": [1]}])";
  EXPECT_EQ(about_size(points(nodes, scenes)), Lines());
  EXPECT_EQ(about_size(points(nodes, scenes + R"(, "scene": 1)")),
            Lines{"UNUSUAL_SCALE /scenes/1"});
  EXPECT_EQ(about_size(points(nodes)), Lines{"UNUSUAL_SCALE "}) << "no scene: all nodes";
}

TEST(UnusualScale, FollowsJointsAndInstances) {
  DataAsset asset;
  asset.accessor("VEC3", kFloat, 1, floats({0, 0, 0}), R"(, "min": [0, 0, 0], "max": [1, 0, 0])");
  asset.accessor("VEC3", kFloat, 2, floats({0, 0, 0, 1e12F, 0, 0}));
  const std::string mesh = R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}])";
  EXPECT_EQ(about_size(asset.text(mesh + R"(, "nodes": [{"mesh": 0, "skin": 0}, {"scale":
                [1e12, 1, 1]}], "skins": [{"joints": [1]}])" +
                                  kScene)),
            Lines{"UNUSUAL_SCALE /scenes/0"});
  EXPECT_EQ(about_size(asset.text(mesh + R"(, "nodes": [{"mesh": 0, "extensions":
                {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}}])" +
                                  kScene)),
            Lines{"UNUSUAL_SCALE /scenes/0"});
}

TEST(UnusualScale, IsSilentWithoutASize) {
  EXPECT_EQ(about_size(points(scaled("0"), kScene)), Lines()) << "one point";
  EXPECT_EQ(about_size(R"({"asset": {"version": "2.0"}})"), Lines());
}

TEST(UnusualScale, IsSilentWhereTheSceneHasTooManyParts) {
  const auto with_nodes = [](std::size_t count) {
    std::string nodes = scaled("1e12");
    for (std::size_t i = 1; i < count; ++i) nodes += ",{}";
    return about_size(points(nodes, kScene));
  };
  EXPECT_EQ(with_nodes(65535), Lines{"UNUSUAL_SCALE /scenes/0"}) << "and one mesh";
  EXPECT_EQ(with_nodes(65536), Lines());
}

TEST(UnusualScale, IsNoRuleOfTheKhronosValidator) {
  EXPECT_EQ(about_size(points(scaled("1e12"), kScene), Profile::khronos), Lines());
}

TEST(UnusualScale, NamesTheNodeThatReachesFarthest) {
  const std::string nodes = R"({"mesh": 0}, {"name": "sun", "mesh": 0, "translation": [0, -15e10,
      0]})";
  const FileReport report =
      validate_bytes(points(nodes, R"(, "scene": 0, "scenes": [{"nodes": [0, 1]}])"), "test", {});
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].message,
            "The scene is 1.5e+08 km wide because of node 1 ('sun'); 0.1 mm to 100,000 km is "
            "expected.");
}

}  // namespace
}  // namespace gltfx::test

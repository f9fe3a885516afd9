// SPDX-License-Identifier: Apache-2.0
// External assets of glTF 2.1 in comparisons: what differs in them is told at one place.
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program/git_support.hpp"

namespace gltfx::program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string parent_with(const std::string& first, const std::string& second = {}) {
  const auto file = [](const std::string& uri) {
    return R"({"uri":")" + uri + R"(","mimeType":"model/gltf+json"})";
  };
  const bool both = !second.empty();
  return R"({"asset":{"version":"2.1"},"files":[)" + file(first) +
         (both ? "," + file(second) : std::string()) + R"(],"externalAssets":[{"file":0})" +
         (both ? R"(,{"file":1})" : "") + R"(],"nodes":[{"externalAsset":0}]})";
}

std::string child_with(const std::string& roughness) {
  return R"({"asset":{"version":"2.1"},"materials":[{"name":"Oak","pbrMetallicRoughness":)"
         R"({"roughnessFactor":)" +
         roughness + "}}]}";
}

class CompareExternal : public GitRepository {
 protected:
  void write_all(const std::string& folder) {
    folder_.write(folder + "hall.gltf", parent_with("parts/room.gltf", "parts/table.gltf"));
    folder_.write(folder + "parts/room.gltf", parent_with("chair.gltf"));
    folder_.write(folder + "parts/chair.gltf", child_with("0.5"));
    folder_.write(folder + "parts/table.gltf", child_with("0.25"));
  }
  nlohmann::json compared(const std::string& words) const {
    return nlohmann::json::parse(shell("gltfx compare --format json " + words).out);
  }
};

TEST_F(CompareExternal, ADifferenceBelowIsOneChange) {
  write_all("old/");
  write_all("new/");
  const std::string both = "old/hall.gltf new/hall.gltf";
  EXPECT_EQ(compared(both)["pairs"][0]["level"], "identical");
  folder_.write("new/parts/chair.gltf", child_with("0.75"));
  const nlohmann::json report = compared(both);
  const nlohmann::json& changes = report["pairs"][0]["changes"];
  ASSERT_EQ(changes.size(), 1U) << report.dump(1);
  EXPECT_EQ(changes[0]["kind"], "external.asset");
  EXPECT_EQ(changes[0]["level"], "differs");
  EXPECT_EQ(changes[0]["new"], "/externalAssets/0");
  EXPECT_THAT(changes[0]["what"].get<std::string>(),
              AllOf(HasSubstr("parts/chair.gltf: 'Oak' roughnessFactor 0.5 -> 0.75, at "),
                    HasSubstr("/materials/0/pbrMetallicRoughness/roughnessFactor")));
  EXPECT_EQ(shell("gltfx compare " + both).code, 1);
  EXPECT_EQ(shell("gltfx compare --ignore external.asset " + both).code, 0);
  folder_.write("new/parts/table.gltf", child_with("1"));
  EXPECT_EQ(compared(both)["pairs"][0]["changes"].size(), 2U);
}

TEST_F(CompareExternal, WhatIsStoredDifferentlyBelowIsStorage) {
  write_all("old/");
  write_all("new/");
  folder_.write("new/parts/chair.gltf", child_with("5e-1"));
  const nlohmann::json report = compared("old/hall.gltf new/hall.gltf");
  EXPECT_EQ(report["pairs"][0]["level"], "storage");
  EXPECT_EQ(report["pairs"][0]["storage"][0],
            "external asset parts/chair.gltf is stored differently");
}

TEST_F(CompareExternal, AMissingFileIsAChange) {
  write_all("old/");
  write_all("new/");
  std::filesystem::remove(folder_.path() / "new/parts/chair.gltf");
  const nlohmann::json report = compared("old/hall.gltf new/hall.gltf");
  ASSERT_EQ(report["pairs"][0]["changes"].size(), 1U) << report.dump(1);
  EXPECT_EQ(report["pairs"][0]["changes"][0]["what"],
            "external asset 0 of parts/room.gltf can no longer be read");
}

TEST_F(CompareExternal, GitNamesTheAssetsAbove) {
  write_all("");
  folder_.write("other.gltf", node_at(1, "other"));
  commit();
  folder_.write("parts/chair.gltf", child_with("0.75"));
  const Outcome text = shell("gltfx compare --git HEAD");
  EXPECT_EQ(text.code, 1);
  EXPECT_THAT(text.out, AllOf(HasSubstr("parts/chair.gltf: differs: 1 material.value\n"
                                        "  external asset of parts/room.gltf\n"),
                              Not(HasSubstr("hall.gltf")), Not(HasSubstr("other.gltf"))));
  const nlohmann::json report = compared("--git HEAD");
  ASSERT_EQ(report["pairs"].size(), 1U);
  EXPECT_EQ(report["pairs"][0]["externalAssetOf"], nlohmann::json::array({"parts/room.gltf"}));
}

TEST_F(CompareExternal, GitComparesAnAssetThatIsAskedForAlone) {
  write_all("");
  commit();
  folder_.write("parts/chair.gltf", child_with("0.75"));
  const nlohmann::json report = compared("--git HEAD hall.gltf");
  ASSERT_EQ(report["pairs"].size(), 1U);
  EXPECT_EQ(report["pairs"][0]["new"], "hall.gltf");
  EXPECT_EQ(report["pairs"][0]["changes"][0]["kind"], "external.asset");
}

TEST_F(CompareExternal, TwoCommitsHaveTheirOwnExternalAssets) {
  write_all("");
  commit();
  folder_.write("parts/chair.gltf", child_with("0.75"));
  commit();
  folder_.write("parts/chair.gltf", child_with("0.9"));
  const nlohmann::json report = compared("--git HEAD~1..HEAD hall.gltf");
  ASSERT_EQ(report["pairs"].size(), 1U);
  EXPECT_THAT(report["pairs"][0]["changes"][0]["what"].get<std::string>(),
              HasSubstr("0.5 -> 0.75"));
}

}  // namespace
}  // namespace gltfx::program

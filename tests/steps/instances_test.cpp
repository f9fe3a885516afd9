// SPDX-License-Identifier: Apache-2.0
// Instances become nodes for engines that do not read them.
#include <gmock/gmock.h>

#include "targets_support.hpp"

namespace gltfx::test {
namespace {

using testing::HasSubstr;

constexpr const char* kInstances = "EXT_mesh_gpu_instancing";

class Instances : public TargetConversion {
 protected:
  Instances() {
    OrderedJson primitive;
    primitive["attributes"]["POSITION"] =
        asset_.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", true);
    asset_.mesh(primitive);
    asset_.json["nodes"][0]["extensions"][kInstances]["attributes"] = {
        {"TRANSLATION", asset_.accessor<float>({1, 2, 3, 4.5F, 0.1F, 6}, "VEC3")},
        {"ROTATION", asset_.accessor<std::int16_t>({0, 0, 0, 32767, 0, 23000, 0, 23000}, "VEC4")}};
    asset_.json["accessors"][2]["normalized"] = true;
    asset_.json["nodes"].push_back({{"name", "leaf"}});
    asset_.json["nodes"][0]["children"] = {1};
    asset_.json["extensionsUsed"] = asset_.json["extensionsRequired"] = {kInstances};
  }
  OrderedJson sparse_of_one() {
    const std::size_t indices = asset_.view(packed<std::uint16_t>({1}));
    const std::size_t values = asset_.view(packed<float>({5, 0, 0}));
    return {{"count", 1},
            {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
            {"values", {{"bufferView", values}}}};
  }
  OrderedJson& node() { return asset_.json["nodes"][0]; }
  void expect_refused(const std::string& reason) {
    const ConvertReport report = convert(asset_.glb(), refuser({kInstances}));
    EXPECT_FALSE(report.written);
    EXPECT_THAT(report.error, HasSubstr("/nodes/0: " + reason));
  }

  MadeAsset asset_;
};

TEST_F(Instances, BecomeNodes) {
  const OrderedJson json = converted(asset_, {kInstances}).json();
  ASSERT_EQ(json["nodes"].size(), 4U);
  EXPECT_EQ(json["nodes"][0], OrderedJson::parse(R"({"children": [1, 2, 3]})"));
  EXPECT_EQ(
      json["nodes"][2],
      OrderedJson::parse(R"({"mesh": 0, "translation": [1, 2, 3], "rotation": [0, 0, 0, 1]})"));
  EXPECT_FLOAT_EQ(json["nodes"][3]["translation"][1].get<float>(), 0.1F);
  EXPECT_FLOAT_EQ(json["nodes"][3]["rotation"][1].get<float>(), std::sqrt(0.5F));
  EXPECT_FALSE(json.contains("extensionsUsed"));
}

TEST_F(Instances, DrawTheSamePicture) {
  options_.verify = true;
  const ConvertReport report = convert(asset_.glb(), refuser({kInstances}));
  EXPECT_TRUE(report.written) << report.error;
  EXPECT_TRUE(report.verified || !report.not_verified.empty());
}

TEST_F(Instances, OtherStepsAreStillProven) {
  options_.shrink = true;
  const ConvertReport report = convert(asset_.glb(), refuser({kInstances}));
  EXPECT_TRUE(report.written) << report.error;
}

TEST_F(Instances, StayWithAttributesThatNodesDoNotHave) {
  node()["extensions"][kInstances]["attributes"]["_COLOR"] = 1;
  expect_refused("'_COLOR' of its instances would be lost");
}

TEST_F(Instances, StayWithASkinOrAnimatedWeights) {
  node()["skin"] = 0;
  asset_.json["skins"] = {{{"joints", {1}}}};
  expect_refused("it has a skin");
}

TEST_F(Instances, StayIfNoBytesLimitTheirNumber) {
  asset_.json["accessors"].push_back(
      {{"componentType", 5126}, {"count", 2}, {"type", "VEC3"}, {"sparse", sparse_of_one()}});
  node()["extensions"][kInstances]["attributes"] = {{"TRANSLATION", 3}};
  expect_refused("its instances are not stored");
}

}  // namespace
}  // namespace gltfx::test

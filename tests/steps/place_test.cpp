// SPDX-License-Identifier: Apache-2.0
// Sizes and places of assets change, and nothing else.
#include <cmath>

#include <gmock/gmock.h>

#include "made_asset.hpp"

namespace gltfx {
namespace {

using test::MadeAsset;
using test::numbers_of;
using test::OrderedJson;
using test::StoredAsset;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pointwise;

ConvertOptions scaled(double factor) {
  ConvertOptions options;
  options.placement.scale = factor;
  return options;
}
ConvertOptions centered(Pivot pivot) {
  ConvertOptions options;
  options.placement.center = pivot;
  return options;
}
ConvertOptions rebased() {
  ConvertOptions options;
  options.placement.rebase = true;
  return options;
}

/// A mesh with a triangle.
std::size_t add_triangle(MadeAsset& made, const std::vector<float>& positions) {
  const std::size_t accessor = made.accessor(positions, "VEC3", true);
  made.json["meshes"].push_back({{"primitives", {{{"attributes", {{"POSITION", accessor}}}}}}});
  return made.json["meshes"].size() - 1;
}

const std::vector<float> kSlopedTriangle{1, 2, 3, 3, 2, 3, 3, 6, 5};

/// Moves a node.
void animate(MadeAsset& made, std::size_t node, const std::string& path,
             const std::vector<float>& values, const std::string& interpolation = "LINEAR") {
  const std::size_t input = made.accessor(std::vector<float>{0, 1}, "SCALAR", true);
  const std::size_t output = made.accessor(values, "VEC3");
  made.json["animations"].push_back(
      {{"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}}});
}

class Scale : public test::ConvertMade {
 protected:
  Scale() : ConvertMade(scaled(0.01)) {
    made_.json["scenes"] = {{{"nodes", {0, 2}}}};
    made_.json["nodes"] = {
        {{"children", {1}}, {"translation", {370, 0, 5}}},
        {{"mesh", 0}, {"translation", {1, 2, 3}}},
        {{"matrix", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 10, 20, 30, 1}}, {"mesh", 0}}};
    add_triangle(made_, kSlopedTriangle);
  }
  StoredAsset result() {
    const ConvertReport report = run(made_.glb());
    EXPECT_TRUE(report.written) << report.error;
    return StoredAsset::at(output());
  }
  MadeAsset made_;
};

TEST_F(Scale, MultipliesTheTransformsOfRootsOnly) {
  const OrderedJson nodes = result().json()["nodes"];
  EXPECT_EQ(nodes[0].dump(),
            R"({"children":[1],"translation":[3.7,0,0.05],"scale":[0.01,0.01,0.01]})");
  EXPECT_EQ(nodes[1], made_.json["nodes"][1]);
  EXPECT_EQ(nodes[2]["matrix"].dump(), "[0.02,0,0,0,0,0.02,0,0,0,0,0.02,0,0.1,0.2,0.3,1]");
}

TEST_F(Scale, MultipliesLengthsThatTransformsDoNotReach) {
  made_.json["nodes"][0]["camera"] = 0;
  made_.json["nodes"].push_back({{"camera", 1}, {"translation", {100, 0, 0}}});
  made_.json["scenes"][0]["nodes"].push_back(3);
  made_.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 5}, {"zfar", 900}}}},
      {{"type", "orthographic"},
       {"orthographic", {{"xmag", 20}, {"ymag", 10}, {"znear", 0}, {"zfar", 50}}}}};
  made_.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_volume"};
  made_.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"range", 300}, {"intensity", 20000}},
      {{"type", "spot"}, {"spot", OrderedJson::object()}},
      {{"type", "directional"}, {"intensity", 7}}};
  made_.json["materials"] = {
      {{"extensions",
        {{"KHR_materials_volume", {{"thicknessFactor", 3}, {"attenuationDistance", 40}}}}}}};
  const OrderedJson json = result().json();
  EXPECT_EQ(json["cameras"][0]["perspective"].dump(), R"({"yfov":1,"znear":0.05,"zfar":9})");
  EXPECT_EQ(json["cameras"][1]["orthographic"].dump(),
            R"({"xmag":0.2,"ymag":0.1,"znear":0,"zfar":0.5})");
  const OrderedJson& lights = json["extensions"]["KHR_lights_punctual"]["lights"];
  EXPECT_EQ(lights[0].dump(), R"({"type":"point","range":3,"intensity":2})");
  EXPECT_EQ(lights[1].dump(), R"({"type":"spot","spot":{},"intensity":0.0001})");
  EXPECT_EQ(lights[2], made_.json["extensions"]["KHR_lights_punctual"]["lights"][2]);
  EXPECT_EQ(json["materials"][0]["extensions"]["KHR_materials_volume"].dump(),
            R"({"thicknessFactor":3,"attenuationDistance":0.4})")
      << "thickness is in the space of the mesh";
  EXPECT_EQ(json["nodes"][3].dump(), R"({"camera":1,"translation":[1,0,0]})")
      << "cameras have no scale";
}

TEST_F(Scale, MultipliesKeyframesOfRoots) {
  animate(made_, 0, "translation", {100, 0, 0, 0, 200, 0});
  animate(made_, 0, "scale", {1, 1, 1, 2, 2, 2});
  animate(made_, 1, "translation", {100, 0, 0, 0, 200, 0});
  const StoredAsset result = this->result();
  const auto values = [&](std::size_t animation) {
    return numbers_of(result, result.json()["animations"][animation]["samplers"][0]["output"]);
  };
  EXPECT_THAT(values(0), Pointwise(DoubleNear(1e-7), {1, 0, 0, 0, 2, 0}));
  EXPECT_THAT(values(1), Pointwise(DoubleNear(1e-7), {0.01, 0.01, 0.01, 0.02, 0.02, 0.02}));
  EXPECT_THAT(values(2), ElementsAre(100, 0, 0, 0, 200, 0));
}

TEST_F(Scale, CopiesKeyframesThatOtherNodesUse) {
  animate(made_, 0, "translation", {100, 0, 0, 0, 200, 0});
  animate(made_, 1, "translation", {1, 1, 1, 2, 2, 2});
  OrderedJson& animations = made_.json["animations"];
  animations[1]["samplers"][0]["output"] = animations[0]["samplers"][0]["output"];
  const StoredAsset result = this->result();
  const OrderedJson json = result.json();
  EXPECT_EQ(json["accessors"].size(), made_.json["accessors"].size() + 1);
  EXPECT_THAT(numbers_of(result, json["animations"][0]["samplers"][0]["output"]),
              Pointwise(DoubleNear(1e-7), {1, 0, 0, 0, 2, 0}));
  EXPECT_THAT(numbers_of(result, json["animations"][1]["samplers"][0]["output"]),
              ElementsAre(100, 0, 0, 0, 200, 0));
}

TEST_F(Scale, IsRefusedWherePhysicsHasLengths) {
  made_.json["extensionsUsed"] = {"OMI_physics_shape"};
  made_.json["extensions"]["OMI_physics_shape"]["shapes"] = {
      {{"type", "sphere"}, {"sphere", {{"radius", 2}}}}};
  expect_refused(
      made_, "/extensions/OMI_physics_shape/shapes/0/sphere",
      "OMI_physics_shape.sphere has lengths, forces or speeds, which do not scale safely");
}

TEST_F(Scale, IsRefusedWhereAnUnknownExtensionHasNumbers) {
  made_.json["extensionsUsed"] = {"ACME_wheel"};
  made_.json["nodes"][1]["extensions"]["ACME_wheel"]["radius"] = 2.5;
  expect_refused(made_, "/nodes/1/extensions/ACME_wheel",
                 "may hold lengths (describe it with --schema)");
}

TEST_F(Scale, IsRefusedWherePointersChangeLengths) {
  made_.json["extensionsUsed"] = {"KHR_animation_pointer"};
  animate(made_, 0, "pointer", {1, 1, 1, 2, 2, 2});
  made_.json["animations"][0]["channels"][0]["target"] = {
      {"path", "pointer"},
      {"extensions", {{"KHR_animation_pointer", {{"pointer", "/nodes/0/scale"}}}}}};
  expect_refused(made_, "/animations/0/channels/0/target/extensions/KHR_animation_pointer/pointer",
                 "may change a transform when the asset runs");
}

class CenterBottom : public test::ConvertMade {
 protected:
  CenterBottom() : ConvertMade(centered(Pivot::bottom)) {
    made_.json["scenes"] = {{{"nodes", {0}}}};
    made_.json["nodes"] = {{{"mesh", 0}, {"scale", {2, 2, 2}}}};
    add_triangle(made_, kSlopedTriangle);
  }
  MadeAsset made_;
};

TEST_F(CenterBottom, MovesRootsOnce) {
  const StoredAsset result = converted_twice(made_.glb());
  EXPECT_EQ(result.json()["nodes"][0].dump(),
            R"({"mesh":0,"scale":[2,2,2],"translation":[-4,-4,-8]})");
  EXPECT_EQ(row_.what, "moved by -4, -4, -8");
  EXPECT_THAT(row_.losses, IsEmpty());
}

TEST_F(CenterBottom, MovesKeyframesButNotTheirTangents) {
  animate(made_, 0, "translation", {9, 9, 9, 1, 1, 1, 9, 9, 9, 9, 9, 9, 2, 2, 2, 9, 9, 9},
          "CUBICSPLINE");
  const StoredAsset result = converted_twice(made_.glb());
  EXPECT_THAT(numbers_of(result, result.json()["animations"][0]["samplers"][0]["output"]),
              ElementsAre(9, 9, 9, -3, -3, -7, 9, 9, 9, 9, 9, 9, -2, -2, -6, 9, 9, 9));
}

TEST_F(CenterBottom, UsesOnlyDrawnVertices) {
  const std::size_t indices = made_.accessor(std::vector<std::uint16_t>{0, 1, 1}, "SCALAR");
  made_.json["meshes"][0]["primitives"][0]["indices"] = indices;
  made_.json["meshes"][0]["primitives"][0]["mode"] = 1;
  made_.json["accessors"][indices]["count"] = 2;
  const StoredAsset result = converted_twice(made_.glb());
  EXPECT_EQ(result.json()["nodes"][0]["translation"].dump(), "[-4,-4,-6]");
}

TEST_F(CenterBottom, ReadsVerticesOfManyPrimitivesOnce) {
  std::vector<float> positions;
  for (int i = 0; i < 12000; ++i) {
    for (const int k : {0, 1, 2}) positions.push_back(static_cast<float>(i % (k + 2)));
  }
  const std::size_t shared = made_.accessor(positions, "VEC3", true);
  const std::size_t indices = made_.accessor(std::vector<std::uint16_t>{0, 1, 5}, "SCALAR");
  made_.json["meshes"][0]["primitives"] = OrderedJson::array();
  for (int i = 0; i < 2000; ++i) {
    made_.json["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", shared}}}, {"indices", indices}});
  }
  EXPECT_TRUE(row_of(made_.glb()).changes);
}

TEST_F(CenterBottom, LeavesScenesThatDrawNothing) {
  made_.json["nodes"][0].erase("mesh");
  expect_left(made_, "the default scene draws nothing");
}

TEST_F(CenterBottom, IsRefusedForMeshesThatFollowJointsOutsideOfTheScene) {
  const std::size_t joints =
      made_.accessor(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");
  const std::size_t weights =
      made_.accessor(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  OrderedJson& attributes = made_.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = joints;
  attributes["WEIGHTS_0"] = weights;
  made_.json["nodes"][0]["skin"] = 0;
  made_.json["nodes"].push_back(OrderedJson::object());
  made_.json["skins"] = {{{"joints", {1}}}};
  expect_refused(made_, "/nodes/0", "has joints outside of the scene");
}

class CenterOrigin : public test::ConvertMade {
 protected:
  CenterOrigin() : ConvertMade(centered(Pivot::origin)) {}
};

TEST_F(CenterOrigin, MovesTheBoxOfAllInstances) {
  MadeAsset made;
  add_triangle(made, kSlopedTriangle);
  const std::size_t places = made.accessor(std::vector<float>{0, 0, 0, 10, 0, 0}, "VEC3");
  made.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  made.json["scenes"] = {{{"nodes", {0}}}};
  made.json["nodes"] = {
      {{"mesh", 0},
       {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", places}}}}}}}}};
  const StoredAsset result = converted_twice(made.glb());
  EXPECT_EQ(result.json()["nodes"][0]["translation"].dump(), "[-7,-4,-4]");
}

class Rebase : public test::ConvertMade {
 protected:
  Rebase() : ConvertMade(rebased()) {
    for (const float x : {500000.0F, 500010.0F})
      add_triangle(made_, {x, 5400000, 300, x + 10, 5400000, 300, x, 5400010, 305.5F});
    made_.json["scenes"] = {{{"nodes", {0}}}};
    made_.json["nodes"] = {{{"children", {1, 2}}}, {{"mesh", 0}}, {{"mesh", 1}}};
  }
  MadeAsset made_;
};

TEST_F(Rebase, MovesOneOffsetIntoTheRoot) {
  const StoredAsset result = converted_twice(made_.glb());
  EXPECT_EQ(result.json()["nodes"].dump(),
            R"([{"children":[1,2],"translation":[500010,5400005,0]},{"mesh":0},{"mesh":1}])");
  EXPECT_THAT(numbers_of(result, 0), ElementsAre(-10, -5, 300, 0, -5, 300, -10, 5, 305.5));
  EXPECT_THAT(numbers_of(result, 1), ElementsAre(0, -5, 300, 10, -5, 300, 0, 5, 305.5));
  EXPECT_EQ(result.json()["accessors"][0]["min"].dump(), "[-10,-5,300]");
  EXPECT_THAT(row_.losses, IsEmpty());
}

TEST_F(Rebase, FollowsRotationsInDoublePrecision) {
  const double half = std::sqrt(0.5);
  made_.json["nodes"][0]["rotation"] = {-half, 0, 0, half};
  const StoredAsset result = converted_twice(made_.glb());
  const auto place = result.json()["nodes"][0]["translation"].get<std::vector<double>>();
  EXPECT_THAT(place, Pointwise(DoubleNear(1e-8), {500010, 0, -5400005}));
}

TEST_F(Rebase, KeepsNodesInTheirPlaces) {
  made_.json["nodes"][1]["children"] = {3};
  made_.json["nodes"][1]["scale"] = {2, 2, 2};
  made_.json["nodes"].push_back({{"name", "label"}, {"translation", {500001, 5400002, 3}}});
  const OrderedJson nodes = converted_twice(made_.glb()).json()["nodes"];
  const auto place = [&](std::size_t node) {
    return nodes[node].value("translation", std::vector<double>(3, 0));
  };
  const std::vector<double> label{500001, 5400002, 3};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(place(0)[i] + place(1)[i] + 2 * place(3)[i], 2 * label[i]);
  }
}

TEST_F(Rebase, LeavesAnimatedMeshes) {
  animate(made_, 1, "translation", {0, 0, 0, 1, 0, 0});
  const ConvertReport report = run(made_.glb());
  ASSERT_TRUE(report.written) << report.error;
  ASSERT_EQ(report.steps[0].left.size(), 1U);
  EXPECT_EQ(report.steps[0].left[0].reason, "/nodes/1 is an animated node");
  const StoredAsset result = StoredAsset::at(output());
  EXPECT_THAT(numbers_of(result, 0),
              ElementsAre(500000, 5400000, 300, 500010, 5400000, 300, 500000, 5400010, 305.5));
  EXPECT_EQ(result.json()["nodes"][2]["translation"].dump(), "[500015,5400005,0]");
}

TEST_F(Rebase, LeavesAssetsNearTheOrigin) {
  MadeAsset made;
  add_triangle(made, kSlopedTriangle);
  made.json["nodes"] = {{{"mesh", 0}, {"translation", {5000000, 0, 0}}}};
  const ConvertStep row = row_of(made.glb());
  EXPECT_FALSE(row.changes);
  EXPECT_THAT(row.left, IsEmpty());
}

}  // namespace
}  // namespace gltfx

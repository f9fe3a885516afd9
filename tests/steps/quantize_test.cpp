// SPDX-License-Identifier: Apache-2.0
// Vertices become integers within bounds. tests/quantize measures the loss of whole assets.
#include <cmath>

#include <gmock/gmock.h>

#include "made_asset.hpp"
#include "steps/quantize_values.hpp"

namespace gltfx {
namespace {

using steps::FloatElements;
using test::MadeAsset;
using test::numbers_of;
using test::OrderedJson;
using test::StoredAsset;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

ConvertOptions quantize_options() {
  ConvertOptions options;
  options.quantize.emplace();
  return options;
}

// 64 vertices, so that the file becomes smaller.
std::vector<float> corners_of_cube(float size) {
  std::vector<float> corners;
  for (unsigned i = 0; i < 64; ++i) {
    for (unsigned k = 0; k < 3; ++k) corners.push_back((i >> k & 1U) != 0 ? size : 0.1F * size);
  }
  return corners;
}

class Quantize : public test::ConvertMade {
 protected:
  Quantize() : ConvertMade(quantize_options()) {}

  static std::size_t add_cube(MadeAsset& made, float size = 1) {
    const std::size_t at = made.accessor(corners_of_cube(size), "VEC3", true);
    const std::size_t indices = made.accessor<std::uint16_t>(
        {0, 1, 2, 1, 2, 3, 4, 5, 6, 5, 6, 7, 0, 1, 4, 2, 3, 7}, "SCALAR");
    made.mesh({{"attributes", {{"POSITION", at}}}, {"indices", indices}});
    made.json["scenes"] = {{{"nodes", OrderedJson::array()}}};
    for (std::size_t i = 0; i < made.json["nodes"].size(); ++i)
      made.json["scenes"][0]["nodes"].push_back(i);
    made.json["scene"] = 0;
    return at;
  }
};

TEST_F(Quantize, MovesTheScaleIntoALeaf) {
  MadeAsset made;
  const std::size_t at = add_cube(made);
  made.json["nodes"][0]["scale"] = {2, 2, 2};
  const StoredAsset now = converted_twice(made.glb());
  const OrderedJson json = now.json();
  EXPECT_EQ(json["accessors"][at]["componentType"], 5123);
  EXPECT_THAT(json["nodes"], SizeIs(1));
  const double step = json["nodes"][0]["scale"][0].get<double>() / 2;
  EXPECT_EQ(std::log2(step), std::round(std::log2(step)));
  const double origin = json["nodes"][0]["translation"][0];
  const auto positions = numbers_of(now, at);
  EXPECT_NEAR(origin + 2 * step * positions[0], 0.2, 4e-4);
  EXPECT_THAT(json["extensionsRequired"], ElementsAre("KHR_mesh_quantization"));
  ASSERT_THAT(row_.losses, SizeIs(1));
  EXPECT_EQ(row_.losses[0].quantity, "positions");
  EXPECT_LE(row_.losses[0].measured, row_.losses[0].bound);
  EXPECT_GT(row_.losses[0].measured, 0);
}

TEST_F(Quantize, AddsAChildToAParent) {
  MadeAsset made;
  add_cube(made);
  made.json["nodes"][0]["name"] = "parent";
  made.json["nodes"][0]["children"] = {1};
  made.json["nodes"].push_back({{"name", "child"}});
  const OrderedJson json = converted_twice(made.glb()).json();
  EXPECT_EQ(json["nodes"][0].dump(), R"({"name":"parent","children":[1,2]})");
  EXPECT_EQ(json["nodes"][2]["mesh"], 0);
  EXPECT_FALSE(json["nodes"][2].contains("name"));
  EXPECT_THAT(row_.what, HasSubstr("; 1 new node"));
}

TEST_F(Quantize, LeavesAMeshWhoseWeightsMoveAtAParent) {
  MadeAsset made;
  const std::size_t at = add_cube(made);
  made.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", at}}};
  made.json["nodes"][0]["children"] = {1};
  made.json["nodes"].push_back({{"name", "child"}});
  const std::size_t times = made.accessor<float>({0, 1}, "SCALAR", true);
  const std::size_t weights = made.accessor<float>({0, 1}, "SCALAR");
  made.json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", weights}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
  expect_left(made, "needs a node of its own, but an animation changes its weights");
}

TEST_F(Quantize, RefusesWhatAnUnknownExtensionMayReferTo) {
  MadeAsset made;
  const std::size_t at = add_cube(made);
  made.json["extensionsUsed"] = {"ACME_ref"};
  made.json["nodes"][0]["extensions"]["ACME_ref"]["curve"] = at;
  expect_refused(made, "/meshes/0",
                 "/nodes/0/extensions/ACME_ref may hold its index (describe it with --schema)");
}

TEST_F(Quantize, LeavesAMeshThatNoNodeDraws) {
  MadeAsset made;
  add_cube(made);
  made.json["nodes"][0].erase("mesh");
  expect_left(made, "no node draws it");
}

TEST_F(Quantize, LeavesWeightsThatAreSeveralSets) {
  MadeAsset made;
  const std::vector<float> positions(300, 1.5F);
  const std::size_t weights = made.accessor(std::vector<float>(400, 0.125F), "VEC4");
  const std::size_t joints = made.accessor(std::vector<std::uint8_t>(400, 0), "VEC4");
  made.mesh({{"attributes",
              {{"POSITION", made.accessor(positions, "VEC3", true)},
               {"JOINTS_0", joints},
               {"JOINTS_1", joints},
               {"WEIGHTS_0", weights},
               {"WEIGHTS_1", weights}}}});
  options_.quantize->position.reset();
  expect_left(made, "has the weights of several sets");
}

// Some readers take count times stride bytes.
TEST_F(Quantize, KeepsWholeStridesOfOtherAttributes) {
  MadeAsset made;
  std::vector<float> interleaved;
  for (int i = 0; i < 100; ++i)
    interleaved.insert(interleaved.end(), {static_cast<float>(i), 0.1F * static_cast<float>(i),
                                           0.3F, static_cast<float>(i % 7)});
  const std::size_t custom = made.accessor(interleaved, "VEC4");
  made.json["bufferViews"][0]["byteStride"] = 16;
  made.json["accessors"][custom]["type"] = "SCALAR";
  OrderedJson positions = made.json["accessors"][custom];
  positions["type"] = "VEC3";
  positions["byteOffset"] = 4;
  positions["min"] = {0, 0.3F, 0};
  positions["max"] = {9.9F, 0.3F, 6};
  made.json["accessors"].push_back(positions);
  made.mesh({{"mode", 0}, {"attributes", {{"POSITION", custom + 1}, {"_CUSTOM", custom}}}});
  const OrderedJson json = converted_twice(made.glb()).json();
  EXPECT_EQ(json["accessors"][custom + 1]["componentType"], 5123);
  const OrderedJson& accessor = json["accessors"][custom];
  const OrderedJson& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  EXPECT_GE(view["byteLength"].get<int>(),
            accessor.value("byteOffset", 0) + 100 * view["byteStride"].get<int>());
}

TEST_F(Quantize, LeavesWhatWouldNotBeSmaller) {
  MadeAsset made;
  const std::vector<float> triangle{0, 0, 0, 1, 0, 0, 0, 1, 0};
  made.mesh({{"attributes", {{"POSITION", made.accessor(triangle, "VEC3", true)}}}});
  expect_left(made, "integers and the JSON for them would not be smaller");
}

TEST_F(Quantize, KeepsExactWhatIsOff) {
  options_.quantize->position.reset();
  MadeAsset made;
  add_cube(made);
  EXPECT_FALSE(row_of(made.glb()).changes);
}

TEST(QuantizeValues, RoundsWeightsByTheLargestRemainder) {
  const FloatElements weights{{1.0F / 3, 1.0F / 3, 1.0F / 3, 0, 0, 0, 0, 0}, 4};
  const auto rounded = steps::quantize_weights({weights}, 5e-4);
  ASSERT_TRUE(rounded);
  std::vector<unsigned> numbers;
  const std::string& bytes = rounded->front().bytes;
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    numbers.push_back(static_cast<unsigned char>(bytes[i]) +
                      256U * static_cast<unsigned char>(bytes[i + 1]));
  }
  EXPECT_THAT(numbers, ElementsAre(21845, 21845, 21845, 0, 0, 0, 0, 0));
}

TEST(QuantizeValues, KeepsWeightsThatDoNotAddUp) {
  EXPECT_FALSE(steps::quantize_weights({{{0.5F, 0.3F, 0, 0}, 4}}, 5e-4));
  EXPECT_FALSE(steps::quantize_weights({{{1.5F, -0.5F, 0, 0}, 4}}, 5e-4));
}

TEST(QuantizeValues, TakesMoreBitsForASmallerAngle) {
  const FloatElements normals{{0.6F, 0.48F, 0.64F}, 3};
  EXPECT_THAT(steps::quantize_directions(normals, 0.5)->bytes, SizeIs(3));
  EXPECT_THAT(steps::quantize_directions(normals, 0.01)->bytes, SizeIs(6));
  EXPECT_FALSE(steps::quantize_directions(normals, 1e-6));
  EXPECT_FALSE(steps::quantize_directions({{NAN, 0, 1}, 3}, 0.5));
  EXPECT_FALSE(steps::quantize_directions({{0, 0, 1, 0.5F}, 4}, 0.5));
}

TEST(QuantizeValues, KeepsWrappedTextureCoordinates) {
  EXPECT_FALSE(steps::quantize_texcoords({{0, 1.5F}, 2}, 0.1, false));
  EXPECT_FALSE(steps::quantize_texcoords({{0, 0.3F}, 2}, 1e-7, false));
  EXPECT_TRUE(steps::quantize_texcoords({{0, 1}, 2}, 1e-7, false));
}

TEST(QuantizeValues, LeavesOutBitsForEntropyCoders) {
  const auto coarse = steps::quantize_texcoords({{0.3F, 1}, 2}, 0.001, true);
  ASSERT_TRUE(coarse);
  EXPECT_EQ(coarse->bytes, std::string("\x00\x4d\xff\xff", 4));  // 154 * 128, 65535
}

TEST(QuantizeValues, StoresBytesOnlyWhereColorsWereBytes) {
  EXPECT_THAT(steps::quantize_colors({{0, 1, 51.0F / 255}, 3}, 1e-3, false)->bytes, SizeIs(3));
  EXPECT_THAT(steps::quantize_colors({{0, 1, 0.3F}, 3}, 1e-3, false)->bytes, SizeIs(6));
}

}  // namespace
}  // namespace gltfx

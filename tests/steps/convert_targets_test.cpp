// SPDX-License-Identifier: Apache-2.0
// Conversions for engines: what they refuse is replaced, and the rest is listed.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "targets_support.hpp"

namespace gltfx::test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pointwise;

std::vector<float> square() { return {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}; }

// A triangle; returns its primitive.
OrderedJson triangle(MadeAsset& asset) {
  OrderedJson primitive;
  primitive["attributes"]["POSITION"] =
      asset.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", true);
  return primitive;
}

TEST_F(TargetConversion, StoresSparseAccessors) {
  MadeAsset asset;
  OrderedJson primitive = triangle(asset);
  const std::size_t indices = asset.view(packed<std::uint16_t>({1}));
  const std::size_t values = asset.view(packed<float>({5, 0, 0}));
  auto& accessor = asset.json["accessors"][0];
  accessor["max"] = {5, 1, 0};
  accessor["sparse"] = {{"count", 1},
                        {"indices", {{"bufferView", indices}, {"componentType", 5123}}},
                        {"values", {{"bufferView", values}}}};
  asset.mesh(primitive);
  const StoredAsset result = converted(asset, {"accessor.sparse"});
  EXPECT_THAT(numbers_of(result, 0), ElementsAre(0, 0, 0, 5, 0, 0, 0, 1, 0));
  EXPECT_FALSE(result.json()["accessors"][0].contains("sparse"));
  EXPECT_EQ(result.json()["bufferViews"].size(), 1U);
}

TEST_F(TargetConversion, StoresImpliedZeros) {
  MadeAsset asset;
  OrderedJson primitive = triangle(asset);
  asset.json["accessors"].push_back({{"componentType", 5126}, {"count", 3}, {"type", "VEC2"}});
  primitive["attributes"]["TEXCOORD_0"] = 1;
  asset.mesh(primitive);
  const StoredAsset result = converted(asset, {"accessor.zeros"});
  EXPECT_THAT(numbers_of(result, 1), ElementsAre(0, 0, 0, 0, 0, 0));
}

TEST_F(TargetConversion, DoesNotStoreMoreZerosThanMemoryAllows) {
  MadeAsset asset;
  OrderedJson primitive = triangle(asset);
  asset.json["accessors"].push_back(
      {{"componentType", 5126}, {"count", std::uint64_t{1} << 40U}, {"type", "VEC2"}});
  primitive["attributes"]["TEXCOORD_0"] = 1;
  asset.mesh(primitive);
  const ConvertReport report = convert(asset.glb(), refuser({"accessor.zeros"}));
  EXPECT_FALSE(report.written);
  EXPECT_THAT(report.error, HasSubstr("/accessors/1: its elements would take too much memory"));
}

TEST_F(TargetConversion, WritesIntegersAsFloats) {
  MadeAsset asset;
  OrderedJson primitive = triangle(asset);
  primitive["attributes"]["TEXCOORD_0"] =
      asset.accessor<std::uint16_t>({0, 65535, 32768, 1, 2, 3}, "VEC2", true);
  asset.json["accessors"][1]["normalized"] = true;
  asset.mesh(primitive);
  const StoredAsset result = converted(asset, {"attribute.texcoord-uint16"});
  std::vector<double> expected;
  for (const double value : {0, 65535, 32768, 1, 2, 3}) {
    expected.push_back(static_cast<double>(static_cast<float>(value / 65535)));
  }
  EXPECT_EQ(numbers_of(result, 1), expected);
  const OrderedJson accessor = result.json()["accessors"][1];
  EXPECT_EQ(accessor["componentType"], 5126);
  EXPECT_FALSE(accessor.contains("normalized"));
  EXPECT_EQ(accessor["max"][1], 1);
}

TEST_F(TargetConversion, RemovesQuantization) {
  MadeAsset asset;
  OrderedJson primitive;
  // Elements of three shorts take eight bytes.
  const std::string positions = packed<std::int16_t>({0, 0, 0, 0, 300, 0, 0, 0, 0, 300, -7, 0});
  const std::string normals("\x5A\x5A\0\0\0\x7F\0\0\0\0\x7F\0", 12);
  primitive["attributes"]["POSITION"] = asset.AssetBuilder::accessor(
      "VEC3", 5122, 3, positions, {{"min", {0, 0, -7}}, {"max", {300, 300, 0}}},
      {{"byteStride", 8}});
  primitive["attributes"]["NORMAL"] = asset.AssetBuilder::accessor(
      "VEC3", 5120, 3, normals, {{"normalized", true}}, {{"byteStride", 4}});
  asset.mesh(primitive);
  asset.json["extensionsUsed"] = asset.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const StoredAsset result = converted(asset, {"KHR_mesh_quantization"});
  EXPECT_THAT(numbers_of(result, 0), ElementsAre(0, 0, 0, 300, 0, 0, 0, 300, -7));
  EXPECT_THAT(numbers_of(result, 1), Pointwise(DoubleNear(1e-7), {std::sqrt(0.5), std::sqrt(0.5),
                                                                  0., 0., 1., 0., 0., 0., 1.}));
  EXPECT_FALSE(result.json().contains("extensionsUsed"));
  EXPECT_FALSE(result.json().contains("extensionsRequired"));
}

TEST_F(TargetConversion, WritesAnimationsAsFloats) {
  MadeAsset asset;
  asset.mesh(triangle(asset));
  const std::size_t times = asset.accessor<float>({0, 1}, "SCALAR", true);
  const std::size_t turns =
      asset.accessor<std::int16_t>({0, 0, 0, 32767, 0, 23170, 0, 23170}, "VEC4");
  asset.json["accessors"][turns]["normalized"] = true;
  asset.json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", turns}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
  const StoredAsset result = converted(asset, {"animation.rotation-int16"});
  EXPECT_EQ(result.json()["accessors"][turns]["componentType"], 5126);
  EXPECT_NEAR(numbers_of(result, turns)[5], std::sqrt(0.5), 1e-4);
}

TEST_F(TargetConversion, SeparatesInterleavedAttributes) {
  MadeAsset asset;
  const std::size_t view = asset.view(
      packed<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1}), {{"byteStride", 24}});
  for (const int offset : {0, 12}) {
    OrderedJson accessor{{"bufferView", view},
                         {"byteOffset", offset},
                         {"componentType", 5126},
                         {"count", 3},
                         {"type", "VEC3"}};
    if (offset == 0) accessor.update({{"min", {0, 0, 0}}, {"max", {1, 1, 0}}});
    asset.add("accessors", accessor);
  }
  OrderedJson primitive;
  primitive["attributes"] = {{"POSITION", 0}, {"NORMAL", 1}};
  asset.mesh(primitive);
  const StoredAsset result = converted(asset, {"accessor.interleaved"});
  EXPECT_THAT(numbers_of(result, 0), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
  EXPECT_THAT(numbers_of(result, 1), ElementsAre(0, 0, 1, 0, 0, 1, 0, 0, 1));
  const OrderedJson views = result.json()["bufferViews"];
  for (const OrderedJson& each : views) {
    EXPECT_FALSE(each.contains("byteStride"));
  }
}

TEST_F(TargetConversion, WritesLists) {
  MadeAsset asset;
  OrderedJson primitive;
  primitive["attributes"]["POSITION"] = asset.accessor(square(), "VEC3", true);
  primitive["mode"] = 5;
  asset.mesh(primitive);
  primitive["indices"] = asset.accessor<std::uint8_t>({0, 1, 3, 2}, "SCALAR");
  primitive["mode"] = 6;
  asset.mesh(primitive);
  primitive["mode"] = 2;
  asset.mesh(primitive);
  const StoredAsset result = converted(asset, {"primitive.triangle-strip", "index.uint8",
                                               "primitive.triangle-fan", "primitive.line-loop"});
  const OrderedJson meshes = result.json()["meshes"];
  const auto indices = [&](std::size_t mesh) {
    return numbers_of(result, meshes[mesh]["primitives"][0]["indices"]);
  };
  EXPECT_EQ(meshes[0]["primitives"][0]["mode"], 4);
  EXPECT_EQ(meshes[2]["primitives"][0]["mode"], 1);
  EXPECT_THAT(indices(0), ElementsAre(0, 1, 2, 2, 1, 3));
  EXPECT_THAT(indices(1), ElementsAre(0, 1, 3, 0, 3, 2));
  EXPECT_THAT(indices(2), ElementsAre(0, 1, 1, 3, 3, 2, 2, 0));
}

TEST_F(TargetConversion, WritesMissingIndices) {
  MadeAsset asset;
  asset.mesh(triangle(asset));
  const StoredAsset result = converted(asset, {"index.none"});
  EXPECT_THAT(numbers_of(result, result.json()["meshes"][0]["primitives"][0]["indices"]),
              ElementsAre(0, 1, 2));
}

TEST_F(TargetConversion, WritesMatricesOfSkins) {
  MadeAsset asset;
  asset.mesh(triangle(asset));
  asset.json["nodes"].push_back({{"name", "joint"}});
  asset.json["skins"] = {{{"joints", {1}}}};
  const StoredAsset result = converted(asset, {"skin.no-inverse-bind-matrices"});
  const OrderedJson json = result.json();
  const std::size_t matrices = json["skins"][0]["inverseBindMatrices"];
  EXPECT_EQ(json["accessors"][matrices]["type"], "MAT4");
  EXPECT_EQ(json["accessors"][matrices]["count"], 1);
}

TEST_F(TargetConversion, PacksExternalBuffers) {
  MadeAsset asset;
  asset.mesh(triangle(asset));
  OrderedJson json = asset.json;
  json["buffers"] = {{{"byteLength", asset.bytes.size()}, {"uri", "b%61.bin"}}};
  folder_.write("ba.bin", asset.bytes);
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string glb = container::test::glb(container::test::chunk(container::kChunkJson, text));
  const StoredAsset result =
      converted(glb, refuser({"container.glb-external-buffer", "uri.percent-encoded"}));
  EXPECT_FALSE(result.json()["buffers"][0].contains("uri"));
}

TEST_F(TargetConversion, DecodesOnlyWhatIsRefused) {
  MadeAsset asset;
  asset.mesh(triangle(asset));
  ConvertOptions options = options_to(folder_.path() / "packed.glb");
  options.compress = Compression::meshopt;
  ASSERT_TRUE(convert_file(folder_.write("b.glb", asset.glb()).native(), options).written);
  const std::string packed = container::test::content_of(options.output);
  const ConvertReport same = convert(packed, refuser({"KHR_draco_mesh_compression"}));
  EXPECT_FALSE(same.changes);
  options_.targets.clear();
  const StoredAsset result = converted(packed, refuser({"EXT_meshopt_compression"}));
  EXPECT_FALSE(result.json().contains("extensionsUsed"));
  EXPECT_THAT(numbers_of(result, 0), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0));
}

TEST_F(TargetConversion, DecodesIntegersBeforeTheyBecomeFloats) {
  MadeAsset asset;
  OrderedJson primitive = triangle(asset);
  primitive["attributes"]["TEXCOORD_0"] =
      asset.accessor<std::uint16_t>({0, 65535, 0, 0, 65535, 0}, "VEC2");
  asset.json["accessors"][1]["normalized"] = true;
  primitive["indices"] = asset.accessor<std::uint16_t>({0, 1, 2}, "SCALAR");
  asset.mesh(primitive);
  ConvertOptions options = options_to(folder_.path() / "packed.glb");
  options.compress = Compression::draco;
  ASSERT_TRUE(convert_file(folder_.write("b.glb", asset.glb()).native(), options).written);
  const StoredAsset result = converted(container::test::content_of(options.output),
                                       refuser({"attribute.texcoord-uint16"}));
  EXPECT_FALSE(result.json().contains("extensionsUsed"));
  const OrderedJson attributes = result.json()["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_THAT(numbers_of(result, attributes["TEXCOORD_0"]),
              testing::UnorderedElementsAre(0, 1, 0, 0, 1, 0));
}

TEST_F(TargetConversion, ListsWhatRemains) {
  MadeAsset asset;
  asset.mesh(triangle(asset));
  const TargetChoice choice = refuser({"primitive.no-normals", "index.none"});
  const ConvertReport report = convert(asset.glb(), choice);
  EXPECT_FALSE(report.written);
  EXPECT_EQ(report.problem, EditProblem::refused);
  EXPECT_EQ(report.error, "Engine 1.0 refuses assets with " +
                              target_features().at("primitive.no-normals").title +
                              " (--partial writes the rest)");
  ASSERT_EQ(report.remaining.size(), 1U);
  EXPECT_EQ(report.remaining[0].feature, "primitive.no-normals");
  EXPECT_EQ(report.remaining[0].pointer, "/meshes/0/primitives/0");
  EXPECT_TRUE(report.remaining[0].refused);
  EXPECT_EQ(report.refused(), 1U);
  options_.targets.clear();
  options_.partial = true;
  EXPECT_TRUE(convert(asset.glb(), choice).written);
  EXPECT_TRUE(StoredAsset::at(out_).json()["meshes"][0]["primitives"][0].contains("indices"));
}

TEST_F(TargetConversion, ListsWhatIsIgnored) {
  MadeAsset asset;
  asset.mesh(triangle(asset));
  const ConvertReport report =
      convert(asset.glb(), engine(R"("primitive.no-normals": {"used": "ignored"})"));
  EXPECT_TRUE(report.written) << report.error;
  ASSERT_EQ(report.remaining.size(), 1U);
  EXPECT_FALSE(report.remaining[0].refused);
  EXPECT_EQ(report.refused(), 0U);
}

TEST_F(TargetConversion, SatisfiesAllTargets) {
  MadeAsset asset;
  OrderedJson primitive = triangle(asset);
  primitive["indices"] = asset.accessor<std::uint8_t>({0, 1, 2}, "SCALAR");
  asset.mesh(primitive);
  primitive.erase("indices");
  asset.mesh(primitive);
  options_.targets.push_back(engine(R"("index.none": {"used": "refused"})", "other"));
  const StoredAsset result = converted(asset, {"index.uint8"});
  const OrderedJson meshes = result.json()["meshes"];
  for (const OrderedJson& mesh : meshes) {
    EXPECT_EQ(result.json()["accessors"][mesh["primitives"][0]["indices"].get<std::size_t>()]
                           ["componentType"],
              5123);
  }
}

TEST_F(TargetConversion, DoesNotTradeOneFeatureForAnother) {
  MadeAsset asset;
  asset.mesh(triangle(asset));
  const ConvertReport report = convert(asset.glb(), engine(R"("index.none": {"used": "refused"},
                                     "index.uint16": {"used": "ignored"})"));
  // The feature `index.uint16` has no effect on the picture in the built-in list.
  EXPECT_EQ(target_features().at("index.uint16").effect == FeatureEffect::picture, !report.written);
}

TEST_F(TargetConversion, ShrinksToWhatTheTargetReads) {
  MadeAsset asset;
  std::vector<float> positions;
  for (int i = 0; i < 999; ++i) positions.push_back(static_cast<float>(i % 37));
  OrderedJson primitive;
  primitive["attributes"]["POSITION"] = asset.accessor(positions, "VEC3", true);
  asset.mesh(primitive);
  options_.shrink = true;
  const StoredAsset plain = converted(asset.glb(), engine(""));
  EXPECT_FALSE(plain.json().contains("extensionsRequired"));
  options_.targets.clear();
  const StoredAsset small =
      converted(asset.glb(), engine(R"("EXT_meshopt_compression": {"required": "read"})"));
  EXPECT_EQ(small.json()["extensionsRequired"], OrderedJson::array({"EXT_meshopt_compression"}));
  EXPECT_LT(small.container.bytes.size(), plain.container.bytes.size());
}

}  // namespace
}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
#include "model/usage.hpp"

#include <gtest/gtest.h>

#include "asset_text.hpp"
#include "model/mesh.hpp"
#include "model/views.hpp"

namespace gltfx::model {
namespace {

using test::AssetText;

TEST(Usage, TheFirstUseDecidesInTheOrderOfTheSpecification) {
  const AssetText text(R"({
    "accessors": [{"bufferView": 0}, {"bufferView": 1}, {"bufferView": 2}, {"bufferView": 3}, {"bufferView": 3}],
    "bufferViews": [{}, {}, {"target": 34963}, {}, {}, {}],
    "images": [{"bufferView": 4}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "WRONG": 9}, "indices": 1,
      "targets": [{"NORMAL": 2}]}]}],
    "skins": [{"inverseBindMatrices": 3}],
    "animations": [{"samplers": [{"input": 4, "output": 0}]}]})");
  const Views views(text.asset);
  EXPECT_EQ(views.usage.accessor(0).kind, AccessorUse::vertex_attribute);
  EXPECT_EQ(views.usage.accessor(1).kind, AccessorUse::indices);
  EXPECT_EQ(views.usage.accessor(2).kind, AccessorUse::vertex_attribute);
  EXPECT_EQ(views.usage.accessor(3).kind, AccessorUse::inverse_bind_matrices);
  EXPECT_EQ(views.usage.accessor(4).kind, AccessorUse::animation_input);
  EXPECT_EQ(views.usage.view(0).kind, ViewUse::vertices);
  EXPECT_EQ(views.usage.view(1).kind, ViewUse::indices);
  EXPECT_EQ(views.usage.view(2).kind, ViewUse::indices) << "the target is declared";
  EXPECT_EQ(views.usage.view(2).place, json::kNoNode);
  EXPECT_EQ(views.usage.view(3).kind, ViewUse::inverse_bind_matrices);
  EXPECT_EQ(views.usage.view(4).kind, ViewUse::image);
  EXPECT_EQ(views.usage.view(5).kind, ViewUse::none);
}

TEST(Usage, SparsePartsComeBeforeMeshes) {
  const AssetText text(R"({
    "accessors": [{"bufferView": 0, "count": 1, "type": "SCALAR", "componentType": 5126,
      "sparse": {"count": 1, "indices": {"bufferView": 0, "componentType": 5121}, "values": {"bufferView": 1}}}],
    "bufferViews": [{}, {}],
    "meshes": [{"primitives": [{"attributes": {"_A": 0}}]}]})");
  const Views views(text.asset);
  EXPECT_EQ(views.usage.view(0).kind, ViewUse::other);
  EXPECT_EQ(views.usage.view(1).kind, ViewUse::other);
}

TEST(BufferView, StrideAndTargetOutsideTheirRangeCountAsAbsent) {
  const AssetText text(R"({"buffers": [{}], "bufferViews": [
    {"buffer": 0, "byteOffset": 4, "byteLength": 8, "byteStride": 252, "target": 34962},
    {"buffer": 1, "byteLength": 0, "byteStride": 253, "target": 5}, {"byteStride": 3}]})");
  const auto views = read_buffer_views(text.asset);
  EXPECT_EQ(views[0].buffer, 0U);
  EXPECT_EQ(views[0].byte_offset, 4U);
  EXPECT_EQ(views[0].byte_length, 8U);
  EXPECT_EQ(views[0].byte_stride, 252U);
  EXPECT_EQ(views[0].target, ViewTarget::vertices);
  EXPECT_FALSE(views[1].buffer);
  EXPECT_FALSE(views[1].byte_length);
  EXPECT_FALSE(views[1].byte_stride);
  EXPECT_EQ(views[1].target, ViewTarget::none);
  EXPECT_FALSE(views[2].byte_stride);
}

TEST(Primitive, ModeIsTrianglesUnlessGivenAndNothingWhenWrong) {
  const AssetText text(R"([{}, {"mode": 0}, {"mode": 7}, {"mode": "6"}, {"mode": 6}])");
  std::vector<std::optional<Mode>> modes;
  for (const json::NodeId object : text.document.elements(0)) {
    modes.push_back(read_primitive(text.asset, object).mode);
  }
  EXPECT_EQ(modes, (std::vector<std::optional<Mode>>{Mode::triangles, Mode::points, std::nullopt,
                                                     std::nullopt, Mode::triangle_fan}));
}

TEST(Primitive, TargetsCountOnlyWhenAllOfThemAreObjectsWithMembers) {
  const AssetText text(R"([{"targets": [{"A": 0}, {"B": 1}]}, {"targets": [{"A": 0}, {}]},
    {"targets": [{"A": 0}, 5]}, {}])");
  std::vector<std::size_t> counts;
  for (const json::NodeId object : text.document.elements(0)) {
    counts.push_back(morph_targets(text.document, object).size());
  }
  EXPECT_EQ(counts, (std::vector<std::size_t>{2, 0, 0, 0}));
}

}  // namespace
}  // namespace gltfx::model

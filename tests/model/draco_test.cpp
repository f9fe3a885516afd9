// SPDX-License-Identifier: Apache-2.0
// Compressed geometry as triangles, bitstreams that cannot be decoded, and compressed views.
#include "model/draco.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/support/draco_encoder.hpp"
#include "model/bytes_asset.hpp"

namespace gltfx::model {
namespace {

using test::Accessors;
using test::BytesAsset;
using test::one_mesh;
using testing::ElementsAre;
using testing::SizeIs;

// The square of the encoder, its accessors without bytes.
BytesAsset square(const std::string& bytes, const std::string& more = {}) {
  Accessors accessors;
  accessors.add_plain(R"({"type": "VEC3", "componentType": 5126, "count": 4})");
  accessors.add_plain(R"({"type": "SCALAR", "componentType": 5121, "count": 6})");
  accessors.add_view(bytes);
  return {accessors,
          one_mesh(R"("POSITION": 0)",
                   R"(, "indices": 1, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 0,
 "attributes": {"POSITION": 0}}})" +
                       more)};
}

TEST(DracoGeometry, BitstreamsTakeThePlaceOfAccessors) {
  BytesAsset asset = square(test::draco_bytes(test::draco_square()));
  asset.draco().decode(codec::Client::shared(), 1);
  const auto read = asset.read();
  ASSERT_EQ(read.error, GeometryError::none);
  EXPECT_THAT(read.geometry.positions, SizeIs(4));
  ASSERT_THAT(read.geometry.triangles, SizeIs(2));
  double area = 0;
  for (const auto& [a, b, c] : read.geometry.triangles) {
    const auto& p = read.geometry.positions;
    area += static_cast<double>((p[b][0] - p[a][0]) * (p[c][1] - p[a][1]) -
                                (p[b][1] - p[a][1]) * (p[c][0] - p[a][0])) /
            2;
  }
  EXPECT_DOUBLE_EQ(area, 1);
}

TEST(DracoGeometry, AStripIsDecodedToTriangles) {
  BytesAsset asset = square(test::draco_bytes(test::draco_square()), R"(, "mode": 5)");
  asset.draco().decode(codec::Client::shared(), 1);
  EXPECT_THAT(asset.read().geometry.triangles, SizeIs(2));
}

TEST(DracoGeometry, WhatCannotBeDecodedIsNamed) {
  BytesAsset asset = square("DRACO but not really");
  EXPECT_EQ(asset.read().error, GeometryError::packed) << "it is not decoded yet";
  asset.draco().decode(codec::Client::shared(), 1);
  EXPECT_EQ(asset.read().error, GeometryError::packed);
  EXPECT_TRUE(std::holds_alternative<codec::DecodeError>(*asset.draco().find(0)));
  EXPECT_EQ(asset.draco().find(1), nullptr);
}

TEST(DracoGeometry, OneBitstreamIsDecodedOnce) {
  BytesAsset asset = square(test::draco_bytes(test::draco_square()));
  asset.draco().add_all(asset.asset(), asset.views(), asset.resources());
  asset.draco().decode(codec::Client::shared(), 1);
  EXPECT_NE(asset.draco().mesh(0), nullptr);
}

}  // namespace
}  // namespace gltfx::model

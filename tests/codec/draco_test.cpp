// SPDX-License-Identifier: Apache-2.0
/// Meshes decoded by the worker of the build.
#include <atomic>
#include <cstring>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codec/client.hpp"
#include "codec/support/draco_encoder.hpp"
#include "codec/support/results.hpp"
#include "model/packed_bytes.hpp"

namespace gltfx::codec {
namespace {

using test::draco_bytes;
using test::DracoSource;
using testing::Each;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::FloatNear;
using testing::HasSubstr;

std::span<const std::byte> draco_bytes(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

DracoResult decode_draco(const std::string& bytes) {
  return Client::shared().decode_draco(draco_bytes(bytes));
}

DracoMesh mesh_of(const std::string& bytes) { return test::value_of(decode_draco(bytes)); }

DecodeError draco_error(const std::string& bytes) { return test::error_of(decode_draco(bytes)); }

// Whether a worker got the bytes, with any result.
bool was_asked(const DracoResult& result) {
  const auto* error = std::get_if<DecodeError>(&result);
  return error == nullptr || error->kind != ErrorKind::unavailable;
}

template <typename T>
std::vector<T> values(const DracoAttribute& attribute) {
  std::vector<T> values(attribute.values.size() / sizeof(T));
  std::memcpy(values.data(), attribute.values.data(), values.size() * sizeof(T));
  return values;
}

TEST(Draco, AMeshComesBackAsItWas) {
  const DracoMesh mesh = mesh_of(draco_bytes(test::draco_square()));
  EXPECT_EQ(mesh.points, 4U);
  EXPECT_THAT(mesh.indices, ElementsAre(0, 1, 2, 2, 1, 3));
  ASSERT_EQ(mesh.attributes.size(), 1U);
  EXPECT_EQ(mesh.attributes[0].component, Component::float32);
  EXPECT_EQ(mesh.attributes[0].components, 3U);
  EXPECT_EQ(mesh.attributes[0].quantization_step, 0);
  EXPECT_THAT(values<float>(mesh.attributes[0]),
              ElementsAreArray({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}));
}

TEST(Draco, QuantisedValuesAreNumbersAgain) {
  DracoSource source = test::draco_grid(20);
  source.attributes[0].bits = 8;
  const DracoMesh mesh = mesh_of(draco_bytes(source));
  ASSERT_EQ(mesh.attributes.size(), 1U);
  EXPECT_DOUBLE_EQ(mesh.attributes[0].quantization_step, 1.0 / 255);
  std::vector<float> wanted(source.attributes[0].bytes.size() / 4);
  std::memcpy(wanted.data(), source.attributes[0].bytes.data(), wanted.size() * 4);
  const std::vector<float> got = values<float>(mesh.attributes[0]);
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], wanted[i], 0.5001 / 255) << i;
}

TEST(Draco, NormalsAreUnitVectors) {
  DracoSource source = test::draco_square();
  DracoSource::Attribute normals;
  normals.kind = DracoSource::Kind::normal;
  normals.bytes = test::floats({0, 0, 1, 0, 0.6F, 0.8F, -0.6F, 0, -0.8F, 0.36F, 0.48F, 0.8F});
  normals.id = 7;
  normals.bits = 10;
  source.attributes.push_back(normals);
  const DracoMesh mesh = mesh_of(draco_bytes(source));
  ASSERT_EQ(mesh.attributes.size(), 2U);
  const DracoAttribute& found = mesh.attributes[1];
  EXPECT_EQ(found.id, 7U);
  EXPECT_GT(found.quantization_step, 0);
  const std::vector<float> got = values<float>(found);
  const std::vector<float> wanted{0, 0, 1, 0, 0.6F, 0.8F, -0.6F, 0, -0.8F, 0.36F, 0.48F, 0.8F};
  ASSERT_EQ(got.size(), wanted.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_NEAR(got[i], wanted[i], found.quantization_step) << i;
  }
}

TEST(Draco, IntegersKeepTheirType) {
  DracoSource source = test::draco_square();
  source.attributes.push_back(
      {DracoSource::Kind::generic, DracoSource::Type::uint16, 4,
       test::packed<std::uint16_t>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 65535}), 3,
       0, false});
  source.attributes.push_back({DracoSource::Kind::color, DracoSource::Type::uint8, 3,
                               test::packed<std::uint8_t>({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 255}),
                               9, 0, true});
  const DracoMesh mesh = mesh_of(draco_bytes(source));
  ASSERT_EQ(mesh.attributes.size(), 3U);
  EXPECT_EQ(mesh.attributes[1].component, Component::uint16);
  EXPECT_EQ(mesh.attributes[1].id, 3U);
  EXPECT_EQ(values<std::uint16_t>(mesh.attributes[1]).back(), 65535);
  EXPECT_EQ(mesh.attributes[2].component, Component::uint8);
  EXPECT_TRUE(mesh.attributes[2].normalized);
  EXPECT_EQ(values<std::uint8_t>(mesh.attributes[2])[10], 11);
}

TEST(Draco, BothEncodingsHoldTheSameTriangles) {
  DracoSource source = test::draco_grid(30);
  source.edgebreaker = true;
  const DracoMesh mesh = mesh_of(draco_bytes(source));
  EXPECT_EQ(mesh.points, 900U);
  EXPECT_EQ(mesh.faces, 29U * 29 * 2);
  EXPECT_THAT(mesh.indices, Each(testing::Lt(900U)));
}

TEST(Draco, WhatIsNoMeshIsRefused) {
  EXPECT_EQ(draco_error("").kind, ErrorKind::malformed);
  EXPECT_EQ(draco_error("DRACO").kind, ErrorKind::malformed);
  EXPECT_EQ(draco_error(std::string(1000, 'x')).kind, ErrorKind::malformed);
  const DecodeError cloud = draco_error(test::draco_cloud_bytes(test::draco_square()));
  EXPECT_EQ(cloud.kind, ErrorKind::malformed);
  EXPECT_THAT(cloud.message, HasSubstr("point cloud"));
}

TEST(Draco, EveryCutIsAnErrorOrAMesh) {
  const std::string whole = draco_bytes(test::draco_square());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const DracoResult result = decode_draco(whole.substr(0, size));
    EXPECT_TRUE(was_asked(result)) << size;
  }
  EXPECT_TRUE(std::holds_alternative<DracoMesh>(decode_draco(whole)));
}

TEST(Draco, EveryByteMayBeAnother) {
  DracoSource source = test::draco_grid(6);
  source.edgebreaker = true;
  source.attributes[0].bits = 9;
  const std::string whole = draco_bytes(source);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0xFF);
    const DracoResult result = decode_draco(changed);
    EXPECT_TRUE(was_asked(result)) << at;
  }
  EXPECT_TRUE(std::holds_alternative<DracoMesh>(decode_draco(whole)));
}

TEST(Draco, ManyThreadsShareTheWorkers) {
  const std::string bytes = draco_bytes(test::draco_grid(12));
  std::vector<std::thread> threads;
  std::atomic<int> sound = 0;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 20; ++k) {
        const DracoResult result = decode_draco(bytes);
        const auto* mesh = std::get_if<DracoMesh>(&result);
        if (mesh != nullptr && mesh->points == 144) ++sound;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(sound, 160);
}

}  // namespace
}  // namespace gltfx::codec

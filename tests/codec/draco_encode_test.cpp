// SPDX-License-Identifier: Apache-2.0
/// Meshes that the worker of the build encodes and decodes again.
#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <limits>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/hash.hpp"
#include "codec/client.hpp"
#include "codec/draco_source.hpp"
#include "codec/support/results.hpp"

namespace gltfx::codec {
namespace {

using testing::HasSubstr;

/// A mesh to encode, with its bytes.
struct MeshToEncode {
  std::uint32_t points = 0;
  std::vector<std::uint32_t> indices;
  std::vector<DracoAttribute> attributes;
  std::vector<std::vector<std::byte>> bytes;

  template <typename T>
  MeshToEncode& add(DracoUse use, Component component, std::uint32_t components,
                    const std::vector<T>& values, bool normalized = false) {
    DracoAttribute attribute;
    attribute.id = static_cast<std::uint32_t>(attributes.size() * 3 + 1);
    attribute.use = use;
    attribute.component = component;
    attribute.components = components;
    attribute.normalized = normalized;
    attributes.push_back(attribute);
    const auto raw = std::as_bytes(std::span(values));
    bytes.emplace_back(raw.begin(), raw.end());
    return *this;
  }
  DracoMesh mesh() const {
    DracoMesh mesh;
    mesh.points = points;
    mesh.faces = static_cast<std::uint32_t>(indices.size() / 3);
    mesh.indices = indices;
    mesh.attributes = attributes;
    for (std::size_t i = 0; i < bytes.size(); ++i) mesh.attributes[i].values = bytes[i];
    return mesh;
  }
};

MeshToEncode grid_to_encode(std::uint32_t side) {
  MeshToEncode grid;
  grid.points = side * side;
  std::vector<float> positions;
  for (std::uint32_t i = 0; i < grid.points; ++i) {
    const std::uint32_t x = i % side;
    const std::uint32_t y = i / side;
    positions.insert(positions.end(), {static_cast<float>(x) * 0.1F, static_cast<float>(y) / 3, 0});
    if (x + 1 == side || y + 1 == side) continue;
    for (const std::uint32_t corner : {i, i + 1, i + side, i + side, i + 1, i + side + 1}) {
      grid.indices.push_back(corner);
    }
  }
  return grid.add(DracoUse::position, Component::float32, 3, positions);
}

// All values of the corners of each triangle, independent of its first corner.
std::vector<std::string> corners_of(const DracoMesh& mesh) {
  std::vector<std::string> triangles;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    std::array<std::string, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      for (const DracoAttribute& attribute : mesh.attributes) {
        const std::size_t size = attribute.values.size() / mesh.points;
        const auto* value = attribute.values.data() + mesh.indices[i + k] * size;
        corners[k].append(reinterpret_cast<const char*>(value), size);
      }
    }
    triangles.push_back(
        std::min({corners[0] + corners[1] + corners[2], corners[1] + corners[2] + corners[0],
                  corners[2] + corners[0] + corners[1]}));
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

EncodedDraco encoded_mesh(const DracoMesh& mesh) {
  return test::value_of(Client::shared().encode_draco(mesh));
}

std::string refused_mesh(const DracoMesh& mesh) {
  return test::refusal_of(Client::shared().encode_draco(mesh));
}

void expect_exact(const MeshToEncode& source) {
  const EncodedDraco encoded = encoded_mesh(source.mesh());
  EXPECT_EQ(corners_of(encoded.mesh), corners_of(source.mesh()));
  ASSERT_EQ(encoded.mesh.attributes.size(), source.attributes.size());
  for (std::size_t i = 0; i < source.attributes.size(); ++i) {
    EXPECT_EQ(encoded.mesh.attributes[i].id, source.attributes[i].id);
    EXPECT_EQ(encoded.mesh.attributes[i].use, source.attributes[i].use);
    EXPECT_EQ(encoded.mesh.attributes[i].component, source.attributes[i].component);
    EXPECT_EQ(encoded.mesh.attributes[i].normalized, source.attributes[i].normalized);
    EXPECT_EQ(encoded.mesh.attributes[i].quantization_step, 0);
  }
  const DracoMesh decoded = test::value_of(Client::shared().decode_draco(encoded.bytes));
  EXPECT_TRUE(std::ranges::equal(decoded.indices, encoded.mesh.indices));
}

TEST(DracoEncode, FloatsComeBackBitForBit) {
  MeshToEncode grid = grid_to_encode(30);
  std::mt19937 random(3);  // NOLINT(cert-msc51-cpp): the same each time
  std::vector<std::uint32_t> bits(grid.points * std::size_t{2});
  for (std::uint32_t& each : bits) each = static_cast<std::uint32_t>(random());
  grid.add(DracoUse::tex_coord, Component::float32, 2, bits);  // includes NaN
  expect_exact(grid);
  EXPECT_LT(encoded_mesh(grid.mesh()).bytes.size(),
            grid.bytes[0].size() + grid.bytes[1].size() + grid.indices.size());
}

TEST(DracoEncode, ZerosKeepTheirSign) {
  MeshToEncode square;
  square.points = 4;
  square.indices = {0, 1, 2, 2, 1, 3};
  square.add<float>(DracoUse::position, Component::float32, 3,
                    {0.0F, 0, 0, 1, -0.0F, 0, 0, 1, -0.0F, -0.0F, 0, 0});
  expect_exact(square);
}

TEST(DracoEncode, IntegersOfEveryTypeComeBack) {
  MeshToEncode grid = grid_to_encode(9);
  const auto fill = [&](auto zero, Component component, DracoUse use, bool normalized) {
    using T = decltype(zero);
    std::vector<T> values;
    for (std::size_t i = 0; i < grid.points * std::size_t{4}; ++i) {
      values.push_back(static_cast<T>(i * 2654435761U >> 7U));
    }
    values[0] = std::numeric_limits<T>::max();
    values[5] = std::numeric_limits<T>::min();
    grid.add(use, component, 4, values, normalized);
  };
  fill(std::int8_t{}, Component::int8, DracoUse::normal, true);
  fill(std::uint8_t{}, Component::uint8, DracoUse::color, true);
  fill(std::int16_t{}, Component::int16, DracoUse::generic, false);
  fill(std::uint16_t{}, Component::uint16, DracoUse::generic, false);
  expect_exact(grid);
}

TEST(DracoEncode, SeamsAndRepeatedPointsKeepTheirCorners) {
  MeshToEncode grid = grid_to_encode(4);
  // Each triangle has separate points, so each position occurs six times.
  MeshToEncode soup;
  std::vector<float> positions;
  std::vector<float> coordinates;
  std::vector<float> source(grid.bytes[0].size() / 4);
  std::memcpy(source.data(), grid.bytes[0].data(), grid.bytes[0].size());
  for (const std::uint32_t index : grid.indices) {
    soup.indices.push_back(soup.points++);
    positions.insert(positions.end(), &source[index * 3], &source[index * 3] + 3);
    coordinates.insert(coordinates.end(), {static_cast<float>(soup.indices.size() / 9), 0});
  }
  soup.add(DracoUse::position, Component::float32, 3, positions)
      .add(DracoUse::tex_coord, Component::float32, 2, coordinates);
  expect_exact(soup);
  EXPECT_LT(encoded_mesh(soup.mesh()).mesh.points, soup.points) << "equal points become one";
}

TEST(DracoEncode, TrianglesWithoutAreaOrSharedByManyStay) {
  MeshToEncode mesh = grid_to_encode(3);
  // Points 9 and 10 are at the position of point 0: a triangle of different points at one position.
  mesh.points = 11;
  mesh.bytes[0].resize(std::size_t{11} * 12);
  for (const std::uint32_t corner : {0U, 9U, 10U, 0U, 1U, 9U, 1U, 2U, 4U, 4U, 2U, 1U, 1U, 2U, 4U}) {
    mesh.indices.push_back(corner);
  }
  expect_exact(mesh);
}

TEST(DracoEncode, WhatDracoCannotHoldIsRefused) {
  const MeshToEncode grid = grid_to_encode(3);
  MeshToEncode changed = grid;
  changed.indices.clear();
  EXPECT_THAT(refused_mesh(changed.mesh()), HasSubstr("no triangles"));
  changed = grid;
  changed.indices[4] = 9;
  EXPECT_THAT(refused_mesh(changed.mesh()), HasSubstr("refers to a missing vertex"));
  changed.indices[4] = 0xffffffff;
  EXPECT_THAT(refused_mesh(changed.mesh()), HasSubstr("refers to a missing vertex"));
  changed = grid;
  changed.indices[1] = changed.indices[0];
  EXPECT_THAT(refused_mesh(changed.mesh()), HasSubstr("a vertex twice"));
  changed = grid;
  changed.indices.pop_back();
  EXPECT_THAT(refused_mesh(changed.mesh()), HasSubstr("indices are incomplete"));
  changed = grid;
  changed.bytes[0].pop_back();
  EXPECT_THAT(refused_mesh(changed.mesh()), HasSubstr("values are incomplete"));
  changed = grid;
  changed.attributes[0].use = DracoUse::generic;
  EXPECT_THAT(refused_mesh(changed.mesh()), HasSubstr("exactly one position"));
  changed = grid;
  changed.attributes[0].component = Component::other;
  EXPECT_THAT(refused_mesh(changed.mesh()), HasSubstr("unsupported type"));
  changed = grid;
  changed.add(DracoUse::generic, Component::float32, 3, std::vector<float>(27));
  changed.attributes[1].id = changed.attributes[0].id;
  EXPECT_THAT(refused_mesh(changed.mesh()), HasSubstr("same id"));
}

// Values that are made to have one content_hash(): each is compared with few others all the same.
TEST(DracoEncode, ValuesAreComparedWithoutTheirHashes) {
  constexpr std::uint32_t kSide = 384;
  const auto after_word = [](std::uint64_t word) {
    const std::uint64_t hash = (0xCBF29CE484222325 ^ 16 ^ word) * 0x100000001B3;
    return hash ^ hash >> 32U;
  };
  MeshToEncode grid = grid_to_encode(kSide);
  std::vector<std::uint64_t> words;
  for (std::uint64_t i = 0; i < grid.points; ++i) words.insert(words.end(), {i, after_word(i)});
  ASSERT_EQ(content_hash({reinterpret_cast<const char*>(words.data()), 16}),
            content_hash({reinterpret_cast<const char*>(words.data() + 2), 16}));
  grid.attributes.clear();
  grid.bytes.clear();
  grid.add(DracoUse::position, Component::uint8, 16, words);
  const DracoMesh mesh = grid.mesh();
  const std::clock_t begin = std::clock();
  EXPECT_TRUE(have_same_triangles(mesh, mesh));
  EXPECT_LT(std::clock() - begin, 10 * CLOCKS_PER_SEC);
}

TEST(DracoEncode, OtherTrianglesAreNoticed) {
  const MeshToEncode grid = grid_to_encode(5);
  const DracoMesh mesh = grid.mesh();
  MeshToEncode changed = grid;
  EXPECT_TRUE(have_same_triangles(mesh, changed.mesh()));
  std::rotate(changed.indices.begin(), changed.indices.begin() + 3, changed.indices.end());
  std::rotate(changed.indices.begin(), changed.indices.begin() + 1, changed.indices.begin() + 3);
  EXPECT_TRUE(have_same_triangles(mesh, changed.mesh())) << "another order";
  std::swap(changed.indices[0], changed.indices[1]);
  EXPECT_FALSE(have_same_triangles(mesh, changed.mesh())) << "another winding";
  changed = grid;
  changed.bytes[0][7] ^= std::byte{1};
  EXPECT_FALSE(have_same_triangles(mesh, changed.mesh())) << "another value";
  changed = grid;
  std::copy_n(changed.indices.begin(), 3, changed.indices.begin() + 3);
  EXPECT_FALSE(have_same_triangles(mesh, changed.mesh())) << "one twice, another not";
}

TEST(DracoEncode, TheSameMeshBecomesTheSameBytes) {
  const MeshToEncode grid = grid_to_encode(12);
  const EncodedDraco once = encoded_mesh(grid.mesh());
  Client other;
  DracoEncodeResult twice = other.encode_draco(grid.mesh());
  ASSERT_TRUE(std::holds_alternative<EncodedDraco>(twice));
  EXPECT_TRUE(std::ranges::equal(once.bytes, std::get<EncodedDraco>(twice).bytes));
}

}  // namespace
}  // namespace gltfx::codec

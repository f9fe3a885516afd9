// SPDX-License-Identifier: Apache-2.0
/// Streams that are encoded, and decoded by our own decoder and the library's.
#include "model/meshopt_encode.hpp"

#include <cstdint>
#include <cstring>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

namespace gltfx::model::meshopt {
namespace {

using testing::ElementsAre;

template <typename T>
std::span<const std::byte> encoder_input(const std::vector<T>& values) {
  return std::as_bytes(std::span(values));
}

Layout layout_of(Mode mode, std::uint64_t count, std::uint64_t stride) {
  Layout layout;
  layout.mode = mode;
  layout.count = count;
  layout.stride = stride;
  return layout;
}

std::vector<std::byte> again(const std::vector<std::byte>& stream, const Layout& layout) {
  std::vector<std::byte> elements(static_cast<std::size_t>(*layout.decoded_size()));
  EXPECT_EQ(decode(stream, layout, elements), DecodeError::none);
  return elements;
}

TEST(MeshoptEncode, AttributesOfEveryStrideComeBackBitForBit) {
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same each time
  for (std::uint64_t stride = 4; stride <= 256; stride += 4) {
    for (const std::uint64_t count : {1U, 15U, 16U, 17U, 300U}) {
      std::vector<std::uint8_t> elements(count * stride);
      for (std::size_t i = 0; i < elements.size(); ++i) {
        elements[i] = static_cast<std::uint8_t>(i % 3 == 0 ? random() : i / stride);
      }
      const Layout layout = layout_of(Mode::attributes, count, stride);
      const auto stream = encode(encoder_input(elements), layout);
      ASSERT_TRUE(stream) << stride;
      EXPECT_EQ(stream->front(), std::byte{0xa0}) << "readers of EXT_ have version 0 alone";
      const auto wanted = encoder_input(elements);
      EXPECT_THAT(again(*stream, layout), testing::ElementsAreArray(wanted.begin(), wanted.end()));
    }
  }
}

TEST(MeshoptEncode, FloatsKeepTheirBits) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<float> values{0.0F, -0.0F, nan, 1e-45F, 3.4e38F, -1.5F};
  const Layout layout = layout_of(Mode::attributes, 2, 12);
  const auto stream = encode(encoder_input(values), layout);
  ASSERT_TRUE(stream);
  const std::vector<std::byte> back = again(*stream, layout);
  EXPECT_EQ(std::memcmp(back.data(), values.data(), back.size()), 0);
}

TEST(MeshoptEncode, IndicesKeepTheirOrder) {
  const std::vector<std::uint16_t> small{7, 7, 65535, 0, 3, 2, 1};
  const std::vector<std::uint32_t> large{4000000000U, 1, 0xffffffffU, 0, 2};
  for (const bool wide : {false, true}) {
    const Layout layout = layout_of(Mode::indices, wide ? 5 : 7, wide ? 4 : 2);
    const auto input = wide ? encoder_input(large) : encoder_input(small);
    const auto stream = encode(input, layout);
    ASSERT_TRUE(stream);
    EXPECT_EQ(stream->front(), std::byte{0xd1});
    EXPECT_THAT(again(*stream, layout), testing::ElementsAreArray(input.begin(), input.end()));
  }
}

TEST(MeshoptEncode, TrianglesKeepOrderAndWinding) {
  std::vector<std::uint32_t> grid;
  for (std::uint32_t i = 0; i < 20; ++i) {
    for (const std::uint32_t corner : {i, i + 1, i + 21, i + 21, i + 1, i + 22}) {
      grid.push_back(corner);
    }
  }
  grid.insert(grid.end(), {90000, 5, 7, 3, 3, 3, 7, 5, 90000});
  const Layout layout = layout_of(Mode::triangles, grid.size(), 4);
  const auto stream = encode(encoder_input(grid), layout);
  ASSERT_TRUE(stream);
  EXPECT_EQ(stream->front(), std::byte{0xe1});
  EXPECT_LT(stream->size(), grid.size());
  std::vector<std::uint32_t> back(grid.size());
  ASSERT_EQ(meshopt_decodeIndexBuffer(back.data(), back.size(), 4,
                                      reinterpret_cast<const unsigned char*>(stream->data()),
                                      stream->size()),
            0);
  for (std::size_t i = 0; i < grid.size(); i += 3) {
    const auto turned = [&](std::size_t by) {
      return std::vector{back[i + by], back[i + (by + 1) % 3], back[i + (by + 2) % 3]};
    };
    const auto wanted = ElementsAre(grid[i], grid[i + 1], grid[i + 2]);
    EXPECT_THAT(
        turned(0),
        testing::AnyOf(wanted, testing::ResultOf([&](const auto&) { return turned(1); }, wanted),
                       testing::ResultOf([&](const auto&) { return turned(2); }, wanted)))
        << i / 3;
  }
}

TEST(MeshoptEncode, WhatTheExtensionDoesNotHoldGivesNothing) {
  const std::vector<std::uint8_t> bytes(1040);
  const auto encoded = [&](Mode mode, std::uint64_t count, std::uint64_t stride) {
    const auto input = encoder_input(bytes).first(static_cast<std::size_t>(count * stride));
    return encode(input, layout_of(mode, count, stride)).has_value();
  };
  EXPECT_TRUE(encoded(Mode::attributes, 4, 256));
  EXPECT_FALSE(encoded(Mode::attributes, 4, 260)) << "stride over 256";
  EXPECT_FALSE(encoded(Mode::attributes, 4, 6)) << "stride of no four bytes";
  EXPECT_FALSE(encoded(Mode::attributes, 0, 4));
  EXPECT_FALSE(encoded(Mode::triangles, 4, 2)) << "no whole triangle";
  EXPECT_FALSE(encoded(Mode::triangles, 3, 1));
  EXPECT_FALSE(encoded(Mode::indices, 3, 8));
  Layout filtered = layout_of(Mode::attributes, 4, 8);
  filtered.filter = Filter::octahedral;
  EXPECT_FALSE(encode(encoder_input(bytes).first(32), filtered));
  EXPECT_FALSE(encode(encoder_input(bytes).first(31), layout_of(Mode::attributes, 4, 8)));
}

TEST(MeshoptEncode, TheSameElementsGiveTheSameStream) {
  std::vector<std::uint32_t> values(999);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint32_t>(i * i);
  const Layout layout = layout_of(Mode::attributes, 333, 12);
  EXPECT_EQ(encode(encoder_input(values), layout), encode(encoder_input(values), layout));
  EXPECT_LT(encode(encoder_input(values), layout)->size(), values.size() * 4);
}

}  // namespace
}  // namespace gltfx::model::meshopt

// SPDX-License-Identifier: Apache-2.0
// Filters against the formulas of the specification.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "model/meshopt_support.hpp"

namespace gltfx::test {
namespace {

using model::meshopt::Filter;
using model::meshopt::Layout;
using model::meshopt::Mode;

template <typename T>
std::vector<T> filtered(Filter filter, std::size_t stride, std::vector<T> numbers) {
  const std::size_t count = numbers.size() * sizeof(T) / stride;
  const Layout layout{count, stride, Mode::attributes, filter, 1};
  EXPECT_TRUE(layout.sound());
  const auto elements = std::as_writable_bytes(std::span(numbers));
  EXPECT_EQ(model::meshopt::find_misfits(layout, elements).count, 0U);
  model::meshopt::apply_filter(layout, elements);
  return numbers;
}

template <typename T>
std::uint64_t misfits(Filter filter, std::size_t stride, const std::vector<T>& numbers) {
  const std::size_t count = numbers.size() * sizeof(T) / stride;
  return model::meshopt::find_misfits({count, stride, Mode::attributes, filter, 1},
                                      std::as_bytes(std::span(numbers)))
      .count;
}

TEST(MeshoptFilters, NoneChangesNothing) {
  EXPECT_EQ(filtered<std::uint8_t>(Filter::none, 4, {1, 2, 3, 4}),
            (std::vector<std::uint8_t>{1, 2, 3, 4}));
}

TEST(MeshoptFilters, OctahedralVectorsAreOfUnitLength) {
  EXPECT_EQ(filtered<std::int8_t>(Filter::octahedral, 4, {0, 0, 127, 9, 7, 0, 7, -9}),
            (std::vector<std::int8_t>{0, 0, 127, 9, 127, 0, 0, -9}));
  const auto wide = filtered<std::int16_t>(Filter::octahedral, 8, {300, -100, 511, 5});
  double length = 0;
  for (int i = 0; i < 3; ++i)
    length +=
        wide[static_cast<std::size_t>(i)] / 32767.0 * wide[static_cast<std::size_t>(i)] / 32767.0;
  EXPECT_NEAR(std::sqrt(length), 1, 1e-4);
  EXPECT_GT(wide[0], 0);
  EXPECT_LT(wide[1], 0);
  EXPECT_EQ(wide[3], 5);
}

TEST(MeshoptFilters, QuaternionsGetTheirLargestComponentBack) {
  for (std::int16_t largest = 0; largest < 4; ++largest) {
    const auto identity = static_cast<std::int16_t>(0x7fc + largest);
    std::vector<std::int16_t> wanted(4);
    wanted[static_cast<std::size_t>(largest)] = 32767;
    EXPECT_EQ(filtered<std::int16_t>(Filter::quaternion, 8, {0, 0, 0, identity}), wanted);
  }
  const auto half = filtered<std::int16_t>(Filter::quaternion, 8, {2047, 0, 0, 2047});
  EXPECT_NEAR(half[0], 23170, 1);
  EXPECT_NEAR(half[3], 23170, 1);
}

TEST(MeshoptFilters, ExponentsAndMantissasMakeFloats) {
  const auto number = [](int exponent, int mantissa) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(exponent) << 24U |
                                     (static_cast<std::uint32_t>(mantissa) & 0xffffffU));
  };
  const auto result = filtered<std::int32_t>(Filter::exponential, 12,
                                             {number(0, 1), number(-3, -5), number(100, 0)});
  float floats[3];
  std::memcpy(floats, result.data(), sizeof(floats));
  EXPECT_EQ(floats[0], 1.0F);
  EXPECT_EQ(floats[1], -0.625F);
  EXPECT_EQ(floats[2], 0.0F);
}

// The formula of the specification, for colours of K bits.
template <typename T>
std::vector<T> encoded_color(int bits, int r, int g, int b, int a) {
  const int co = (r - b) / 2;
  const int rest = b + co;
  const int cg = (g - rest) / 2;
  const int y = rest + cg;
  return {static_cast<T>(y), static_cast<T>(co), static_cast<T>(cg),
          static_cast<T>(a >> 1 | 1 << (bits - 1))};
}

TEST(MeshoptFilters, ColoursComeBackFromLumaAndChroma) {
  EXPECT_EQ(
      filtered<std::uint8_t>(Filter::color, 4, encoded_color<std::uint8_t>(8, 200, 100, 40, 255)),
      (std::vector<std::uint8_t>{200, 100, 40, 255}));
  // Five bits are scaled up to eight.
  EXPECT_EQ(filtered<std::uint8_t>(Filter::color, 4, encoded_color<std::uint8_t>(5, 31, 16, 1, 0)),
            (std::vector<std::uint8_t>{255, 132, 8, 0}));
  EXPECT_EQ(filtered<std::uint16_t>(Filter::color, 8,
                                    encoded_color<std::uint16_t>(16, 60000, 20000, 10000, 65535)),
            (std::vector<std::uint16_t>{60000, 20000, 10000, 65535}));
}

TEST(MeshoptFilters, ElementsWithoutPrecisionAreMisfits) {
  EXPECT_EQ(misfits<std::int8_t>(Filter::octahedral, 4, {0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 6, 0}), 2U);
  EXPECT_EQ(misfits<std::int8_t>(Filter::octahedral, 4, {0, 0, -1, 0}), 1U);
  EXPECT_EQ(misfits<std::int16_t>(Filter::octahedral, 8, {0, 0, 32767, 0, 0, 0, -32768, 0}), 1U);
  EXPECT_EQ(misfits<std::int16_t>(Filter::quaternion, 8, {0, 0, 0, 4, 0, 0, 0, 3}), 1U);
  EXPECT_EQ(misfits<std::int16_t>(Filter::quaternion, 8, {0, 0, 0, 9}), 1U);
  const auto exponents = [](int exponent, int mantissa) {
    return misfits<std::int32_t>(Filter::exponential, 4, {exponent * (1 << 24) + mantissa});
  };
  for (const int inside : {100, 0, -100}) EXPECT_EQ(exponents(inside, 1), 0U);
  for (const int outside : {101, 127, -101, -128}) EXPECT_EQ(exponents(outside, 1), 1U);
  for (const int zero : {-101, -127}) EXPECT_EQ(exponents(zero, 0), 0U);
  EXPECT_EQ(exponents(-128, 0), 1U);
  EXPECT_EQ(misfits<std::uint8_t>(Filter::color, 4, {0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 0}), 2U);
  EXPECT_EQ(misfits<std::uint16_t>(Filter::color, 8, {0, 0, 0, 0x8000, 0, 0, 0, 1}), 1U);
}

TEST(MeshoptFilters, OfTheLibraryAreTaken) {
  const float vectors[] = {0, 0, 1, 0, 0.6F, -0.8F, 0, 1};
  std::vector<std::int8_t> bytes(8);
  meshopt_encodeFilterOct(bytes.data(), 2, 4, 8, vectors);
  EXPECT_EQ(misfits(Filter::octahedral, 4, bytes), 0U);
  const float rotations[] = {0, 0, 0, 1, 0.5F, -0.5F, 0.5F, 0.5F};
  std::vector<std::int16_t> words(8);
  meshopt_encodeFilterQuat(words.data(), 2, 8, 12, rotations);
  EXPECT_EQ(misfits(Filter::quaternion, 8, words), 0U);
  std::vector<std::int32_t> numbers(8);
  meshopt_encodeFilterExp(numbers.data(), 2, 16, 15, vectors);
  EXPECT_EQ(misfits(Filter::exponential, 16, numbers), 0U);
}

}  // namespace
}  // namespace gltfx::test

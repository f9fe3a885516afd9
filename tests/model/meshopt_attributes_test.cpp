// SPDX-License-Identifier: Apache-2.0
// Attribute streams: those of the library and of our own encoder are read back; all others are
// refused.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "model/meshopt.hpp"
#include "model/meshopt_support.hpp"

namespace gltfx::test {
namespace {

using model::meshopt::DecodeError;
using model::meshopt::Filter;
using model::meshopt::Layout;
using model::meshopt::Mode;

constexpr std::size_t kStrides[] = {4, 8, 12, 16, 36, 64, 128, 256};
constexpr std::size_t kCounts[] = {1, 2, 15, 16, 17, 31, 64, 65, 255, 256, 257, 600};

Layout attributes(std::size_t count, std::size_t stride) {
  return {count, stride, Mode::attributes, Filter::none, 1};
}

Octets library_stream(const Octets& elements, std::size_t count, std::size_t stride) {
  Octets stream(meshopt_encodeVertexBufferBound(count, stride));
  stream.resize(
      meshopt_encodeVertexBuffer(stream.data(), stream.size(), elements.data(), count, stride));
  return stream;
}

// Our decoder only, which also reads the streams of the library.
Decoded own(const Octets& stream, const Layout& layout) {
  Decoded result;
  result.elements.resize(static_cast<std::size_t>(layout.count * layout.stride));
  result.error = model::meshopt::decode_attributes(
      bytes_of(stream), layout, std::as_writable_bytes(std::span(result.elements)));
  return result;
}

template <typename Use>
void for_each_size(Use use) {
  for (const std::size_t stride : kStrides) {
    for (const std::size_t count : kCounts) {
      use(count, stride,
          Numbers(static_cast<std::uint32_t>(stride * 1000 + count)).elements(count, stride));
    }
  }
}

TEST(MeshoptAttributes, OfTheLibraryAreReadByBothDecoders) {
  for_each_size([](std::size_t count, std::size_t stride, const Octets& elements) {
    const Octets stream = library_stream(elements, count, stride);
    const Layout layout = attributes(count, stride);
    const Decoded wanted{DecodeError::none, elements};
    EXPECT_EQ(decoded(stream, layout), wanted) << count << " of " << stride;
    EXPECT_EQ(own(stream, layout), wanted) << count << " of " << stride;
  });
}

TEST(MeshoptAttributes, OfVersionOneAreReadInEveryWayToStoreThem) {
  for_each_size([](std::size_t count, std::size_t stride, const Octets& elements) {
    for (const auto control : {MeshoptEncoder::fitting, MeshoptEncoder::wide, MeshoptEncoder::zeros,
                               MeshoptEncoder::literal}) {
      MeshoptEncoder encoder(1, stride);
      const Octets stream = encoder.control(control).encode(elements);
      EXPECT_EQ(decoded(stream, attributes(count, stride)), (Decoded{DecodeError::none, elements}))
          << count << " of " << stride << ", " << control;
    }
  });
}

TEST(MeshoptAttributes, TakeDifferencesOfBytesWordsAndBits) {
  for_each_size([](std::size_t count, std::size_t stride, const Octets& elements) {
    for (unsigned rotation = 0; rotation < 16; rotation += 5) {
      Octets modes(stride / 4);
      for (std::size_t i = 0; i < modes.size(); ++i) {
        modes[i] = static_cast<std::uint8_t>((i + rotation) % 3);
        if (modes[i] == 2) modes[i] = static_cast<std::uint8_t>(2 | rotation << 4U);
      }
      const Octets stream = MeshoptEncoder(1, stride).modes(modes).encode(elements);
      EXPECT_EQ(decoded(stream, attributes(count, stride)), (Decoded{DecodeError::none, elements}));
    }
  });
}

TEST(MeshoptAttributes, ReadTheExampleOfTheSpecification) {
  // Sixteen differences of four bits in the first byte of elements of four.
  Octets stream{0xa0, 0x02, 0x17, 0x5f, 0xf0, 0xbc, 0x77, 0xa9, 0x21, 0x00, 0x34, 0xb5, 0, 0, 0};
  stream.resize(stream.size() + 32);
  const Decoded result = decoded(stream, attributes(16, 4));
  ASSERT_EQ(result.error, DecodeError::none);
  const int differences[] = {-1, -4, -3, 26, -91, 0, -6, 6, -4, -4, 5, -5, 1, -1, 0, 0};
  int sum = 0;
  for (std::size_t i = 0; i < 16; ++i) {
    sum += differences[i];
    EXPECT_EQ(result.elements[i * 4], static_cast<std::uint8_t>(sum)) << i;
  }
}

TEST(MeshoptAttributes, ThatAreCutOrLongerAreRefusedAtEveryLength) {
  for (const unsigned version : {0U, 1U}) {
    const Octets elements = Numbers(version).elements(300, 12);
    Octets stream = MeshoptEncoder(version, 12).encode(elements);
    const Layout layout = attributes(300, 12);
    ASSERT_EQ(error_of(stream, layout), DecodeError::none);
    for (std::size_t size = 0; size < stream.size(); ++size) {
      const Octets cut(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_NE(error_of(cut, layout), DecodeError::none) << size;
    }
    stream.insert(stream.end() - 40, 0);
    EXPECT_NE(error_of(stream, layout), DecodeError::none);
  }
}

TEST(MeshoptAttributes, SayWhatIsWrong) {
  const Octets elements = Numbers(3).elements(20, 8);
  const Layout layout = attributes(20, 8);
  for (const unsigned version : {0U, 1U}) {
    Octets stream = MeshoptEncoder(version, 8).encode(elements);
    const std::size_t tail = version == 0 ? 32 : 24;
    Octets longer = stream;
    longer.insert(longer.end() - static_cast<std::ptrdiff_t>(tail), 0);
    EXPECT_EQ(error_of(longer, layout), DecodeError::trailing) << version;
    Octets shorter = stream;
    shorter.erase(shorter.end() - static_cast<std::ptrdiff_t>(tail) - 1);
    EXPECT_EQ(error_of(shorter, layout), DecodeError::cut) << version;
    EXPECT_EQ(error_of(stream, attributes(1U << 20U, 8)), DecodeError::too_short);
  }
  EXPECT_EQ(error_of({}, layout), DecodeError::too_short);
  EXPECT_EQ(error_of({0xe1}, layout), DecodeError::header);
  EXPECT_EQ(error_of({0xa2}, layout), DecodeError::version);
  Layout older = layout;
  older.newest_version = 0;
  EXPECT_EQ(error_of(MeshoptEncoder(1, 8).encode(elements), older), DecodeError::version);
  EXPECT_EQ(error_of(MeshoptEncoder(0, 8).encode(elements), older), DecodeError::none);
}

TEST(MeshoptAttributes, WithUnknownModesOfChannelsAreRefused) {
  const Octets elements = Numbers(5).elements(20, 8);
  const Layout layout = attributes(20, 8);
  for (unsigned mode = 0; mode < 256; ++mode) {
    Octets stream = MeshoptEncoder(1, 8).encode(elements);
    stream.back() = static_cast<std::uint8_t>(mode);
    const bool known = mode < 2 || (mode & 15U) == 2;
    EXPECT_EQ(error_of(stream, layout), known ? DecodeError::none : DecodeError::channel) << mode;
  }
}

TEST(MeshoptLayouts, AreSoundOrNot) {
  const auto sound = [](std::uint64_t count, std::uint64_t stride, Mode mode, Filter filter) {
    return Layout{count, stride, mode, filter, 1}.sound();
  };
  EXPECT_TRUE(sound(1, 4, Mode::attributes, Filter::none));
  EXPECT_TRUE(sound(1, 256, Mode::attributes, Filter::exponential));
  EXPECT_FALSE(sound(0, 4, Mode::attributes, Filter::none));
  EXPECT_FALSE(sound(1, 0, Mode::attributes, Filter::none));
  EXPECT_FALSE(sound(1, 260, Mode::attributes, Filter::none));
  EXPECT_FALSE(sound(1, 6, Mode::attributes, Filter::none));
  for (const Filter filter : {Filter::octahedral, Filter::color}) {
    EXPECT_TRUE(sound(1, 4, Mode::attributes, filter));
    EXPECT_TRUE(sound(1, 8, Mode::attributes, filter));
    EXPECT_FALSE(sound(1, 12, Mode::attributes, filter));
  }
  EXPECT_TRUE(sound(1, 8, Mode::attributes, Filter::quaternion));
  EXPECT_FALSE(sound(1, 4, Mode::attributes, Filter::quaternion));
  EXPECT_TRUE(sound(3, 2, Mode::triangles, Filter::none));
  EXPECT_FALSE(sound(4, 2, Mode::triangles, Filter::none));
  EXPECT_FALSE(sound(3, 1, Mode::triangles, Filter::none));
  EXPECT_FALSE(sound(3, 4, Mode::triangles, Filter::octahedral));
  EXPECT_TRUE(sound(4, 4, Mode::indices, Filter::none));
  EXPECT_FALSE(sound(4, 8, Mode::indices, Filter::none));
}

TEST(MeshoptLayouts, CountsThatNoStreamHoldsCostNothing) {
  const std::uint64_t most = std::uint64_t{1} << 53U;
  for (const Mode mode : {Mode::attributes, Mode::triangles, Mode::indices}) {
    const unsigned char first = mode == Mode::attributes  ? 0xa1
                                : mode == Mode::triangles ? 0xe1
                                                          : 0xd1;
    Octets stream(1000);
    stream[0] = first;
    const Layout layout{most / 3 * 3, 4, mode, Filter::none, 1};
    EXPECT_EQ(model::meshopt::check_size(bytes_of(stream), layout), DecodeError::too_short);
  }
}

}  // namespace
}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
// Index streams: those of the library are read back, and those that the specification calls invalid
// are refused, also where the library takes it.
#include <cstring>

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "model/meshopt_support.hpp"

namespace gltfx::test {
namespace {

using model::meshopt::DecodeError;
using model::meshopt::Filter;
using model::meshopt::Layout;
using model::meshopt::Mode;

using Indices = std::vector<unsigned>;

Layout triangles(std::size_t count, std::size_t stride = 4) {
  return {count, stride, Mode::triangles, Filter::none, 0};
}
Layout indices(std::size_t count, std::size_t stride = 4) {
  return {count, stride, Mode::indices, Filter::none, 0};
}

Octets as_octets(const Indices& list, std::size_t stride = 4) {
  Octets octets;
  for (const unsigned index : list) {
    for (unsigned i = 0; i < stride; ++i) {
      octets.push_back(static_cast<std::uint8_t>(index >> i * 8));
    }
  }
  return octets;
}

// A grid of squares, with some triangles from anywhere.
Indices grid(unsigned size) {
  Numbers numbers(size);
  Indices list;
  for (unsigned y = 0; y < size; ++y) {
    for (unsigned x = 0; x < size; ++x) {
      const unsigned a = y * (size + 1) + x;
      for (const unsigned index : {a, a + 1, a + size + 1, a + size + 1, a + 1, a + size + 2}) {
        list.push_back(index);
      }
      if (numbers.below(5) != 0) continue;
      for (int i = 0; i < 3; ++i) list.push_back(numbers.below(60000));
    }
  }
  return list;
}

// glTF has version 1 only.
Octets triangle_stream(const Indices& list) {
  meshopt_encodeIndexVersion(1);
  Octets stream(meshopt_encodeIndexBufferBound(list.size(), 70000));
  stream.resize(meshopt_encodeIndexBuffer(stream.data(), stream.size(), list.data(), list.size()));
  return stream;
}

Octets index_stream(const Indices& list) {
  meshopt_encodeIndexVersion(1);
  Octets stream(meshopt_encodeIndexSequenceBound(list.size(), 70000));
  stream.resize(
      meshopt_encodeIndexSequence(stream.data(), stream.size(), list.data(), list.size()));
  return stream;
}

// The library's result for a stream of triangles, which may begin with another corner.
Octets library_triangles(const Octets& stream, std::size_t count, std::size_t stride) {
  Octets elements(count * stride);
  EXPECT_EQ(meshopt_decodeIndexBuffer(elements.data(), count, stride, stream.data(), stream.size()),
            0);
  return elements;
}

TEST(MeshoptTriangles, OfTheLibraryAreRead) {
  for (const unsigned size : {1U, 2U, 5U, 20U, 100U}) {
    const Indices list = grid(size);
    const Octets stream = triangle_stream(list);
    for (const std::size_t stride : {2U, 4U}) {
      EXPECT_EQ(decoded(stream, triangles(list.size(), stride)),
                (Decoded{DecodeError::none, library_triangles(stream, list.size(), stride)}));
    }
  }
}

TEST(MeshoptIndices, OfTheLibraryAreRead) {
  for (const unsigned size : {1U, 2U, 5U, 20U, 100U}) {
    const Indices list = grid(size);
    const Octets stream = index_stream(list);
    EXPECT_EQ(decoded(stream, indices(list.size())), (Decoded{DecodeError::none, as_octets(list)}));
    EXPECT_EQ(decoded(stream, indices(list.size(), 2)),
              (Decoded{DecodeError::none, as_octets(list, 2)}));
  }
}

TEST(MeshoptIndices, ThatAreCutAreRefusedAtEveryLength) {
  const Indices list = grid(6);
  for (const bool is_triangles : {true, false}) {
    const Octets stream = is_triangles ? triangle_stream(list) : index_stream(list);
    const Layout layout = is_triangles ? triangles(list.size()) : indices(list.size());
    for (std::size_t size = 0; size < stream.size(); ++size) {
      const Octets cut(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_NE(error_of(cut, layout), DecodeError::none) << size;
    }
  }
}

TEST(MeshoptIndices, SayWhatIsWrong) {
  Octets stream = index_stream({0, 1, 2});
  EXPECT_EQ(error_of(stream, indices(2)), DecodeError::trailing);
  EXPECT_EQ(error_of(stream, indices(4)), DecodeError::too_short);
  EXPECT_EQ(error_of(stream, triangles(3)), DecodeError::header);
  stream[0] = 0xd0;
  EXPECT_EQ(error_of(stream, indices(3)), DecodeError::version);
  EXPECT_EQ(error_of({0xd1, 0x80, 0, 0, 0, 0}, indices(1)), DecodeError::cut);
  EXPECT_EQ(error_of({0xd1, 0x80, 0x80, 0, 0, 0, 0}, indices(2)), DecodeError::cut);
}

TEST(MeshoptIndices, OfTwoBaselinesAndFiveBytesAreRead) {
  // Steps from the first baseline, a step back, then one from the second.
  EXPECT_EQ(decoded({0xd1, 0x04, 0x08, 0x02, 0x15, 0, 0, 0, 0}, indices(4)),
            (Decoded{DecodeError::none, as_octets({1, 3, 2, 5})}));
  EXPECT_EQ(decoded({0xd1, 0xfe, 0xff, 0xff, 0xff, 0x0f, 0, 0, 0, 0}, indices(1)),
            (Decoded{DecodeError::none, as_octets({0xc0000000U})}));
  EXPECT_EQ(error_of({0xd1, 0xff, 0xff, 0xff, 0xff, 0x8f, 0, 0, 0, 0}, indices(1)),
            DecodeError::number);
}

Octets one_triangle(std::uint8_t code, const Octets& data) {
  Octets stream{0xe1, code};
  for (const std::uint8_t byte : data) stream.push_back(byte);
  for (const int entry : {0x00, 0x76, 0x87, 0x56, 0x67, 0x78, 0xa9, 0x86, 0x65, 0x89, 0x68, 0x98,
                          0x01, 0x69, 0x00, 0x00}) {
    stream.push_back(static_cast<std::uint8_t>(entry));
  }
  return stream;
}

TEST(MeshoptTriangles, ComeInEveryForm) {
  EXPECT_EQ(decoded(one_triangle(0xf0, {}), triangles(3)),
            (Decoded{DecodeError::none, as_octets({0, 1, 2})}));
  EXPECT_EQ(decoded(one_triangle(0xfe, {0xff, 0x10, 0x03}), triangles(3)),
            (Decoded{DecodeError::none, as_octets({0, 8, 6})}));
  EXPECT_EQ(decoded(one_triangle(0xff, {0x0f, 0x14, 0x02}), triangles(3)),
            (Decoded{DecodeError::none, as_octets({10, 0, 11})}));
}

TEST(MeshoptTriangles, ThatReferToNothingAreRefused) {
  // An edge, a vertex beside a free corner and one of the table, all before there is one.
  EXPECT_EQ(error_of(one_triangle(0x00, {}), triangles(3)), DecodeError::unwritten);
  EXPECT_EQ(error_of(one_triangle(0xfe, {0x10}), triangles(3)), DecodeError::unwritten);
  EXPECT_EQ(error_of(one_triangle(0xf1, {}), triangles(3)), DecodeError::unwritten);
  EXPECT_EQ(error_of(one_triangle(0xf0, {0x00}), triangles(3)), DecodeError::trailing);
  EXPECT_EQ(error_of(one_triangle(0xfe, {}), triangles(3)), DecodeError::cut);
}

TEST(MeshoptTriangles, WithAMalformedTableAreRefused) {
  for (const std::size_t place : {0U, 5U, 13U}) {
    for (const unsigned entry : {0x0fU, 0xf0U, 0xffU}) {
      Octets stream = one_triangle(0xf0, {});
      stream[stream.size() - 16 + place] = static_cast<std::uint8_t>(entry);
      EXPECT_EQ(error_of(stream, triangles(3)), DecodeError::table);
    }
  }
  for (const std::size_t place : {14U, 15U}) {
    Octets stream = one_triangle(0xf0, {});
    stream[stream.size() - 16 + place] = 1;
    EXPECT_EQ(error_of(stream, triangles(3)), DecodeError::table);
  }
}

}  // namespace
}  // namespace gltfx::test

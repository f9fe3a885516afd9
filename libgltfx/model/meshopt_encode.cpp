// SPDX-License-Identifier: Apache-2.0
#include "model/meshopt_encode.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <mutex>

#include <meshoptimizer.h>

namespace gltfx::model::meshopt {
namespace {

static_assert(std::endian::native == std::endian::little);

using Corners = std::array<std::uint32_t, 3>;

// The library has one setting per process; the initial one depends on its version.
std::once_flag versions_set;
void set_versions() {
  std::call_once(versions_set, [] {
    meshopt_encodeVertexVersion(0);
    meshopt_encodeIndexVersion(1);
  });
}

std::vector<std::uint32_t> read_indices(std::span<const std::byte> elements, const Layout& layout) {
  std::vector<std::uint32_t> indices(static_cast<std::size_t>(layout.count));
  const auto stride = static_cast<std::size_t>(layout.stride);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    std::memcpy(&indices[i], elements.data() + i * stride, stride);
  }
  return indices;
}

std::vector<std::byte> write_stream(std::span<const std::byte> elements, const Layout& layout) {
  const auto count = static_cast<std::size_t>(layout.count);
  const auto stride = static_cast<std::size_t>(layout.stride);
  const auto bytes = [](std::vector<std::byte>& stream) {
    return reinterpret_cast<unsigned char*>(stream.data());
  };
  std::vector<std::byte> stream;
  std::size_t size = 0;
  if (layout.mode == Mode::attributes) {
    stream.resize(meshopt_encodeVertexBufferBound(count, stride));
    size = meshopt_encodeVertexBuffer(bytes(stream), stream.size(), elements.data(), count, stride);
  } else {
    const std::vector<std::uint32_t> indices = read_indices(elements, layout);
    const std::size_t vertices = std::size_t{*std::max_element(indices.begin(), indices.end())} + 1;
    const bool triangles = layout.mode == Mode::triangles;
    stream.resize(triangles ? meshopt_encodeIndexBufferBound(count, vertices)
                            : meshopt_encodeIndexSequenceBound(count, vertices));
    size = triangles
               ? meshopt_encodeIndexBuffer(bytes(stream), stream.size(), indices.data(), count)
               : meshopt_encodeIndexSequence(bytes(stream), stream.size(), indices.data(), count);
  }
  stream.resize(size);
  return stream;
}

bool same_triangles(std::span<const std::byte> a, std::span<const std::byte> b,
                    const Layout& layout) {
  const std::vector<std::uint32_t> x = read_indices(a, layout);
  const std::vector<std::uint32_t> y = read_indices(b, layout);
  for (std::size_t i = 0; i < x.size(); i += 3) {
    const Corners own{x[i], x[i + 1], x[i + 2]};
    Corners other{y[i], y[i + 1], y[i + 2]};
    for (int turn = 0; turn < 2 && own != other; ++turn) {
      std::rotate(other.begin(), other.begin() + 1, other.end());
    }
    if (own != other) return false;
  }
  return true;
}

bool comes_back(std::span<const std::byte> stream, std::span<const std::byte> elements,
                const Layout& layout) {
  std::vector<std::byte> again(elements.size());
  if (decode(stream, layout, again) != DecodeError::none) return false;
  if (layout.mode == Mode::triangles) return same_triangles(elements, again, layout);
  return std::equal(again.begin(), again.end(), elements.begin(), elements.end());
}

}  // namespace

std::optional<std::vector<std::byte>> encode(std::span<const std::byte> elements,
                                             const Layout& layout) {
  if (!layout.sound() || layout.filter != Filter::none) return std::nullopt;
  if (layout.decoded_size() != elements.size()) return std::nullopt;
  set_versions();
  std::vector<std::byte> stream = write_stream(elements, layout);
  if (!comes_back(stream, elements, layout)) return std::nullopt;
  return stream;
}

}  // namespace gltfx::model::meshopt

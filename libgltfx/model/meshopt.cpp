// SPDX-License-Identifier: Apache-2.0
// The library decodes attribute streams of version 0, because it is several times as fast. It does
// not support version 1, and accepts index streams that the specification forbids.
#include "model/meshopt.hpp"

#include <meshoptimizer.h>

#include "base/checked.hpp"

namespace gltfx::model::meshopt {
namespace {

constexpr std::uint64_t kMostStride = 256;

struct Header {
  unsigned kind, oldest, newest;
};

Header header_of(const Layout& layout) {
  if (layout.mode == Mode::attributes) return {0xa0, 0, layout.newest_version};
  return layout.mode == Mode::triangles ? Header{0xe0, 1, 1} : Header{0xd0, 1, 1};
}

Checked least_attributes(const Layout& layout, unsigned version) {
  const std::uint64_t elements = block_elements(layout.stride);
  const std::uint64_t blocks = layout.count / elements;
  const std::uint64_t rest = layout.count % elements;
  // A block of zeros still has its control bits, or two header bits per group.
  const auto least_block = [&](std::uint64_t count) {
    return version == 0 ? layout.stride * ((count + 63) / 64) : layout.stride / 4;
  };
  const Checked whole = checked_mul(blocks, least_block(elements));
  const std::uint64_t others =
      1 + (rest == 0 ? 0 : least_block(rest)) + tail_size(layout.stride, version);
  return whole ? checked_add(*whole, others) : std::nullopt;
}

Checked least_size(const Layout& layout, unsigned version) {
  if (layout.mode == Mode::attributes) return least_attributes(layout, version);
  if (layout.mode == Mode::triangles) return checked_add(layout.count / 3, 1 + 16);
  return checked_add(layout.count, 1 + 4);
}

bool library_decodes(std::span<const std::byte> stream, const Layout& layout,
                     std::span<std::byte> elements) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(stream.data());
  if (bytes[0] != 0xa0) return false;
  return meshopt_decodeVertexBuffer(elements.data(), static_cast<std::size_t>(layout.count),
                                    static_cast<std::size_t>(layout.stride), bytes,
                                    stream.size()) == 0;
}

}  // namespace

bool Layout::sound() const {
  if (count == 0) return false;
  if (mode != Mode::attributes) {
    return (stride == 2 || stride == 4) && filter == Filter::none &&
           (mode == Mode::indices || count % 3 == 0);
  }
  if (stride == 0 || stride > kMostStride || stride % 4 != 0) return false;
  if (filter == Filter::quaternion) return stride == 8;
  if (filter == Filter::octahedral || filter == Filter::color) return stride <= 8;
  return true;
}

std::optional<std::uint64_t> Layout::decoded_size() const { return checked_mul(count, stride); }

DecodeError check_size(std::span<const std::byte> stream, const Layout& layout) {
  if (stream.empty()) return DecodeError::too_short;
  const auto first = std::to_integer<unsigned>(stream.front());
  const Header header = header_of(layout);
  if ((first & 0xf0U) != header.kind) return DecodeError::header;
  const unsigned version = first & 0x0fU;
  if (version < header.oldest || version > header.newest) return DecodeError::version;
  const Checked least = least_size(layout, version);
  return least && *least <= stream.size() ? DecodeError::none : DecodeError::too_short;
}

DecodeError decode(std::span<const std::byte> stream, const Layout& layout,
                   std::span<std::byte> elements) {
  const DecodeError error = check_size(stream, layout);
  if (error != DecodeError::none) return error;
  if (layout.mode == Mode::triangles) return decode_triangles(stream, layout, elements);
  if (layout.mode == Mode::indices) return decode_indices(stream, layout, elements);
  // A stream that the library refuses is decoded again to find the reason.
  if (library_decodes(stream, layout, elements)) return DecodeError::none;
  return decode_attributes(stream, layout, elements);
}

}  // namespace gltfx::model::meshopt

// SPDX-License-Identifier: Apache-2.0
/// Streams and filters of meshoptimizer, as EXT_meshopt_compression and KHR_meshopt_compression
/// define them (appendices A and B of the latter). Safe on any bytes: nothing outside of them is
/// read, and invalid streams are refused.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace gltfx::model::meshopt {

enum class Mode : std::uint8_t { attributes, triangles, indices };
enum class Filter : std::uint8_t { none, octahedral, quaternion, exponential, color };

/// The members of a stream in the JSON text.
struct Layout {
  std::uint64_t count = 0;   ///< elements
  std::uint64_t stride = 0;  ///< bytes of one of them
  Mode mode = Mode::attributes;
  Filter filter = Filter::none;
  unsigned newest_version = 1;  ///< newest allowed version of attribute streams: 0 or 1

  /// Whether the members are consistent: a precondition of all functions below.
  bool sound() const;
  /// Bytes of all decoded elements, or nothing beyond 64 bits.
  std::optional<std::uint64_t> decoded_size() const;
};

enum class DecodeError : std::uint8_t {
  none,
  header,     ///< the first byte is not that of the mode
  version,    ///< the first byte has the right mode, but a version that is not allowed
  too_short,  ///< fewer bytes than any stream of this layout has
  cut,        ///< data ends before the last element
  channel,    ///< an unknown way to store differences
  table,      ///< the table of a triangle stream is malformed
  unwritten,  ///< a triangle refers to an edge or vertex that does not exist
  number,     ///< a number of more than five bytes
  trailing,   ///< bytes remain after the last element
};

/// Checks that the first byte is right, and that the bytes can be enough. Cheap: call it before
/// memory for the result is allocated. Gives none, header, version or too_short.
DecodeError check_size(std::span<const std::byte> stream, const Layout& layout);

/// Decodes into `elements`, which has decoded_size() bytes, without applying the filter.
/// Little-endian numbers, as in the asset. On an error the elements are undefined.
DecodeError decode(std::span<const std::byte> stream, const Layout& layout,
                   std::span<std::byte> elements);

/// Elements that a filter cannot process, because their precision is invalid.
struct Misfits {
  std::uint64_t count = 0;
  std::uint64_t first = 0;  ///< index of the first one
};
Misfits find_misfits(const Layout& layout, std::span<const std::byte> elements);

/// Applies the filter in place. Precondition: no misfits.
void apply_filter(const Layout& layout, std::span<std::byte> elements);

/// Elements of a block of an attribute stream: a multiple of 16.
constexpr std::uint64_t block_elements(std::uint64_t stride) {
  const std::uint64_t fitting = 8192 / stride / 16 * 16;
  return fitting < 256 ? fitting : 256;
}

/// Bytes after the blocks: the first element and, since version 1, the modes of its channels,
/// padded to a minimum size.
constexpr std::uint64_t tail_size(std::uint64_t stride, unsigned version) {
  const std::uint64_t size = version == 0 ? stride : stride + stride / 4;
  const std::uint64_t least = version == 0 ? 32 : 24;
  return size < least ? least : size;
}

/// Attribute streams of both versions. Precondition of all three: check_size() gives none.
DecodeError decode_attributes(std::span<const std::byte> stream, const Layout& layout,
                              std::span<std::byte> elements);
DecodeError decode_triangles(std::span<const std::byte> stream, const Layout& layout,
                             std::span<std::byte> elements);
DecodeError decode_indices(std::span<const std::byte> stream, const Layout& layout,
                           std::span<std::byte> elements);

}  // namespace gltfx::model::meshopt

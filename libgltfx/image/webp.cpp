// SPDX-License-Identifier: Apache-2.0
// WebP container (RFC 9649), its first chunk: lossy, lossless or extended.
#include "image/cursor.hpp"
#include "image/formats.hpp"

namespace gltfx::image {
namespace {

constexpr std::size_t kHeaderBytes = 30;
constexpr std::size_t kLosslessBytes = 25;

// Section 2.7.1.1 with the frame header of RFC 6386 section 9.1.
HeaderResult read_lossy(Cursor at, Header header) {
  at.skip(4);  // chunk size
  at.skip(3);  // frame tag
  if (!at.at("\x9d\x01\x2a")) header.doubt = "The WebP has no key frame where one must be.";
  at.skip(3);
  header.width = at.le16() & 0x3FFFU;  // the upper bits are a scale for display
  header.height = at.le16() & 0x3FFFU;
  header.channels = Channels::rgb;
  if (header.width == 0 || header.height == 0) header.doubt = "The WebP has no pixels.";
  return header;
}

// Section 3.4: one signature byte, then 14 bits each of width - 1 and height - 1, one bit of alpha.
HeaderResult read_lossless(Cursor at, Header header) {
  at.skip(4);
  if (at.u8() != 0x2F) header.doubt = "The lossless WebP does not begin with its signature.";
  const std::uint32_t fields = at.le32();
  header.width = (fields & 0x3FFFU) + 1;
  header.height = (fields >> 14 & 0x3FFFU) + 1;
  header.channels = (fields >> 28 & 1U) != 0 ? Channels::rgba : Channels::rgb;
  return header;
}

// Section 2.7.1: a byte of flags, three reserved, 24 bits each of width - 1 and height - 1.
HeaderResult read_extended(Cursor at, Header header) {
  at.skip(4);
  const std::uint8_t flags = at.u8();
  at.skip(3);
  header.width = at.le24() + 1;
  header.height = at.le24() + 1;
  header.channels = (flags & 0x10U) != 0 ? Channels::rgba : Channels::rgb;
  header.animated = (flags & 0x02U) != 0;
  header.icc_profile = (flags & 0x20U) != 0;
  header.exif = (flags & 0x08U) != 0;
  if (header.icc_profile) header.primaries = header.transfer = Tag::custom;
  return header;
}

}  // namespace

HeaderResult read_webp(std::span<const std::byte> bytes) {
  Header header;
  header.format = Format::webp;
  header.primaries = header.transfer = Tag::srgb;
  Cursor at(bytes);
  at.skip(12);
  Cursor content = at;
  content.skip(4);
  const bool lossless = at.at("VP8L");
  if (bytes.size() < (lossless ? kLosslessBytes : kHeaderBytes)) return unexpected_end();
  if (lossless) return read_lossless(content, header);
  if (at.at("VP8 ")) return read_lossy(content, header);
  if (at.at("VP8X")) return read_extended(content, header);
  return invalid("The WebP does not begin with a chunk that holds an image.");
}

}  // namespace gltfx::image

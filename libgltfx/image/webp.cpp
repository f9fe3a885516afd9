// SPDX-License-Identifier: Apache-2.0
// WebP container (RFC 9649), to its image data: lossy, lossless or extended. The checks cover the
// sizes of the file and of its chunks, the headers of both bitstreams, and canvas and alpha of the
// extended form against the image in it.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "image/cursor.hpp"

namespace gltfx::image {
namespace {

constexpr std::size_t kHeaderBytes = 30;
constexpr std::size_t kLosslessBytes = 25;
constexpr std::uint64_t kChunkHeaderBytes = 8;

// Section 2.7.1.1 with the frame header of RFC 6386 section 9.1. `at` is after the name.
void read_lossy(Cursor at, Header& header) {
  const std::uint32_t size = at.le32();
  const std::uint32_t frame = at.le24();
  const bool inter_frame = (frame & 1U) != 0, shown = (frame & 0x10U) != 0;
  if (inter_frame || !shown || !at.at("\x9d\x01\x2a")) {
    doubt(header, "The lossy WebP does not start with a key frame.");
  }
  if ((frame >> 1U & 7U) > 3) doubt(header, "The version of the lossy WebP is above 3.");
  if (frame >> 5U >= size)
    doubt(header, "The first partition of the WebP is larger than the image.");
  at.skip(3);
  header.width = at.le16() & 0x3FFFU;  // the upper bits are a scale for display
  header.height = at.le16() & 0x3FFFU;
  header.channels = Channels::rgb;
  if (header.width == 0 || header.height == 0)
    doubt(header, "The WebP has a width or height of 0.");
}

// Section 3.4: a signature byte, 14 bits each of width - 1 and height - 1, one bit of alpha, three
// of a version.
void read_lossless(Cursor at, Header& header) {
  at.skip(4);
  if (at.u8() != 0x2F) doubt(header, "The lossless WebP does not start with its signature.");
  const std::uint32_t fields = at.le32();
  header.width = (fields & 0x3FFFU) + 1;
  header.height = (fields >> 14 & 0x3FFFU) + 1;
  header.channels = (fields >> 28 & 1U) != 0 ? Channels::rgba : Channels::rgb;
  if (fields >> 29U != 0) doubt(header, "The version of the lossless WebP is not 0.");
}

// --- The extended form (section 2.7.1) ---

// The image that the extended header is checked against.
struct Found {
  bool image = false;
  bool whole = false;  // its chunk ends inside the file
  bool alpha_chunk = false;
  Header header;  // of the image
};

// Whether a chunk at `at`, which is moved past it, is inside the file.
bool skip_chunk(Cursor& at) {
  at.skip(4);
  const std::uint64_t size = at.le32();
  at.skip(size + (size & 1U));  // chunks are padded
  return at.ok();
}

// The image data: a still image, or the first frame of an animation, whose header is not read.
// Nothing if too many chunks precede it.
std::optional<Found> find_image(Cursor at, bool animated) {
  constexpr int kMaxChunks = 1 << 16;
  Found found;
  int chunks = 0;
  for (Cursor chunk = at; at.left() >= kChunkHeaderBytes; chunk = at) {
    Cursor content = chunk;
    content.skip(4);
    found.alpha_chunk = found.alpha_chunk || chunk.at("ALPH");
    found.image = animated ? chunk.at("ANMF") : chunk.at("VP8 ") || chunk.at("VP8L");
    if (found.image && chunk.at("VP8 ")) read_lossy(content, found.header);
    if (found.image && chunk.at("VP8L")) read_lossless(content, found.header);
    found.whole = skip_chunk(at);
    if (found.image || !found.whole) break;
    if (++chunks == kMaxChunks) return std::nullopt;
  }
  return found;
}

void check_image(const Found& found, Header& header) {
  if (!found.image) {
    return doubt(header, header.animated ? "The WebP is marked as animated, but has no frames."
                                         : "The WebP has no image data.");
  }
  if (!found.whole) return doubt(header, "The image in the WebP is larger than the file.");
  if (header.animated) return;
  const Header& image = found.header;
  if (!image.doubt.empty()) return doubt(header, image.doubt);
  if (image.width != header.width || image.height != header.height) {
    return doubt(header, fmt::format("The canvas of the WebP is {}x{}, but its image is {}x{}.",
                                     header.width, header.height, image.width, image.height));
  }
  if (!has_alpha(header.channels) && (found.alpha_chunk || has_alpha(image.channels))) {
    remark(header, "The image in the WebP has alpha, but the alpha flag is not set.", true);
  }
}

// Flags, three reserved bytes, 24 bits each of width - 1 and height - 1.
void read_extended(Cursor at, Header& header) {
  const std::uint32_t size = at.le32();
  const std::uint8_t flags = at.u8();
  const std::uint32_t reserved = at.le24();
  header.width = at.le24() + 1;
  header.height = at.le24() + 1;
  header.channels = (flags & 0x10U) != 0 ? Channels::rgba : Channels::rgb;
  header.animated = (flags & 0x02U) != 0;
  header.icc_profile = (flags & 0x20U) != 0;
  header.exif = (flags & 0x08U) != 0;
  if (header.icc_profile) header.primaries = header.transfer = Tag::custom;
  constexpr std::uint32_t kBytes = 10;
  if (size != kBytes) {
    return doubt(header,
                 fmt::format("The VP8X chunk of the WebP has {} bytes; it must have 10.", size));
  }
  if (std::uint64_t{header.width} * header.height > UINT32_MAX) {
    doubt(header, "The canvas of the WebP has more than 4294967295 pixels.");
  }
  if ((flags & 0xC1U) != 0 || reserved != 0) {
    remark(header, "The WebP has reserved bits that are not zero.", false);
  }
}

// --- The file (sections 2.3 and 2.4) ---

std::uint64_t file_size(std::span<const std::byte> bytes) {
  Cursor at(bytes);
  at.skip(4);
  return kChunkHeaderBytes + at.le32();
}

// Whether the file has as many bytes as its header and its first chunk say.
void check_sizes(std::span<const std::byte> bytes, Header& header) {
  const std::uint64_t file = file_size(bytes);
  Cursor at(bytes);
  at.skip(16);
  const std::uint64_t chunk = 12 + kChunkHeaderBytes + at.le32();
  if (file > bytes.size()) {
    doubt(header, fmt::format("The WebP is truncated: it has {} of {} bytes.", bytes.size(), file));
  } else if (chunk > file) {
    doubt(header, "The first chunk of the WebP exceeds the file size in its header.");
  } else if (file % 2 != 0) {
    remark(header, "The file size in the WebP header is odd.", false);
  }
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
  check_sizes(bytes, header);
  if (lossless) {
    read_lossless(content, header);
  } else if (at.at("VP8 ")) {
    read_lossy(content, header);
  } else if (at.at("VP8X")) {
    read_extended(content, header);
    const std::uint64_t end =
        std::clamp<std::uint64_t>(file_size(bytes), kHeaderBytes, bytes.size());
    Cursor behind(bytes.first(static_cast<std::size_t>(end)));
    behind.skip(kHeaderBytes);
    if (const auto found = find_image(behind, header.animated)) check_image(*found, header);
  } else {
    return invalid("The WebP does not start with an image chunk.");
  }
  return header;
}

}  // namespace gltfx::image

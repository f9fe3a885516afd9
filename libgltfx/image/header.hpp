// SPDX-License-Identifier: Apache-2.0
/// Headers of images: format, size, channels, colour space. Nothing is decoded; a few hundred bytes
/// are read of an image of any size.
///
/// Sources: PNG (W3C, third edition), JPEG (ITU-T T.81), WebP container (RFC 9649), AVIF 1.1 (with
/// ISO/IEC 14496-12 and 23008-12), KTX 2.0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace gltfx::image {

enum class Format : std::uint8_t { png, jpeg, webp, avif, ktx2 };

/// "image/png" and so on.
std::string_view media_type(Format format);

/// Channels as they are stored; a palette counts by its colours. KTX2 has images of R, and of R and
/// G, whose other channels are not defined.
enum class Channels : std::uint8_t { luminance, luminance_alpha, rgb, rgba, red, red_green };

/// "rgb", "luminance-alpha" and so on.
std::string_view channels_name(Channels channels);
constexpr bool has_alpha(Channels channels) {
  return channels == Channels::luminance_alpha || channels == Channels::rgba;
}

/// Primaries or transfer function as the file states them.
enum class Tag : std::uint8_t { none, srgb, linear, custom };
std::string_view tag_name(Tag tag);

/// The declarations of an image file. Colours are those of the stored form: a grey photograph
/// stored as RGB is not `grey`. Whether the declared pixels exist is not checked.
struct Header {
  Format format = Format::png;
  std::uint32_t width = 0;   ///< pixels
  std::uint32_t height = 0;  ///< pixels
  std::uint32_t bits = 8;    ///< per channel
  Channels channels = Channels::rgb;
  Tag primaries = Tag::none;  ///< `none` if the format does not define it
  Tag transfer = Tag::none;
  bool square_pixels = true;
  bool animated = false;
  bool interlaced = false;  ///< or progressive
  bool palette = false;
  bool opaque = false;     ///< there is an alpha channel, but its values can only be 1 (PNG: tRNS)
  bool grey = false;       ///< R, G and B cannot differ
  bool two_level = false;  ///< channels can hold only 0 and 1: the same in sRGB and linear
  bool icc_profile = false;
  bool exif = false;  ///< WebP: metadata of a camera
  /// A violation of the format in a header that could be read: readers refuse such an image. One
  /// sentence; else empty.
  std::string doubt;
  /// A violation that readers ignore, or a feature that few of them support. One sentence; else
  /// empty. `doubt` is more important if both are set.
  std::string remark;
  bool readers_differ = false;  ///< over the remark: some show another picture, or none
};

/// Why there is no header.
struct HeaderError {
  enum class Kind : std::uint8_t {
    unrecognized,    ///< unknown format
    unexpected_end,  ///< the image ends before its header does
    invalid,         ///< the header contradicts its format
  };
  Kind kind = Kind::unrecognized;
  std::string problem;  ///< one sentence; empty if the kind is enough
  bool cmyk = false;    ///< a JPEG of four inks, which glTF does not allow, but decoders read
};

/// Fewer bytes cannot be identified.
inline constexpr std::size_t kSniffBytes = 14;

inline std::uint64_t texels_of(const Header& header) {
  return std::uint64_t{header.width} * header.height;
}

/// The format of an image by its first bytes, which need not be complete.
struct Sniffed {
  bool known = false;
  Format format = Format::png;
};
Sniffed sniff(std::span<const std::byte> bytes);

using HeaderResult = std::variant<Header, HeaderError>;

/// Whether a texel of the image can have an alpha other than 1.
constexpr bool can_be_transparent(const Header& header) {
  return has_alpha(header.channels) && !header.opaque;
}

/// Reads the header of a PNG (to the first IDAT, and whether its end is there), JPEG (to the first
/// scan), WebP (to the image data) or AVIF (its items and their properties). KTX2 is recognised,
/// not read: see image/ktx2.hpp.
///
/// The checks are listed at the start of each format's file. Requirements of the formats that are
/// not checked, with the reason:
/// - All: compressed data and their checksums; they must be decoded, which `--pixels` does.
/// - PNG: chunks about colour, text and time, and their order; glTF ignores them.
/// - PNG: checksums of ancillary chunks; only that of tRNS matters, and few readers skip it for
/// that.
/// - PNG: tRNS values beyond the bit depth, the reserved letter of names; all readers accept them.
/// - PNG: frames of an animation; they are ignored.
/// - JPEG: EOI; it is costly to find when data follows it, as from cameras. Decoders check it.
/// - JPEG: 16-bit quantisation tables, steps of 0, table numbers of baseline, component ids that
///   repeat, restart intervals, JFIF and Adobe segments; all readers accept them.
/// - JPEG: scans after the first; they follow compressed data.
/// - WebP: flags of metadata, padding bytes, unknown chunks; readers skip them.
/// - WebP: frames of an animation; its presence is reported.
/// - AVIF: see image/avif.cpp.
/// - KTX2: see image/ktx2.hpp.
HeaderResult read_header(std::span<const std::byte> bytes);

}  // namespace gltfx::image

// SPDX-License-Identifier: Apache-2.0
/// KTX 2.0 files: header, level index, data format descriptor, metadata and supercompression, as
/// far as they can be read without decoding texels.
///
/// Sources: KTX File Format Specification 2.0, Khronos Data Format Specification 1.3.
///
/// Requirements that are not checked:
/// - the compressed data of a level, of Zstandard, ZLIB and BasisLZ: they must be decoded, which
///   `--pixels` does;
/// - formats of 4:2:2 texels and combined depth and stencil beyond typeSize, and samples of block
///   formats other than ASTC: no extension of glTF allows them;
/// - the linear flag of alpha samples in sRGB: the common encoder omits it, readers ignore it;
/// - sample positions and ranges, further flags, descriptor blocks after the first: likewise;
/// - numbers of primaries and transfer functions: the slot of a material determines them;
/// - unknown keys that begin with KTX: later versions of the format may add some;
/// - KTXcubemapIncomplete, KTXanimData: images for materials are flat, which a rule checks;
/// - KTXwriter and its parameters, UTF-8 and closing NULs of values: readers ignore them;
/// - the offset of an alpha slice that has no bytes, padding bytes that are not 0, bytes after the
///   last level: readers skip them;
/// - vkFormat values and vendors' supercompression schemes that are not in the table: they may be
///   newer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/code.hpp"
#include "image/header.hpp"

namespace gltfx::image {

/// The declared encoding of the texels.
enum class Ktx2Model : std::uint8_t { other, etc1s, uastc, astc };

enum class Ktx2Scheme : std::uint32_t { none = 0, basis_lz = 1, zstd = 2, zlib = 3 };

/// A part of a file, in bytes.
struct Ktx2Range {
  std::uint64_t offset = 0, length = 0;
  std::uint64_t end() const { return offset + length; }
};

/// One level of the pyramid, the largest first. Bytes as declared.
struct Ktx2Level {
  std::uint64_t offset = 0, length = 0, uncompressed = 0;
  /// BasisLZ: slices of the first image of the level; `second` is empty if there is one slice.
  Ktx2Range first_slice, second_slice;
};

/// BasisLZ: data that all images of the file share.
struct Ktx2Codebooks {
  std::uint16_t endpoint_count = 0, selector_count = 0;
  Ktx2Range endpoints, selectors, slice_codes;
};

struct Ktx2Error {
  Code code;
  std::string problem;     ///< one sentence
  bool tolerated = false;  ///< readers show the image, but not always as intended
};

struct Ktx2 {
  std::uint32_t vk_format = 0, type_size = 0;
  std::uint32_t width = 0, height = 0, depth = 0;  ///< texels; 0: not in this dimension
  std::uint32_t layers = 0;                        ///< 0: not an array
  std::uint32_t faces = 0, level_count = 0;
  std::uint32_t scheme = 0;  ///< a Ktx2Scheme, or an unknown number
  std::vector<Ktx2Level> levels;
  Ktx2Codebooks codebooks;

  /// Members of the basic descriptor block; `described` is false if none could be read.
  bool described = false;
  Ktx2Model model = Ktx2Model::other;
  std::uint8_t primaries = 0, transfer = 0;
  bool premultiplied = false;
  std::array<std::uint8_t, 4> block{};              ///< extent of a texel block, less one
  std::vector<std::uint8_t> channels;               ///< of each sample
  std::optional<Channels> contents;                 ///< channels of ETC1S and UASTC samples
  std::optional<std::string> orientation, swizzle;  ///< metadata, without the closing NUL

  std::vector<Ktx2Error> errors;  ///< in the order of the file

  /// Whether the image is flat, one layer of one face (specification section 4.1).
  bool is_2d() const { return height != 0 && depth == 0 && layers == 0 && faces == 1; }
  std::uint32_t full_pyramid() const;  ///< levels down to one texel
  /// Whether readers can show it: there is a descriptor, and all errors are tolerated.
  bool is_sound() const;
};

inline constexpr std::uint8_t kKtx2PrimariesBt709 = 1;
inline constexpr std::uint8_t kKtx2TransferLinear = 1;
inline constexpr std::uint8_t kKtx2TransferSrgb = 2;

/// Reads any bytes; unreadable parts are missing and named in `errors`. Takes time linear in the
/// metadata and in the number of images of all levels, both bounded by the size of the file.
Ktx2 read_ktx2(std::span<const std::byte> bytes);

/// Whether the texels can be decoded: ETC1S with BasisLZ, or UASTC with or without Zstandard. False
/// if not sound.
bool has_known_texels(const Ktx2& file);

/// Texels of a level along one axis, at least 1.
constexpr std::uint32_t level_extent(std::uint32_t extent, std::size_t level) {
  const std::uint32_t halved = level < 32 ? extent >> level : 0;
  return halved == 0 ? 1 : halved;
}

/// The header in the form of other image formats. Precondition: `described`.
Header header_of(const Ktx2& file);

}  // namespace gltfx::image

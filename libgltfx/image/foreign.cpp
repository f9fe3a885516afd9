// SPDX-License-Identifier: Apache-2.0
#include "image/foreign.hpp"

#include <array>

#include "image/header.hpp"

namespace gltfx::image {
namespace {

using namespace std::literals;

struct Mark {
  std::string_view bytes;
  ForeignFormat format;
};
constexpr std::array kMarks{
    Mark{"GIF87a"sv, ForeignFormat::gif},
    Mark{"GIF89a"sv, ForeignFormat::gif},
    Mark{"II*\0"sv, ForeignFormat::tiff},
    Mark{"MM\0*"sv, ForeignFormat::tiff},
    Mark{"II+\0"sv, ForeignFormat::tiff},
    Mark{"MM\0+"sv, ForeignFormat::tiff},
    Mark{"8BPS\0\1"sv, ForeignFormat::psd},
    Mark{"8BPS\0\2"sv, ForeignFormat::psd},
    Mark{"DDS \x7c\0\0\0"sv, ForeignFormat::dds},
    Mark{"\0\0\0\x0cjP  \r\n\x87\n"sv, ForeignFormat::jpeg2000},
    Mark{"\xff\x4f\xff\x51"sv, ForeignFormat::jpeg2000},
};

unsigned byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}
unsigned word_at(std::string_view bytes, std::size_t at) {
  return byte_at(bytes, at) | byte_at(bytes, at + 1) << 8U;
}

bool is_bmp(std::string_view bytes) {
  if (bytes.size() < 26 || !bytes.starts_with("BM")) return false;
  // The size of the second header defines its version.
  for (const unsigned size : {12U, 16U, 40U, 52U, 56U, 64U, 108U, 124U}) {
    if (word_at(bytes, 14) == size && word_at(bytes, 16) == 0) return true;
  }
  return false;
}

bool is_pnm(std::string_view bytes) {
  return bytes.size() > 3 && bytes[0] == 'P' && "123456Ff"sv.find(bytes[1]) != bytes.npos &&
         " \t\r\n#"sv.find(bytes[2]) != bytes.npos;
}

bool is_one_of(unsigned value, std::initializer_list<unsigned> values) {
  for (const unsigned each : values) {
    if (each == value) return true;
  }
  return false;
}

bool is_tga(std::string_view bytes) {
  constexpr std::size_t kHeader = 18;
  if (bytes.size() <= kHeader) return false;
  const unsigned map = byte_at(bytes, 1);
  const unsigned type = byte_at(bytes, 2);
  const unsigned kind = type & 7U;  // the value is 8 greater if packed
  if (map > 1 || !is_one_of(type, {1, 2, 3, 9, 10, 11})) return false;
  const unsigned colors = word_at(bytes, 5);
  const unsigned color_bits = byte_at(bytes, 7);
  const unsigned bits = byte_at(bytes, 16);
  if (kind == 1 && (map == 0 || colors == 0 || !is_one_of(bits, {8, 16}))) return false;
  if (kind == 2 && !is_one_of(bits, {15, 16, 24, 32})) return false;
  if (kind == 3 && !is_one_of(bits, {8, 16})) return false;
  if (map == 1 && !is_one_of(color_bits, {15, 16, 24, 32})) return false;
  const std::uint64_t texels = std::uint64_t{word_at(bytes, 12)} * word_at(bytes, 14);
  if (texels == 0 || (byte_at(bytes, 17) & 0xC0U) != 0) return false;
  std::uint64_t size = kHeader + byte_at(bytes, 0);
  if (map == 1) size += std::uint64_t{colors} * ((color_bits + 7) / 8);
  // Packed: at least two bytes for 128 texels.
  size += type == kind ? texels * ((bits + 7) / 8) : (texels + 127) / 128 * 2;
  return bytes.size() >= size;
}

}  // namespace

std::string_view foreign_name(ForeignFormat format) {
  constexpr std::array<std::string_view, 8> kNames{"BMP", "TGA", "GIF",       "TIFF",
                                                   "PSD", "DDS", "JPEG 2000", "PNM"};
  return kNames[static_cast<std::size_t>(format)];
}

std::optional<ForeignFormat> sniff_foreign(std::span<const std::byte> bytes) {
  if (sniff(bytes).known) return std::nullopt;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  for (const Mark& mark : kMarks) {
    if (text.starts_with(mark.bytes)) return mark.format;
  }
  if (is_bmp(text)) return ForeignFormat::bmp;
  if (is_pnm(text)) return ForeignFormat::pnm;
  if (is_tga(text)) return ForeignFormat::tga;
  return std::nullopt;
}

}  // namespace gltfx::image

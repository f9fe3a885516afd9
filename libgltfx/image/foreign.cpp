// SPDX-License-Identifier: Apache-2.0
#include "image/foreign.hpp"

#include <array>
#include <initializer_list>

#include "image/cursor.hpp"

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

bool is_one_of(unsigned value, std::initializer_list<unsigned> values) {
  for (const unsigned each : values) {
    if (each == value) return true;
  }
  return false;
}

bool is_bmp(Cursor file) {
  if (file.left() < 26 || !file.at("BM")) return false;
  file.skip(14);
  // The size of the second header tells which version it is.
  return is_one_of(file.le32(), {12, 16, 40, 52, 56, 64, 108, 124});
}

bool is_pnm(Cursor file) {
  if (file.left() <= 3 || !file.at("P")) return false;
  file.skip(1);
  const char kind = static_cast<char>(file.u8());
  const char separator = static_cast<char>(file.u8());
  return "123456Ff"sv.find(kind) != std::string_view::npos &&
         " \t\r\n#"sv.find(separator) != std::string_view::npos;
}

bool is_tga(Cursor file) {
  constexpr std::size_t kHeader = 18;
  const std::size_t file_size = file.left();
  if (file_size <= kHeader) return false;
  const unsigned id_size = file.u8();
  const unsigned map = file.u8();
  const unsigned type = file.u8();
  const unsigned kind = type & 7U;  // 8 more: packed
  if (map > 1 || !is_one_of(type, {1, 2, 3, 9, 10, 11})) return false;
  file.skip(2);  // the first colour
  const unsigned colors = file.le16();
  const unsigned color_bits = file.u8();
  file.skip(4);  // the origin
  const std::uint64_t width = file.le16();
  const std::uint64_t height = file.le16();
  const unsigned bits = file.u8();
  const unsigned flags = file.u8();
  if (kind == 1 && (map == 0 || colors == 0 || !is_one_of(bits, {8, 16}))) return false;
  if (kind == 2 && !is_one_of(bits, {15, 16, 24, 32})) return false;
  if (kind == 3 && !is_one_of(bits, {8, 16})) return false;
  if (map == 1 && !is_one_of(color_bits, {15, 16, 24, 32})) return false;
  const std::uint64_t texels = width * height;
  if (texels == 0 || (flags & 0xC0U) != 0) return false;
  std::uint64_t size = kHeader + id_size;
  if (map == 1) size += std::uint64_t{colors} * ((color_bits + 7) / 8);
  // Packed: at least two bytes for 128 texels.
  size += type == kind ? texels * ((bits + 7) / 8) : (texels + 127) / 128 * 2;
  return file_size >= size;
}

}  // namespace

std::string_view foreign_name(ForeignFormat format) {
  constexpr std::array<std::string_view, 8> kNames{"BMP", "TGA", "GIF",       "TIFF",
                                                   "PSD", "DDS", "JPEG 2000", "PNM"};
  return kNames[static_cast<std::size_t>(format)];
}

std::optional<ForeignFormat> sniff_foreign(std::span<const std::byte> bytes) {
  if (sniff(bytes).known) return std::nullopt;
  const Cursor file(bytes);
  for (const Mark& mark : kMarks) {
    if (file.at(mark.bytes)) return mark.format;
  }
  if (is_bmp(file)) return ForeignFormat::bmp;
  if (is_pnm(file)) return ForeignFormat::pnm;
  if (is_tga(file)) return ForeignFormat::tga;
  return std::nullopt;
}

}  // namespace gltfx::image

// SPDX-License-Identifier: Apache-2.0
// Radiance images (.hdr): a header of lines, then rows of mantissas with a common exponent, plain
// or with runs in the old or the new form.
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "image_decode.hpp"

namespace gltfx::codec {
namespace {

using Texel = std::array<std::uint8_t, 4>;

constexpr std::size_t kLeastNew = 8;  // widths that the new form of rows supports
constexpr std::size_t kMostNew = 0x7FFF;

[[noreturn]] void refuse(const char* why) { throw std::runtime_error(why); }

class Bytes {
 public:
  explicit Bytes(std::span<const std::byte> bytes)
      : rest_(reinterpret_cast<const char*>(bytes.data()), bytes.size()) {}

  std::string_view line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) refuse("Its header is truncated.");
    const std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    return text;
  }
  std::uint8_t byte() {
    if (rest_.empty()) refuse("Its data is truncated.");
    const auto value = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return value;
  }
  Texel texel() {
    Texel texel{};
    for (std::uint8_t& each : texel) each = byte();
    return texel;
  }

 private:
  std::string_view rest_;
};

std::uint32_t number(std::string_view& line, std::string_view before) {
  std::uint32_t value = 0;
  if (!line.starts_with(before)) refuse("Its rows are not in the order -Y +X.");
  line.remove_prefix(before.size());
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
  if (error != std::errc() || value == 0) refuse("Its size is invalid.");
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  return value;
}

Image read_header(Bytes& bytes) {
  if (!bytes.line().starts_with("#?")) refuse("It is not a Radiance picture.");
  bool rgbe = false;
  for (std::string_view line = bytes.line(); !line.empty(); line = bytes.line()) {
    rgbe = rgbe || line.starts_with("FORMAT=32-bit_rle_rgbe");
  }
  if (!rgbe) refuse("Its texels are not RGBE.");
  std::string_view size = bytes.line();
  Image image;
  image.height = number(size, "-Y ");
  image.width = number(size, " +X ");
  image.channels = 3;
  image.bits = 32;
  return image;
}

// Each component separately: a count above 128 is the length of a run, a lower one of a literal.
void read_new_row(Bytes& bytes, std::vector<Texel>& row) {
  for (std::size_t c = 0; c < 4; ++c) {
    for (std::size_t x = 0; x < row.size();) {
      std::size_t count = bytes.byte();
      const bool run = count > 128;
      if (run) count -= 128;
      if (count == 0 || count > row.size() - x) refuse("A run of texels is too long.");
      std::uint8_t value = run ? bytes.byte() : std::uint8_t{0};
      for (; count > 0; --count, ++x) {
        if (!run) value = bytes.byte();
        row[x][c] = value;
      }
    }
  }
}

// Whole texels: 1 1 1 n repeats the previous texel n times, and each following one n * 256 times.
void read_old_row(Bytes& bytes, std::vector<Texel>& row, Texel texel) {
  unsigned shift = 0;
  for (std::size_t x = 0; x < row.size();) {
    if (texel[0] == 1 && texel[1] == 1 && texel[2] == 1) {
      const std::size_t count = shift > 24 ? row.size() + 1 : std::size_t{texel[3]} << shift;
      if (x == 0 || count > row.size() - x) refuse("A run of texels is too long.");
      const Texel before = row[x - 1];
      for (std::size_t i = 0; i < count; ++i) row[x++] = before;
      shift += 8;
    } else {
      row[x++] = texel;
      shift = 0;
    }
    if (x < row.size()) texel = bytes.texel();
  }
}

void read_row(Bytes& bytes, std::vector<Texel>& row) {
  const Texel first = bytes.texel();
  const bool fits = row.size() >= kLeastNew && row.size() <= kMostNew;
  if (!fits || first[0] != 2 || first[1] != 2 || (first[2] & 0x80U) != 0) {
    return read_old_row(bytes, row, first);
  }
  if ((std::size_t{first[2]} << 8U | first[3]) != row.size()) refuse("A row has the wrong width.");
  read_new_row(bytes, row);
}

void convert(const std::vector<Texel>& row, std::byte* to) {
  for (const Texel& texel : row) {
    const float scale = texel[3] == 0 ? 0.0F : std::ldexp(1.0F, int{texel[3]} - 136);
    for (std::size_t c = 0; c < 3; ++c, to += sizeof scale) {
      const float value = static_cast<float>(texel[c]) * scale;
      std::memcpy(to, &value, sizeof value);
    }
  }
}

}  // namespace

Answer decode_radiance(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  Bytes input(bytes);
  const Image image = read_header(input);
  if (image.texels() > job.max_pixels) return too_many_texels();
  const std::span<std::byte> pixels = create_pixels(image, job, output);
  if (pixels.empty()) return image;
  std::vector<Texel> row(image.width);
  const std::size_t row_bytes = row.size() * 3 * sizeof(float);
  for (std::uint32_t y = 0; y < image.height; ++y) {
    read_row(input, row);
    convert(row, pixels.data() + y * row_bytes);
  }
  return image;
}

}  // namespace gltfx::codec

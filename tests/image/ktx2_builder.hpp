// SPDX-License-Identifier: Apache-2.0
/// KTX2 files built field by field, valid unless a test changes them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace gltfx::test {

/// `bytes` bytes of a number, the lowest first; beyond its own eight they are zeros.
inline std::string le(std::uint64_t value, std::size_t bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes; ++i, value >>= 8U) text += static_cast<char>(value & 0xFFU);
  return text;
}

/// The parts of a KTX2 file; by default UASTC of RGB in sRGB, 4 by 4 texels, one level.
struct Ktx2Builder {
  std::uint32_t vk_format = 0, type_size = 1;
  std::uint32_t width = 4, height = 4, depth = 0, layers = 0, faces = 1, levels = 1;
  std::uint32_t scheme = 0;
  std::uint8_t model = 166, primaries = 1, transfer = 2, flags = 0;
  std::string block{"\3\3\0\0", 4};
  std::vector<std::uint8_t> channels{0};
  std::vector<std::uint32_t> bits;  ///< of each sample; empty: one texel block each
  std::uint8_t type = 0;            ///< of all samples: 0x40 signed, 0x80 floats
  std::vector<std::pair<std::string, std::string>> metadata;

  /// ETC1S with BasisLZ.
  static Ktx2Builder etc1s(std::vector<std::uint8_t> channels = {0}) {
    Ktx2Builder builder;
    builder.scheme = 1;
    builder.model = 163;
    builder.channels = std::move(channels);
    return builder;
  }
  /// Texels that are not compressed, of a format of Vulkan: each channel has that many bits.
  static Ktx2Builder texels(std::uint32_t format, std::uint32_t type_size,
                            std::vector<std::uint8_t> channels, std::vector<std::uint32_t> bits) {
    Ktx2Builder builder;
    builder.vk_format = format;
    builder.type_size = type_size;
    builder.model = 1;
    builder.block = std::string(4, '\0');
    builder.channels = std::move(channels);
    builder.bits = std::move(bits);
    return builder.linear();
  }
  /// ASTC of 4 by 4 texels in sRGB.
  static Ktx2Builder astc() {
    Ktx2Builder builder;
    builder.vk_format = 158;
    builder.model = 162;
    return builder;
  }
  /// Linear data without primaries.
  Ktx2Builder& linear() {
    primaries = 0;
    transfer = 1;
    return *this;
  }

  std::uint32_t sample_bits(std::size_t index) const {
    return !bits.empty() ? bits[index] : model == 163 ? 64 : 128;
  }
  /// Of a texel block, all samples together.
  std::size_t block_bytes() const {
    if (channels.empty()) return 16;
    std::size_t sum = 0;
    for (std::size_t i = 0; i < channels.size(); ++i) sum += sample_bits(i);
    return std::max<std::size_t>(sum / 8, 1);
  }

  std::string descriptor() const {
    const auto size = 24 + 16 * channels.size();
    std::string text = le(size + 4, 4) + le(0, 4) + le(2, 2) + le(size, 2);
    for (const std::uint8_t field : {model, primaries, transfer, flags}) text += le(field, 1);
    text += block +
            (model == 163 ? le(8, 1) + le(channels.size() == 2 ? 8 : 0, 7) : le(block_bytes(), 8));
    std::size_t offset = 0;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      text += le(offset, 2) + le(sample_bits(i) - 1, 1) + le(channels[i] | type, 1) + le(0, 8) +
              le(0xFFFFFFFF, 4);
      offset += sample_bits(i);
    }
    return text;
  }

  std::string entries() const {
    std::string text;
    for (const auto& [key, value] : metadata) {
      std::string entry = key;
      entry += '\0';
      entry += value;
      entry += '\0';
      text += le(entry.size(), 4) + entry;
      text.resize((text.size() + 3) / 4 * 4);
    }
    return text;
  }

  std::size_t level_count() const { return std::max(levels, 1U); }

  /// One image a level: a slice of 4 bytes, and another one where there are two samples.
  std::string global() const {
    if (scheme != 1) return {};
    std::string text = le(1, 2) + le(1, 2) + le(1, 4) + le(1, 4) + le(1, 4) + le(0, 4);
    const std::uint32_t alpha = channels.size() == 2 ? 4 : 0;
    for (std::size_t i = 0; i < level_count(); ++i) {
      text += le(0, 4) + le(0, 4) + le(4, 4) + le(alpha, 4) + le(alpha, 4);
    }
    return text + "ABC";
  }

  std::string level(std::size_t index) const {
    if (scheme == 1) return std::string(4 * channels.size(), 's');
    const auto blocks = [&](std::uint32_t extent, std::size_t axis) {
      const auto size = static_cast<std::uint32_t>(block[axis]) + 1;
      return (std::max(extent >> index, 1U) + size - 1) / size;
    };
    std::string text(block_bytes() * blocks(width, 0) * blocks(height, 1), 'u');
    if (scheme == 2) text.replace(0, 4, "\x28\xb5\x2f\xfd");
    if (scheme == 3) text.replace(0, 2, "\x78\x9c");
    return text;
  }

  std::string file() const {
    const std::size_t index_end = 80 + 24 * level_count();
    std::string parts = descriptor();
    const std::size_t metadata_at = index_end + parts.size();
    const std::string entry_bytes = entries();
    parts += entry_bytes;
    const std::string global_bytes = global();
    if (scheme == 1) parts.resize((index_end + parts.size() + 7) / 8 * 8 - index_end);
    const std::size_t global_at = index_end + parts.size();
    parts += global_bytes;
    std::vector<std::string> index(level_count());
    for (std::size_t i = level_count(); i-- > 0;) {
      const std::size_t alignment = std::lcm(block_bytes(), std::size_t{4});
      if (scheme == 0) {
        parts.resize((index_end + parts.size() + alignment - 1) / alignment * alignment -
                     index_end);
      }
      const std::string bytes = level(i);
      index[i] = le(index_end + parts.size(), 8) + le(bytes.size(), 8) +
                 le(scheme == 1 ? 0 : bytes.size(), 8);
      parts += bytes;
    }
    std::string text = "\xabKTX 20\xbb\r\n\x1a\n";
    for (const std::uint32_t field :
         {vk_format, type_size, width, height, depth, layers, faces, levels, scheme}) {
      text += le(field, 4);
    }
    text += le(index_end, 4) + le(descriptor().size(), 4);
    text += le(entry_bytes.empty() ? 0 : metadata_at, 4) + le(entry_bytes.size(), 4);
    text += le(global_bytes.empty() ? 0 : global_at, 8) + le(global_bytes.size(), 8);
    for (const std::string& each : index) text += each;
    return text + parts;
  }
};

/// `file` with the bytes at `offset` replaced.
inline std::string patched(std::string file, std::size_t offset, const std::string& bytes) {
  return file.replace(offset, bytes.size(), bytes);
}

}  // namespace gltfx::test

// SPDX-License-Identifier: Apache-2.0
// Attribute streams: blocks of up to 256 elements, split into bytes. For each byte of the element
// there are differences in groups of 16, with as few bits as they need.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "model/meshopt.hpp"

namespace gltfx::model::meshopt {
namespace {

constexpr std::size_t kGroup = 16;
constexpr std::size_t kMostElements = 256;
constexpr std::size_t kChannel = 4;  // bytes of one difference

using Lane = std::array<std::uint8_t, kMostElements>;  // one byte of each element of a block
using Lanes = std::array<Lane, kChannel>;

// Bits of a difference by the two header bits of its group: version 0, then the two modes of
// version 1.
constexpr std::array<std::array<unsigned, 4>, 3> kWidths{
    {{0, 2, 4, 8}, {0, 1, 2, 4}, {1, 2, 4, 8}}};

class Reader {
 public:
  Reader(const std::byte* first, std::size_t size)
      : at_(reinterpret_cast<const std::uint8_t*>(first)), left_(size) {}

  /// The next `size` bytes, or null.
  const std::uint8_t* take(std::size_t size) {
    if (size > left_) return nullptr;
    const std::uint8_t* taken = at_;
    at_ += size;
    left_ -= size;
    return taken;
  }
  std::size_t left() const { return left_; }

 private:
  const std::uint8_t* at_;
  std::size_t left_;
};

// Differences of 1, 2 or 4 bits; one with all bits set means that a whole byte follows after them.
template <unsigned Width>
bool read_packed(Reader& reader, std::uint8_t* to) {
  constexpr unsigned kPerByte = 8 / Width;
  constexpr unsigned kSentinel = (1U << Width) - 1;
  const std::uint8_t* packed = reader.take(kGroup / kPerByte);
  if (packed == nullptr) return false;
  std::size_t sentinels = 0;
  for (unsigned i = 0; i < kGroup; ++i) {
    const unsigned place = i % kPerByte;
    // Single bits begin at the least significant end, others at the most significant one.
    const unsigned shift = Width == 1 ? place : 8 - Width * (place + 1);
    to[i] =
        static_cast<std::uint8_t>(static_cast<unsigned>(packed[i / kPerByte]) >> shift & kSentinel);
    sentinels += to[i] == kSentinel ? 1U : 0U;
  }
  const std::uint8_t* whole = reader.take(sentinels);
  if (whole == nullptr) return false;
  for (unsigned i = 0; i < kGroup && sentinels != 0; ++i) {
    if (to[i] != kSentinel) continue;
    to[i] = *whole++;
    --sentinels;
  }
  return true;
}

bool read_group(Reader& reader, unsigned width, std::uint8_t* to) {
  switch (width) {
    case 0:
      std::memset(to, 0, kGroup);
      return true;
    case 1:
      return read_packed<1>(reader, to);
    case 2:
      return read_packed<2>(reader, to);
    case 4:
      return read_packed<4>(reader, to);
    default:
      break;
  }
  const std::uint8_t* bytes = reader.take(kGroup);
  if (bytes != nullptr) std::memcpy(to, bytes, kGroup);
  return bytes != nullptr;
}

bool read_groups(Reader& reader, const std::array<unsigned, 4>& widths, std::size_t count,
                 Lane& lane) {
  const std::size_t groups = (count + kGroup - 1) / kGroup;
  const std::uint8_t* header = reader.take((groups + 3) / 4);
  if (header == nullptr) return false;
  for (std::size_t i = 0; i < groups; ++i) {
    const unsigned bits = static_cast<unsigned>(header[i / 4]) >> i % 4 * 2 & 3U;
    if (!read_group(reader, widths[bits], lane.data() + i * kGroup)) return false;
  }
  return true;
}

// Reads one byte of all elements of a block, as the two control bits of version 1 say.
bool read_controlled(Reader& reader, unsigned control, std::size_t count, Lane& lane) {
  if (control < 2) return read_groups(reader, kWidths[control + 1], count, lane);
  if (control == 2) {
    std::memset(lane.data(), 0, count);
    return true;
  }
  const std::uint8_t* bytes = reader.take(count);
  if (bytes != nullptr) std::memcpy(lane.data(), bytes, count);
  return bytes != nullptr;
}

template <typename T>
T unzigzag(T value) {
  const auto half = static_cast<T>(value >> 1U);
  return (value & 1U) != 0 ? static_cast<T>(~half) : half;
}

std::uint32_t joined(const Lanes& lanes, std::size_t i) {
  return static_cast<std::uint32_t>(lanes[0][i]) | static_cast<std::uint32_t>(lanes[1][i]) << 8U |
         static_cast<std::uint32_t>(lanes[2][i]) << 16U |
         static_cast<std::uint32_t>(lanes[3][i]) << 24U;
}

// The four bytes of an element from their differences to the previous ones, as numbers of type T.
template <typename T>
std::uint32_t add_differences(std::uint32_t before, std::uint32_t differences) {
  constexpr unsigned kBits = sizeof(T) * 8;
  std::uint32_t sum = 0;
  for (unsigned shift = 0; shift < 32; shift += kBits) {
    const auto delta = unzigzag(static_cast<T>(differences >> shift));
    sum |= static_cast<std::uint32_t>(static_cast<T>((before >> shift) + delta)) << shift;
  }
  return sum;
}

std::uint32_t next_channel(unsigned mode, std::uint32_t before, std::uint32_t differences) {
  if ((mode & 0x0fU) == 2) return before ^ std::rotr(differences, static_cast<int>(mode >> 4U));
  return mode == 1 ? add_differences<std::uint16_t>(before, differences)
                   : add_differences<std::uint8_t>(before, differences);
}

void store(std::byte* to, std::uint32_t value) {
  for (unsigned i = 0; i < kChannel; ++i) to[i] = static_cast<std::byte>(value >> i * 8);
}

std::uint32_t load(const std::byte* from) {
  std::uint32_t value = 0;
  for (unsigned i = 0; i < kChannel; ++i) {
    value |= std::to_integer<std::uint32_t>(from[i]) << i * 8;
  }
  return value;
}

class AttributeDecoder {
 public:
  AttributeDecoder(std::span<const std::byte> stream, const Layout& layout)
      : version_(std::to_integer<unsigned>(stream.front()) & 0x0fU),
        stride_(static_cast<std::size_t>(layout.stride)),
        reader_(stream.data() + 1,
                stream.size() - 1 - static_cast<std::size_t>(tail_size(layout.stride, version_))) {
    const std::size_t modes = version_ == 0 ? 0 : stride_ / kChannel;
    const std::byte* tail = stream.data() + (stream.size() - stride_ - modes);
    for (std::size_t i = 0; i < stride_ / kChannel; ++i) {
      before_[i] = load(tail + i * kChannel);
      modes_[i] = version_ == 0 ? 0 : std::to_integer<unsigned>(tail[stride_ + i]);
    }
  }

  DecodeError run(std::uint64_t count, std::byte* to) {
    for (std::size_t i = 0; i < stride_ / kChannel; ++i) {
      if (modes_[i] > 1 && (modes_[i] & 0x0fU) != 2) return DecodeError::channel;
    }
    const std::uint64_t most = block_elements(stride_);
    for (std::uint64_t first = 0; first < count; first += most) {
      const auto elements = static_cast<std::size_t>(std::min(most, count - first));
      if (!decode_block(elements, to + first * stride_)) return DecodeError::cut;
    }
    return reader_.left() == 0 ? DecodeError::none : DecodeError::trailing;
  }

 private:
  bool decode_block(std::size_t count, std::byte* to) {
    const std::uint8_t* controls = reader_.take(version_ == 0 ? 0 : stride_ / kChannel);
    if (controls == nullptr) return false;
    for (std::size_t channel = 0; channel < stride_ / kChannel; ++channel) {
      const unsigned control = version_ == 0 ? 0 : controls[channel];
      if (!read_channel(control, count)) return false;
      std::uint32_t value = before_[channel];
      for (std::size_t i = 0; i < count; ++i) {
        value = next_channel(modes_[channel], value, joined(lanes_, i));
        store(to + i * stride_ + channel * kChannel, value);
      }
      before_[channel] = value;
    }
    return true;
  }

  bool read_channel(unsigned control, std::size_t count) {
    for (unsigned i = 0; i < kChannel; ++i) {
      const bool read = version_ == 0
                            ? read_groups(reader_, kWidths[0], count, lanes_[i])
                            : read_controlled(reader_, control >> i * 2 & 3U, count, lanes_[i]);
      if (!read) return false;
    }
    return true;
  }

  unsigned version_;
  std::size_t stride_;
  Reader reader_;
  std::array<std::uint32_t, 64> before_{};  // the previous element, by channel
  std::array<unsigned, 64> modes_{};
  Lanes lanes_{};
};

}  // namespace

DecodeError decode_attributes(std::span<const std::byte> stream, const Layout& layout,
                              std::span<std::byte> elements) {
  return AttributeDecoder(stream, layout).run(layout.count, elements.data());
}

}  // namespace gltfx::model::meshopt

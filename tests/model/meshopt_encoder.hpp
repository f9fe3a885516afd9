// SPDX-License-Identifier: Apache-2.0
/// Writes attribute streams of either version, by the description in appendix A of
/// KHR_meshopt_compression: simple, and with every choice left to the test.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace gltfx::test {

using Octets = std::vector<std::uint8_t>;

class MeshoptEncoder {
 public:
  /// How the differences of each byte are stored in version 1. `fitting`: whichever is shortest.
  enum Control : unsigned { narrow = 0, wide = 1, zeros = 2, literal = 3, fitting = 4 };

  MeshoptEncoder(unsigned version, std::size_t stride) : version_(version), stride_(stride) {}

  /// The way of each channel of four bytes to take differences; all 0 otherwise.
  MeshoptEncoder& modes(Octets modes) {
    modes_ = std::move(modes);
    return *this;
  }
  MeshoptEncoder& control(Control control) {
    control_ = control;
    return *this;
  }

  /// The stream of `elements`, whose size is a multiple of the stride.
  Octets encode(const Octets& elements) {
    modes_.resize(version_ == 0 ? 0 : stride_ / 4);
    stream_ = {static_cast<std::uint8_t>(0xa0 + version_)};
    const Octets first(elements.begin(), elements.begin() + static_cast<std::ptrdiff_t>(stride_));
    const std::size_t count = elements.size() / stride_;
    const std::size_t most = std::min<std::size_t>(8192 / stride_ / 16 * 16, 256);
    before_ = first;
    for (std::size_t i = 0; i < count; i += most) {
      add_block(elements.data() + i * stride_, std::min(most, count - i));
    }
    Octets tail = first;
    tail.insert(tail.end(), modes_.begin(), modes_.end());
    const std::size_t least = version_ == 0 ? 32 : 24;
    if (tail.size() < least) stream_.resize(stream_.size() + least - tail.size());
    stream_.insert(stream_.end(), tail.begin(), tail.end());
    return stream_;
  }

 private:
  using Widths = std::array<unsigned, 4>;

  void add_block(const std::uint8_t* elements, std::size_t count) {
    std::vector<Octets> lanes(stride_, Octets(count));
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t channel = 0; channel < stride_ / 4; ++channel) {
        const std::uint32_t value = load(elements + i * stride_ + channel * 4);
        const std::uint32_t difference = differ(channel, load(&before_[channel * 4]), value);
        for (unsigned k = 0; k < 4; ++k) {
          lanes[channel * 4 + k][i] = static_cast<std::uint8_t>(difference >> k * 8);
          before_[channel * 4 + k] = static_cast<std::uint8_t>(value >> k * 8);
        }
      }
    }
    Octets controls(stride_ / 4), data;
    for (std::size_t i = 0; i < stride_; ++i) {
      const unsigned control = version_ == 0 ? 0 : choose(lanes[i]);
      controls[i / 4] = static_cast<std::uint8_t>(controls[i / 4] | control << i % 4 * 2);
      const Octets bytes = lane_bytes(lanes[i], control);
      data.insert(data.end(), bytes.begin(), bytes.end());
    }
    if (version_ != 0) stream_.insert(stream_.end(), controls.begin(), controls.end());
    stream_.insert(stream_.end(), data.begin(), data.end());
  }

  std::uint32_t differ(std::size_t channel, std::uint32_t before, std::uint32_t value) const {
    const unsigned mode = version_ == 0 ? 0 : modes_[channel];
    if ((mode & 15U) == 2) return std::rotl(value ^ before, static_cast<int>(mode >> 4U));
    std::uint32_t all = 0;
    const unsigned bits = mode == 1 ? 16 : 8;
    const std::uint32_t mask = (1U << bits) - 1;
    for (unsigned shift = 0; shift < 32; shift += bits) {
      const std::uint32_t delta = ((value >> shift) - (before >> shift)) & mask;
      const std::uint32_t doubled = delta << 1U & mask;
      all |= ((delta >> (bits - 1)) != 0 ? ~doubled & mask : doubled) << shift;
    }
    return all;
  }

  unsigned choose(const Octets& lane) const {
    const bool empty = std::all_of(lane.begin(), lane.end(), [](auto byte) { return byte == 0; });
    if (control_ != fitting) return control_ != zeros || empty ? control_ : literal;
    if (empty) return zeros;
    unsigned best = literal;
    for (const unsigned each : {0U, 1U}) {
      if (lane_bytes(lane, each).size() < lane_bytes(lane, best).size()) best = each;
    }
    return best;
  }

  Octets lane_bytes(const Octets& lane, unsigned control) const {
    if (version_ == 0) return groups(lane, {0, 2, 4, 8});
    if (control == literal) return lane;
    if (control == zeros) return {};
    return groups(lane, control == 0 ? Widths{0, 1, 2, 4} : Widths{1, 2, 4, 8});
  }

  static Octets groups(Octets lane, const Widths& widths) {
    lane.resize((lane.size() + 15) / 16 * 16);
    const std::size_t count = lane.size() / 16;
    Octets header((count + 3) / 4), data;
    for (std::size_t i = 0; i < count; ++i) {
      unsigned best = 4;
      Octets shortest;
      for (unsigned each = 0; each < 4; ++each) {
        Octets bytes;
        if (!pack(&lane[i * 16], widths[each], bytes)) continue;
        if (best == 4 || bytes.size() < shortest.size()) {
          best = each;
          shortest = bytes;
        }
      }
      header[i / 4] = static_cast<std::uint8_t>(header[i / 4] | best << i % 4 * 2);
      data.insert(data.end(), shortest.begin(), shortest.end());
    }
    header.insert(header.end(), data.begin(), data.end());
    return header;
  }

  static bool pack(const std::uint8_t* group, unsigned width, Octets& bytes) {
    if (width == 8) bytes.assign(group, group + 16);
    if (width == 0) return std::all_of(group, group + 16, [](auto byte) { return byte == 0; });
    if (width == 8) return true;
    const unsigned sentinel = (1U << width) - 1;
    const unsigned each = 8 / width;
    bytes.assign(16 / each, 0);
    for (unsigned i = 0; i < 16; ++i) {
      const unsigned value = std::min<unsigned>(group[i], sentinel);
      const unsigned place = width == 1 ? i % each : each - 1 - i % each;
      bytes[i / each] = static_cast<std::uint8_t>(bytes[i / each] | value << place * width);
    }
    for (unsigned i = 0; i < 16; ++i) {
      if (group[i] >= sentinel) bytes.push_back(group[i]);
    }
    return true;
  }

  static std::uint32_t load(const std::uint8_t* from) {
    return static_cast<std::uint32_t>(from[0]) | static_cast<std::uint32_t>(from[1]) << 8U |
           static_cast<std::uint32_t>(from[2]) << 16U | static_cast<std::uint32_t>(from[3]) << 24U;
  }

  unsigned version_;
  std::size_t stride_;
  Control control_ = fitting;
  Octets modes_, stream_, before_;
};

inline std::string text_of(const Octets& octets) {
  return {reinterpret_cast<const char*>(octets.data()), octets.size()};
}

}  // namespace gltfx::test

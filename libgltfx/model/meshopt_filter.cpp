// SPDX-License-Identifier: Apache-2.0
// Filters of attribute streams. The library has all except the one for colours; elements for which
// it would divide by zero are found before.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include <meshoptimizer.h>

#include "model/meshopt.hpp"

namespace gltfx::model::meshopt {
namespace {

template <typename T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

// 1 as a signed normalized number of `least` to 16 bits: all bits below the sign are set.
bool is_one(int value, unsigned least) {
  return value >= (1 << (least - 1)) - 1 && std::has_single_bit(static_cast<unsigned>(value) + 1);
}

template <typename T>
bool is_octahedral(const std::byte* element) {
  return is_one(load<T>(element + 2 * sizeof(T)), 2);
}

bool is_quaternion(const std::byte* element) {
  return is_one(load<std::int16_t>(element + 6) | 3, 4);
}

// Whether alpha has at least one bit below the one that gives the precision.
template <typename T>
bool is_color(const std::byte* element) {
  return load<T>(element + 3 * sizeof(T)) >= 2;
}

// Encoders write zeros with exponents below the range, which still decode to zero down to the last
// one.
bool is_exponential(const std::byte* element, std::size_t stride) {
  for (std::size_t i = 0; i < stride; i += 4) {
    const auto number = load<std::int32_t>(element + i);
    const std::int32_t exponent = number >> 24;
    const bool zero = (number & 0xffffff) == 0;
    if (exponent > 100 || exponent < (zero ? -127 : -100)) return false;
  }
  return true;
}

bool fits_filter(const Layout& layout, const std::byte* element) {
  const bool narrow = layout.stride == 4;
  switch (layout.filter) {
    case Filter::octahedral:
      return narrow ? is_octahedral<std::int8_t>(element) : is_octahedral<std::int16_t>(element);
    case Filter::quaternion:
      return is_quaternion(element);
    case Filter::exponential:
      return is_exponential(element, static_cast<std::size_t>(layout.stride));
    case Filter::color:
      return narrow ? is_color<std::uint8_t>(element) : is_color<std::uint16_t>(element);
    default:
      return true;
  }
}

// Luma, two chroma values and alpha, whose highest bit gives the number of bits of the others.
template <typename Unsigned, typename Signed>
void restore_color(std::byte* element) {
  constexpr int kMost = std::numeric_limits<Unsigned>::max();
  const int luma = load<Unsigned>(element);
  const std::int32_t orange{load<Signed>(element + sizeof(Unsigned))};
  const std::int32_t green{load<Signed>(element + 2 * sizeof(Unsigned))};
  const unsigned stored = load<Unsigned>(element + 3 * sizeof(Unsigned));
  const unsigned range = (std::bit_floor(stored) << 1U) - 1;
  const unsigned alpha = stored & range >> 1U;
  const float scale = static_cast<float>(kMost) / static_cast<float>(range);
  const int values[] = {luma + orange - green, luma + green, luma - orange - green,
                        static_cast<int>(alpha << 1U | (alpha & 1U))};
  for (const int value : values) {
    const auto scaled = static_cast<int>(std::lround(static_cast<float>(value) * scale));
    const auto restored = static_cast<Unsigned>(std::clamp(scaled, 0, kMost));
    std::memcpy(element, &restored, sizeof(Unsigned));
    element += sizeof(Unsigned);
  }
}

}  // namespace

Misfits find_misfits(const Layout& layout, std::span<const std::byte> elements) {
  Misfits misfits;
  if (layout.filter == Filter::none) return misfits;
  for (std::uint64_t i = 0; i < layout.count; ++i) {
    if (fits_filter(layout, elements.data() + i * layout.stride)) continue;
    if (misfits.count++ == 0) misfits.first = i;
  }
  return misfits;
}

void apply_filter(const Layout& layout, std::span<std::byte> elements) {
  const auto count = static_cast<std::size_t>(layout.count);
  const auto stride = static_cast<std::size_t>(layout.stride);
  switch (layout.filter) {
    case Filter::octahedral:
      return meshopt_decodeFilterOct(elements.data(), count, stride);
    case Filter::quaternion:
      return meshopt_decodeFilterQuat(elements.data(), count, stride);
    case Filter::exponential:
      return meshopt_decodeFilterExp(elements.data(), count, stride);
    case Filter::color:
      for (std::size_t i = 0; i < count; ++i) {
        std::byte* element = elements.data() + i * stride;
        stride == 4 ? restore_color<std::uint8_t, std::int8_t>(element)
                    : restore_color<std::uint16_t, std::int16_t>(element);
      }
      return;
    default:
      return;
  }
}

}  // namespace gltfx::model::meshopt

// SPDX-License-Identifier: Apache-2.0
// Plain loops without branches: with -O3, g++ and clang turn them into SSE2, and into NEON on Arm.
#include "rules/payload/element_kernels.hpp"

#include <algorithm>
#include <type_traits>

#include "base/bit_cast.hpp"

namespace gltfx::validate::kernels {
namespace {

// A 32-bit count, as wide as the compared numbers; blocks are much smaller.
using Count = std::uint32_t;

constexpr std::size_t kSums = 256;

// Flips the sign bit of integers whose order SSE2 does not support; wraps around for all others.
template <typename T>
typename Ordered<T>::Type to_ordered(T value) {
  using Key = typename Ordered<T>::Type;
  if constexpr (std::is_same_v<T, Key>) {
    return value;
  } else {
    constexpr auto kSign = static_cast<T>(T{1} << (sizeof(T) * 8 - 1));
    return static_cast<Key>(static_cast<T>(value ^ kSign));
  }
}
template <typename T>
T from_ordered(typename Ordered<T>::Type key) {
  if constexpr (std::is_same_v<T, typename Ordered<T>::Type>) {
    return key;
  } else {
    constexpr auto kSign = static_cast<T>(T{1} << (sizeof(T) * 8 - 1));
    return static_cast<T>(static_cast<T>(key) ^ kSign);
  }
}

}  // namespace

std::size_t count_non_finite(const float* values, std::size_t count) {
  constexpr std::uint32_t kExponent = 0x7f800000;
  Count errors = 0;
  for (std::size_t i = 0; i < count; ++i) {
    errors += (bit_cast<std::uint32_t>(values[i]) & kExponent) == kExponent ? 1U : 0U;
  }
  return errors;
}

std::size_t count_non_finite(const double* values, std::size_t count) {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000;
  std::uint64_t errors = 0;
  for (std::size_t i = 0; i < count; ++i) {
    errors += (bit_cast<std::uint64_t>(values[i]) & kExponent) == kExponent ? 1U : 0U;
  }
  return errors;
}

std::size_t count_unclamped(const float* values, std::size_t count) {
  Count errors = 0;
  for (std::size_t i = 0; i < count; ++i) {
    errors += (values[i] < 0.0F ? 1U : 0U) | (values[i] > 1.0F ? 1U : 0U);
  }
  return errors;
}

template <unsigned N>
UnitCount count_non_unit(const float* values, std::size_t count) {
  constexpr double kShort = (1 - kVectorTolerance) * (1 - kVectorTolerance);
  constexpr double kLong = (1 + kVectorTolerance) * (1 + kVectorTolerance);
  constexpr double kDoubt = 1e-5;  // much more than the error of three squares and sums
  constexpr auto kBadShort = static_cast<float>(kShort * (1 - kDoubt));
  constexpr auto kGoodShort = static_cast<float>(kShort * (1 + kDoubt));
  constexpr auto kGoodLong = static_cast<float>(kLong * (1 - kDoubt));
  constexpr auto kBadLong = static_cast<float>(kLong * (1 + kDoubt));
  UnitCount result;
  std::array<float, kSums> sums;
  for (std::size_t done = 0; done < count; done += kSums) {
    const std::size_t some = std::min(kSums, count - done);
    const float* at = values + done * N;
    for (std::size_t i = 0; i < some; ++i) {
      sums[i] =
          at[i * N] * at[i * N] + at[i * N + 1] * at[i * N + 1] + at[i * N + 2] * at[i * N + 2];
    }
    Count bad = 0;
    Count doubtful = 0;
    for (std::size_t i = 0; i < some; ++i) {
      bad += (sums[i] < kBadShort ? 1U : 0U) | (sums[i] > kBadLong ? 1U : 0U);
      doubtful += (sums[i] < kGoodShort ? 1U : 0U) | (sums[i] > kGoodLong ? 1U : 0U);
    }
    result.errors += bad;
    result.uncertain += doubtful - bad;
  }
  return result;
}

std::size_t count_bad_signs(const float* values, std::size_t count) {
  Count errors = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float sign = values[i * 4 + 3];
    errors += (sign != 1.0F ? 1U : 0U) & (sign != -1.0F ? 1U : 0U);
  }
  return errors;
}

template <typename T>
T greatest(const T* values, std::size_t count) {
  auto most = to_ordered(T{0});
  for (std::size_t i = 0; i < count; ++i) {
    const auto key = to_ordered(values[i]);
    most = key > most ? key : most;
  }
  return from_ordered<T>(most);
}

template <typename T>
std::size_t count_above(const T* values, std::size_t count, std::uint64_t most) {
  std::size_t errors = 0;
  for (std::size_t i = 0; i < count; ++i) errors += values[i] > most ? 1U : 0U;
  return errors;
}

template <typename T>
std::size_t count_equal(const T* values, std::size_t count, T wanted) {
  std::size_t errors = 0;
  for (std::size_t i = 0; i < count; ++i) errors += values[i] == wanted ? 1U : 0U;
  return errors;
}

// Compares whole vectors with those one and two places further on; `kFirst` and `kSecond` select
// the lanes inside a triangle. Triangles are compared one by one only if a match is found.
template <typename T>
std::size_t count_degenerate(const T* indices, std::size_t count) {
  constexpr std::size_t kStep = 48;
  constexpr std::size_t kAhead = 2;
  static constexpr auto kMasks = [] {
    std::array<std::array<T, kStep>, 2> masks{};
    for (std::size_t i = 0; i < kStep; ++i) {
      masks[0][i] = static_cast<T>(i % 3 != 2 ? ~T{0} : T{0});
      masks[1][i] = static_cast<T>(i % 3 == 0 ? ~T{0} : T{0});
    }
    return masks;
  }();
  const auto exact = [](const T* at, std::size_t length) {
    std::size_t errors = 0;
    for (std::size_t i = 0; i + 3 <= length; i += 3) {
      errors += at[i] == at[i + 1] || at[i + 1] == at[i + 2] || at[i + 2] == at[i] ? 1U : 0U;
    }
    return errors;
  };
  std::size_t errors = 0;
  std::size_t done = 0;
  for (; done + kStep + kAhead <= count; done += kStep) {
    const T* at = indices + done;
    T any = 0;
    for (std::size_t i = 0; i < kStep; ++i) {
      const T next = at[i] == at[i + 1] ? kMasks[0][i] : T{0};
      const T second = at[i] == at[i + 2] ? kMasks[1][i] : T{0};
      any = static_cast<T>(any | next | second);
    }
    if (any != 0) errors += exact(at, kStep);
  }
  return errors + exact(indices + done, count - done);
}

template <typename T>
template <unsigned Lanes, bool Greatest>
void Extremes<T>::fold(const T* values, std::size_t count) {
  std::array<Key, Lanes> best;
  std::copy_n(lanes_.begin(), Lanes, best.begin());
  std::size_t done = 0;
  for (; done + Lanes <= count; done += Lanes) {
    for (unsigned i = 0; i < Lanes; ++i) {
      const Key key = to_ordered(values[done + i]);
      best[i] = (Greatest ? key > best[i] : key < best[i]) ? key : best[i];
    }
  }
  for (unsigned i = 0; done + i < count; ++i) {
    const Key key = to_ordered(values[done + i]);
    if (Greatest ? key > best[i] : key < best[i]) best[i] = key;
  }
  std::copy_n(best.begin(), Lanes, lanes_.begin());
}

template <typename T>
void Extremes<T>::add(const T* values, std::size_t elements) {
  if (elements == 0) return;
  if (!begun_) {
    for (unsigned i = 0; i < kMostLanes; ++i) lanes_[i] = to_ordered(values[i % components_]);
    begun_ = true;
  }
  const std::size_t count = elements * components_;
  switch (components_) {
    case 3:
      return fold<24>(values, count);
    case 9:
      return fold<36>(values, count);
    case 16:
      return fold<64>(values, count);
    default:
      return fold<16>(values, count);
  }
}

template <typename T>
T Extremes<T>::of(unsigned component) const {
  Key best = lanes_[component];
  for (unsigned i = component; i < kMostLanes; i += components_) {
    if (greatest_ ? lanes_[i] > best : lanes_[i] < best) best = lanes_[i];
  }
  return from_ordered<T>(best);
}

template UnitCount count_non_unit<3>(const float*, std::size_t);
template UnitCount count_non_unit<4>(const float*, std::size_t);

template std::uint8_t greatest(const std::uint8_t*, std::size_t);
template std::uint16_t greatest(const std::uint16_t*, std::size_t);
template std::uint32_t greatest(const std::uint32_t*, std::size_t);
template std::size_t count_above(const std::uint8_t*, std::size_t, std::uint64_t);
template std::size_t count_above(const std::uint16_t*, std::size_t, std::uint64_t);
template std::size_t count_above(const std::uint32_t*, std::size_t, std::uint64_t);
template std::size_t count_equal(const std::uint8_t*, std::size_t, std::uint8_t);
template std::size_t count_equal(const std::uint16_t*, std::size_t, std::uint16_t);
template std::size_t count_equal(const std::uint32_t*, std::size_t, std::uint32_t);
template std::size_t count_degenerate(const std::uint8_t*, std::size_t);
template std::size_t count_degenerate(const std::uint16_t*, std::size_t);
template std::size_t count_degenerate(const std::uint32_t*, std::size_t);

template class Extremes<std::int8_t>;
template class Extremes<std::uint8_t>;
template class Extremes<std::int16_t>;
template class Extremes<std::uint16_t>;
template class Extremes<std::uint32_t>;
template class Extremes<std::int32_t>;
template class Extremes<std::int64_t>;
template class Extremes<std::uint64_t>;
template class Extremes<float>;
template class Extremes<double>;

}  // namespace gltfx::validate::kernels

// SPDX-License-Identifier: Apache-2.0
/// Loops over packed numbers that compilers turn into vector instructions. They return the number
/// of errors, or that a slower check is needed; they do not return places.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gltfx::validate::kernels {

/// Counts floats that are infinite or NaN.
std::size_t count_non_finite(const float* values, std::size_t count);
std::size_t count_non_finite(const double* values, std::size_t count);

/// Counts floats below 0 or above 1, without NaN.
std::size_t count_unclamped(const float* values, std::size_t count);

/// The maximum distance of lengths from 1: a little more than the largest error of 8-bit
/// components.
inline constexpr double kVectorTolerance = 0.00674;
inline constexpr double kQuaternionTolerance = 0.00769;

/// The number of vectors that are not of unit length. `uncertain` ones are too close to the
/// tolerance to be decided in single precision.
struct UnitCount {
  std::size_t errors = 0;
  std::size_t uncertain = 0;
};
/// Checks the first three components of `count` vectors of N components.
template <unsigned N>
UnitCount count_non_unit(const float* values, std::size_t count);

/// Counts vectors of four components whose last component is neither 1 nor -1.
std::size_t count_bad_signs(const float* values, std::size_t count);

template <typename T>
T greatest(const T* values, std::size_t count);
template <typename T>
std::size_t count_above(const T* values, std::size_t count, std::uint64_t most);
template <typename T>
std::size_t count_equal(const T* values, std::size_t count, T wanted);
/// Counts triangles (three indices each, without an incomplete last one) with two equal corners.
template <typename T>
std::size_t count_degenerate(const T* indices, std::size_t count);

/// A type with the order of T that vector instructions support.
template <typename T>
struct Ordered {
  using Type = T;
};
template <>
struct Ordered<std::int8_t> {
  using Type = std::uint8_t;
};
template <>
struct Ordered<std::uint16_t> {
  using Type = std::int16_t;
};
template <>
struct Ordered<std::uint32_t> {
  using Type = std::int32_t;
};

/// Smallest (or greatest) value of each component over any number of blocks. A first value that is
/// NaN stays, a later one does not count.
template <typename T>
class Extremes {
 public:
  Extremes(unsigned components, bool greatest) : components_(components), greatest_(greatest) {}
  /// Adds `elements` elements of packed components; a multiple of 16 in all calls except the last.
  void add(const T* values, std::size_t elements);
  T of(unsigned component) const;

 private:
  using Key = typename Ordered<T>::Type;
  static constexpr unsigned kMostLanes = 64;

  template <unsigned Lanes, bool Greatest>
  void fold(const T* values, std::size_t count);
  template <unsigned Lanes>
  void fold(const T* values, std::size_t count) {
    greatest_ ? fold<Lanes, true>(values, count) : fold<Lanes, false>(values, count);
  }

  unsigned components_;
  bool greatest_;
  bool begun_ = false;
  /// Several lanes per component, so that whole vectors fit and do not wait for each other.
  std::array<Key, kMostLanes> lanes_{};
};

}  // namespace gltfx::validate::kernels

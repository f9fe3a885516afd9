// SPDX-License-Identifier: Apache-2.0
/// Loops over packed numbers that compilers turn into vector instructions. They say how many errors
/// there are, or that it takes a closer look; they do not say where.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gltfx::validate::kernels {

/// Floats that are infinite or no number.
std::size_t count_non_finite(const float* values, std::size_t count);
std::size_t count_non_finite(const double* values, std::size_t count);

/// Floats below 0 or above 1. What is no number counts as neither.
std::size_t count_unclamped(const float* values, std::size_t count);

/// How much lengths may differ from 1: a little more than the largest error of 8-bit components.
inline constexpr double kVectorTolerance = 0.00674;
inline constexpr double kQuaternionTolerance = 0.00769;

/// Vectors that are not of unit length. `uncertain` ones are too near to the tolerance to be told
/// in single precision.
struct UnitCount {
  std::size_t errors = 0;
  std::size_t uncertain = 0;
};
/// The first three components of `count` vectors of N components.
template <unsigned N>
UnitCount count_non_unit(const float* values, std::size_t count);

/// Vectors of four components whose last is neither 1 nor -1.
std::size_t count_bad_signs(const float* values, std::size_t count);

template <typename T>
T greatest(const T* values, std::size_t count);
template <typename T>
std::size_t count_above(const T* values, std::size_t count, std::uint64_t most);
template <typename T>
std::size_t count_equal(const T* values, std::size_t count, T wanted);
/// Triangles (three indices each, an incomplete last one does not count) with two equal corners.
template <typename T>
std::size_t count_degenerate(const T* indices, std::size_t count);

/// A type whose order vector instructions know, and that has the order of T.
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
/// no number stays, a later one does not count.
template <typename T>
class Extremes {
 public:
  Extremes(unsigned components, bool greatest) : components_(components), greatest_(greatest) {}
  /// `elements` elements of packed components. All calls but the last have a multiple of 16.
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
  /// Several for each component, so that whole vectors fit and do not wait for each other.
  std::array<Key, kMostLanes> lanes_{};
};

}  // namespace gltfx::validate::kernels

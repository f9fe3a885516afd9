// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/decompose.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gltfx::validate {
namespace {

using Matrix = std::array<float, 16>;
using Vector = std::array<double, 3>;
using Rotation = std::array<Vector, 3>;  // columns

// Cosine of the angle between two axes above which a matrix shears for certain: half a degree.
constexpr double kShear = 0.01;
constexpr double kNormTolerance = 0.00005;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector column(const Matrix& m, std::size_t c) { return {m[4 * c], m[4 * c + 1], m[4 * c + 2]}; }

double determinant(const Rotation& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[2][1] * m[1][2]) -
         m[1][0] * (m[0][1] * m[2][2] - m[2][1] * m[0][2]) +
         m[2][0] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
}

// Largest sum of absolute values in a column.
double norm(const Rotation& m, const Matrix& whole) {
  double greatest = 0;
  for (const Vector& axis : m) {
    greatest = std::max(greatest, std::abs(axis[0]) + std::abs(axis[1]) + std::abs(axis[2]));
  }
  const double last = std::abs(double{whole[12]}) + std::abs(double{whole[13]}) +
                      std::abs(double{whole[14]}) + std::abs(double{whole[15]});
  return std::max(greatest, last);
}

// Shepperd's method: the quaternion x, y, z, w of a rotation matrix. Single precision where the
// test in use has it.
std::array<float, 4> quaternion(const Rotation& r) {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  std::array<float, 4> q{};
  if (trace > 0) {
    double s = std::sqrt(trace + 1);
    q[3] = static_cast<float>(s * 0.5);
    s = 0.5 / s;
    q[0] = static_cast<float>((r[1][2] - r[2][1]) * s);
    q[1] = static_cast<float>((r[2][0] - r[0][2]) * s);
    q[2] = static_cast<float>((r[0][1] - r[1][0]) * s);
    return q;
  }
  std::size_t i = r[0][0] < r[1][1] ? 1 : 0;
  if (r[i][i] < r[2][2]) i = 2;
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  double s = std::sqrt(r[i][i] - r[j][j] - r[k][k] + 1);
  q[i] = static_cast<float>(s * 0.5);
  s = 0.5 / s;
  q[3] = static_cast<float>((r[j][k] - r[k][j]) * s);
  q[j] = static_cast<float>((r[i][j] + r[j][i]) * s);
  q[k] = static_cast<float>((r[i][k] + r[k][i]) * s);
  return q;
}

Rotation rotation_of(const std::array<float, 4>& q) {
  const double x = q[0];
  const double y = q[1];
  const double z = q[2];
  const double w = q[3];
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
           {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
           {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}}};
}

bool shears(const Rotation& axes, const Vector& lengths) {
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    if (std::abs(dot(axes[a], axes[b])) > kShear * lengths[a] * lengths[b]) return true;
  }
  return false;
}

double rounded(double value) { return double{static_cast<float>(value)}; }

}  // namespace

std::string_view why_not_decomposable(const Matrix& matrix, bool strictly) {
  if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0 || matrix[15] != 1) {
    return "its last row is not 0, 0, 0, 1";
  }
  const Rotation axes{column(matrix, 0), column(matrix, 1), column(matrix, 2)};
  const double det = determinant(axes);
  if (det == 0) return "its determinant is 0";
  Vector lengths{};
  for (std::size_t c = 0; c < 3; ++c) lengths[c] = std::sqrt(dot(axes[c], axes[c]));
  if (strictly && shears(axes, lengths)) return "its axes are not perpendicular";
  Vector scale = lengths;
  if (det < 0) scale[0] = -scale[0];
  Rotation turned = axes;
  for (std::size_t c = 0; c < 3; ++c) {
    for (double& part : turned[c]) part = rounded(part * rounded(1 / scale[c]));
  }
  Rotation again = rotation_of(quaternion(turned));
  for (std::size_t c = 0; c < 3; ++c) {
    for (double& part : again[c]) part = rounded(rounded(part) * rounded(scale[c]));
  }
  const double change = std::abs(norm(again, matrix) - norm(axes, matrix));
  return change < kNormTolerance ? "" : "translation, rotation and scale do not reproduce it";
}

}  // namespace gltfx::validate

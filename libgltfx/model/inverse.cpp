// SPDX-License-Identifier: Apache-2.0
#include "model/inverse.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace gltfx::model {

std::optional<Affine> inverse(const Affine& of) {
  const double determinant = of.determinant();
  if (!std::isnormal(determinant)) return std::nullopt;
  const Vector3& x = of.columns[0];
  const Vector3& y = of.columns[1];
  const Vector3& z = of.columns[2];
  const std::array<Vector3, 3> rows{cross(y, z), cross(z, x), cross(x, y)};
  Affine result;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column)
      result.columns[column][row] = rows[row][column] / determinant;
  }
  const Vector3 moved = result.vector(of.columns[3]);
  result.columns[3] = {-moved[0], -moved[1], -moved[2]};
  return result;
}

}  // namespace gltfx::model

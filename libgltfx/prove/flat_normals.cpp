// SPDX-License-Identifier: Apache-2.0
#include "prove/flat_normals.hpp"

namespace gltfx::prove {

void add_flat_normals(Soup& soup) {
  const SoupStream* positions = soup.find(model::SemanticKind::position);
  if (soup.arity != 3 || positions == nullptr || positions->width != 3) return;
  const unsigned place = positions->offset;
  SoupStream normals;
  normals.name = "NORMAL";
  normals.kind = model::SemanticKind::normal;
  normals.offset = soup.width;
  normals.width = 3;
  std::vector<double> rows;
  rows.reserve(soup.corners.size() * (std::size_t{soup.width} + 3));
  for (std::size_t first = 0; first < soup.corners.size(); first += 3) {
    model::Vector3 corners[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const double* row = soup.row(soup.corners[first + k]) + place;
      corners[k] = {row[0], row[1], row[2]};
    }
    model::Vector3 edges[2]{};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 2; ++k) edges[k][i] = corners[k + 1][i] - corners[0][i];
    }
    const model::Vector3 normal = model::unit(model::cross(edges[0], edges[1]));
    for (std::size_t k = 0; k < 3; ++k) {
      const double* row = soup.row(soup.corners[first + k]);
      rows.insert(rows.end(), row, row + soup.width);
      rows.insert(rows.end(), normal.begin(), normal.end());
    }
  }
  soup.rows = std::move(rows);
  soup.width += 3;
  soup.streams.push_back(std::move(normals));
  for (std::size_t i = 0; i < soup.corners.size(); ++i) {
    soup.corners[i] = static_cast<std::uint32_t>(i);
  }
}

}  // namespace gltfx::prove

// SPDX-License-Identifier: Apache-2.0
#include "render/view.hpp"

#include <algorithm>

#include "base/packed.hpp"

namespace gltfx::render {
namespace {

// Orthonormal axes from the columns of any transform.
void orient(const Matrix34& m, View& view) {
  const Vec3d back(m[0][2], m[1][2], m[2][2]);
  const Vec3d up(m[0][1], m[1][1], m[2][1]);
  if (length(back) > 0) view.backward = normalize(back);
  Vec3d right = cross(up, view.backward);
  if (!(length(right) > 1e-9 * length(up))) {
    right =
        cross(std::fabs(view.backward.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0), view.backward);
  }
  view.right = normalize(right);
  view.up = cross(view.backward, view.right);
}

}  // namespace

Ray View::ray(double x, double y) const {
  const Vec3d across = right * ((2 * x - 1) * half_width) + up * ((1 - 2 * y) * half_height);
  if (!perspective) return {origin + across, -backward};
  return {origin, normalize(across - backward)};
}

View view_of(const Camera& camera, double aspect) {
  View view;
  const Matrix34& m = camera.to_world;
  view.origin = {m[0][3], m[1][3], m[2][3]};
  orient(m, view);
  view.perspective = camera.perspective;
  if (camera.perspective) {
    // A narrower picture shows more above and below instead of less at the sides.
    const double own = camera.aspect_ratio > 0 ? static_cast<double>(camera.aspect_ratio) : aspect;
    view.half_height = std::tan(std::clamp(static_cast<double>(camera.yfov), 1e-3, 3.1) / 2) *
                       std::max(1.0, own / aspect);
    view.half_width = view.half_height * aspect;
    return view;
  }
  const double xmag = std::fabs(static_cast<double>(camera.xmag));
  const double ymag = std::fabs(static_cast<double>(camera.ymag));
  view.half_height = std::max(ymag, xmag / aspect);
  view.half_width = view.half_height * aspect;
  return view;
}

}  // namespace gltfx::render

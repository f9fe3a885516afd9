// SPDX-License-Identifier: Apache-2.0
#include "model/camera.hpp"

#include <cmath>

namespace gltfx::model {
namespace {

constexpr float kPi = 3.14159265F;

bool read_perspective(const Properties& from, Camera& camera) {
  camera.y_fov = from.number("yfov", 0);
  camera.aspect_ratio = from.number("aspectRatio", 0, kPositiveLimits);
  return camera.y_fov > 0 && camera.y_fov < kPi;
}

// Negative magnifications mirror the picture, which is not intended.
bool read_orthographic(const Properties& from, Camera& camera) {
  camera.perspective = false;
  camera.x_mag = std::abs(from.number("xmag", 0));
  camera.y_mag = std::abs(from.number("ymag", 0));
  return camera.x_mag > 0 && camera.y_mag > 0;
}

}  // namespace

std::optional<Camera> read_camera(const Asset& asset, std::uint32_t index,
                                  const AnimatedValues* animated) {
  const Properties from(asset.document(), asset.elements(RootArray::cameras)[index], animated,
                        "/cameras/" + std::to_string(index));
  const Properties perspective = from.object("perspective");
  const Properties orthographic = from.object("orthographic");
  Camera camera;
  camera.name = asset.name(from.node());
  const bool complete = perspective.exists() ? read_perspective(perspective, camera)
                                             : read_orthographic(orthographic, camera);
  const Properties& projection = perspective.exists() ? perspective : orthographic;
  camera.z_near = projection.number("znear", 0, kPositiveLimits);
  camera.z_far = projection.number("zfar", camera.z_far, kPositiveLimits);
  return complete ? std::optional(camera) : std::nullopt;
}

}  // namespace gltfx::model

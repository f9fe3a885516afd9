// SPDX-License-Identifier: Apache-2.0
#include "bake/environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bake/storage.hpp"

namespace gltfx::bake {
namespace {

constexpr double kPi = std::numbers::pi;

// A column may lie one beside the image, on whose other side it goes on; a row as well, where the
// outermost counts.
Rgb texel(const EnvironmentImage& image, std::int64_t column, std::int64_t row) {
  const auto width = static_cast<std::int64_t>(image.width);
  const auto height = static_cast<std::int64_t>(image.height);
  const std::int64_t x = column < 0 ? column + width : column >= width ? column - width : column;
  const std::int64_t y = std::clamp<std::int64_t>(row, 0, height - 1);
  return to_vec(image.radiance[static_cast<std::size_t>(y * width + x)]);
}

// The integral over each texel of the brightness that is read between texels: of linear
// interpolation the texel itself counts 6/8, its neighbours 1/8 along each axis. So whatever is not
// black is sampled.
std::vector<float> weights_of(const EnvironmentImage& image) {
  const auto width = static_cast<std::int64_t>(image.width);
  const auto height = static_cast<std::int64_t>(image.height);
  std::vector<float> weights;
  weights.reserve(image.radiance.size());
  for (std::int64_t y = 0; y < height; ++y) {
    const double ring =
        std::sin(kPi * (static_cast<double>(y) + 0.5) / static_cast<double>(height));
    for (std::int64_t x = 0; x < width; ++x) {
      double sum = 0;
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
          const double share = (dx == 0 ? 0.75 : 0.125) * (dy == 0 ? 0.75 : 0.125);
          sum += share * luminance(texel(image, x + dx, y + dy));
        }
      }
      weights.push_back(static_cast<float>(sum * ring));
    }
  }
  return weights;
}

// `down`: from the upper edge.
Vec3d direction_at(const Float2& point, const Turn& down) {
  const Turn around = turn_by(static_cast<double>(point[0]) - 0.5);  // from -z to +x
  return {down.sine * around.sine, down.cosine, -down.sine * around.cosine};
}

}  // namespace

Vec3d direction_of(const Float2& point) {
  return direction_at(point, turn_by(static_cast<double>(point[1]) / 2));
}

Float2 point_of(const Vec3d& direction) {
  const double turn = std::atan2(direction.x, -direction.z);
  return {static_cast<float>(turn / (2 * kPi) + 0.5),
          static_cast<float>(std::acos(std::clamp(direction.y, -1.0, 1.0)) / kPi)};
}

Environment::Environment(EnvironmentImage image)
    : image_(std::move(image)), distribution_(image_.width, weights_of(image_)) {}

Rgb Environment::radiance_at(const Float2& point) const {
  const double x = static_cast<double>(point[0]) * image_.width - 0.5;
  const double y = static_cast<double>(point[1]) * image_.height - 0.5;
  const std::int64_t left = floor_of(x);
  const std::int64_t top = floor_of(y);
  const double fx = x - static_cast<double>(left);
  const double fy = y - static_cast<double>(top);
  const Rgb upper = texel(image_, left, top) * (1 - fx) + texel(image_, left + 1, top) * fx;
  const Rgb lower = texel(image_, left, top + 1) * (1 - fx) + texel(image_, left + 1, top + 1) * fx;
  return upper * (1 - fy) + lower * fy;
}

EnvironmentLook Environment::look(const Vec3d& direction) const {
  const Float2 point = point_of(direction);
  const double ring = std::sqrt(std::max(0.0, 1 - direction.y * direction.y));
  const double area = 2 * kPi * kPi * ring;
  return {radiance_at(point), area > 0 ? distribution_.density(point) / area : 0.0};
}

EnvironmentSample Environment::sample(const Float2& random) const {
  EnvironmentSample sample;
  sample.point = distribution_.sample(random);
  const Turn down = turn_by(static_cast<double>(sample.point[1]) / 2);
  sample.direction = direction_at(sample.point, down);
  if (down.sine > 0) {
    sample.pdf = distribution_.density(sample.point) / (2 * kPi * kPi * down.sine);
  }
  return sample;
}

}  // namespace gltfx::bake

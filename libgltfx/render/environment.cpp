// SPDX-License-Identifier: Apache-2.0
#include "render/environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/packed.hpp"
#include "shader/sin_cos.hpp"

namespace gltfx::render {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kAlike = 2;  // ratio of brightness up to which texels are sampled alike

// A column outside of the image wraps around; a row outside is clamped.
const Float3& texel(const EnvironmentImage& image, std::int64_t column, std::int64_t row) {
  const auto width = static_cast<std::int64_t>(image.width);
  const auto height = static_cast<std::int64_t>(image.height);
  const std::int64_t x = column < 0 ? column + width : column >= width ? column - width : column;
  const std::int64_t y = std::clamp<std::int64_t>(row, 0, height - 1);
  return image.radiance[static_cast<std::size_t>(y * width + x)];
}

// The integral of the interpolated brightness over each texel: the texel itself counts 6/8, its
// neighbours 1/8 along each axis. So every point that is not black is sampled.
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
          sum += share * luminance(to_vec(texel(image, x + dx, y + dy)));
        }
      }
      weights.push_back(static_cast<float>(sum * ring));
    }
  }
  return weights;
}

// The texels with a border of one texel.
std::vector<Float3> with_border(const EnvironmentImage& image) {
  const std::int64_t width = image.width;
  const std::int64_t height = image.height;
  std::vector<Float3> texels;
  texels.reserve(static_cast<std::size_t>((width + 2) * (height + 2)));
  for (std::int64_t y = -1; y <= height; ++y) {
    for (std::int64_t x = -1; x <= width; ++x) texels.push_back(texel(image, x, y));
  }
  return texels;
}

// `down`: of the angle from the upper edge.
Vec3d direction_at(const Float2& point, const shader::SinCos& down) {
  const shader::SinCos around =
      shader::sin_cos_of(static_cast<double>(point[0]) - 0.5);  // from -z to +x
  return {down.sine * around.sine, down.cosine, -down.sine * around.cosine};
}

}  // namespace

Vec3d direction_of(const Float2& point) {
  return direction_at(point, shader::sin_cos_of(static_cast<double>(point[1]) / 2));
}

Float2 point_of(const Vec3d& direction) {
  const double ring = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  return {static_cast<float>(shader::turn_of(direction.x, -direction.z) + 0.5),
          static_cast<float>(shader::turn_of(ring, direction.y) * 2)};
}

Environment::Environment(const EnvironmentImage& image)
    : width_(image.width),
      height_(image.height),
      texels_(with_border(image)),
      distribution_(image.width, weights_of(image), kAlike) {}

Rgb Environment::radiance_at(const Float2& point) const {
  const auto place = [](float coordinate, std::uint32_t size) {  // 0.5 in the middle of the border
    const auto count = static_cast<float>(size);
    return std::min(std::max(0.5F, coordinate * count + 0.5F), count + 0.5F);
  };
  const float x = place(point[0], width_);
  const float y = place(point[1], height_);
  const auto left = static_cast<std::int32_t>(x);
  const auto top = static_cast<std::int32_t>(y);
  const float fx = x - static_cast<float>(left);
  const float fy = y - static_cast<float>(top);
  const std::size_t pitch = std::size_t{width_} + 2;
  const Float3* upper =
      texels_.data() + static_cast<std::size_t>(top) * pitch + static_cast<std::size_t>(left);
  const Float3* lower = upper + pitch;
  Float3 sum{};
  for (std::size_t c = 0; c < 3; ++c) {
    const float above = upper[0][c] + (upper[1][c] - upper[0][c]) * fx;
    const float below = lower[0][c] + (lower[1][c] - lower[0][c]) * fx;
    sum[c] = above + (below - above) * fy;
  }
  return to_vec(sum);
}

EnvironmentValue Environment::evaluate(const Vec3d& direction) const {
  const Float2 point = point_of(direction);
  const double ring = std::sqrt(std::max(0.0, 1 - direction.y * direction.y));
  const double area = 2 * kPi * kPi * ring;
  return {radiance_at(point), area > 0 ? distribution_.density(point) / area : 0.0};
}

EnvironmentSample Environment::sample(const Float2& random) const {
  const auto [point, density] = distribution_.sample(random);
  const shader::SinCos down = shader::sin_cos_of(static_cast<double>(point[1]) / 2);
  const double area = 2 * kPi * kPi * down.sine;
  if (!(area > 0 && density > 0)) return {};
  const double pdf = density / area;
  return {direction_at(point, down), radiance_at(point), pdf, 1 / pdf};
}

}  // namespace gltfx::render

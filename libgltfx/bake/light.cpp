// SPDX-License-Identifier: Apache-2.0
#include "bake/light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/storage.hpp"

namespace gltfx::bake {
namespace {

// The window that the extension recommends: 1 near the light, 0 at its range.
double range_window(double distance, double range) {
  if (range <= 0) return 1;
  const double ratio = distance / range;
  return std::clamp(1 - ratio * ratio * ratio * ratio, 0.0, 1.0);
}

// The falloff between the cones of a spot light.
double cone_window(const Light& light, const Vec3d& from_light) {
  const double outer = std::cos(static_cast<double>(light.outer_cone));
  const double inner = std::cos(static_cast<double>(light.inner_cone));
  const double cosine = dot(to_vec(light.direction), from_light);
  const double window = std::clamp((cosine - outer) / std::max(0.001, inner - outer), 0.0, 1.0);
  return window * window;
}

}  // namespace

Illumination illuminate(const Light& light, const Vec3d& point) {
  if (light.kind == Light::Kind::directional) {
    return {-to_vec(light.direction), std::numeric_limits<double>::infinity(),
            to_vec(light.intensity)};
  }
  const Vec3d offset = to_vec(light.position) - point;
  const double distance = length(offset);
  if (!(distance > 0)) return {};
  Illumination result{offset / distance, distance, {}};
  double share = range_window(distance, light.range) / (distance * distance);
  if (light.kind == Light::Kind::spot) share *= cone_window(light, -result.direction);
  if (std::isfinite(share)) result.irradiance = to_vec(light.intensity) * share;
  return result;
}

// Two loops instead of a table: lights are few, and each point would need its own table.
LightChoice choose_light(std::span<const Light> lights, const Vec3d& point, const Float2& random) {
  constexpr std::size_t kMost = 64;
  const std::size_t count = std::min(lights.size(), kMost);
  const double step = static_cast<double>(lights.size()) / static_cast<double>(count);
  const auto candidate = [&](std::size_t i) {
    const double at = (static_cast<double>(i) + static_cast<double>(random[1])) * step;
    const std::size_t index = count == lights.size() ? i : static_cast<std::size_t>(at);
    return illuminate(lights[std::min(index, lights.size() - 1)], point);
  };
  double total = 0;
  for (std::size_t i = 0; i < count; ++i) total += luminance(candidate(i).irradiance);
  if (!(total > 0) || !std::isfinite(total)) return {};
  double left = static_cast<double>(random[0]) * total;
  LightChoice choice;
  for (std::size_t i = 0; i < count && left >= 0; ++i) {
    const Illumination each = candidate(i);
    const double weight = luminance(each.irradiance);
    if (weight <= 0) continue;
    choice = {each, weight / (total * step)};
    left -= weight;
  }
  return choice;
}

}  // namespace gltfx::bake

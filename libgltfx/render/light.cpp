// SPDX-License-Identifier: Apache-2.0
#include "render/light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/packed.hpp"
#include "render/material_at.hpp"
#include "render/surface.hpp"
#include "render/transform.hpp"
#include "shader/material.hpp"

namespace gltfx::render {
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

constexpr std::size_t kRow = 256;  // of the grid of triangles
constexpr std::size_t kMostTriangles = 1U << 20U;

struct Corners {
  Vec3d a, b, c;
  Vec3d normal() const { return cross(b - a, c - a); }  // twice the area long
};

Corners corners_of(const Instance& each, const Mesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const auto point = [&](std::uint32_t vertex) {
    return transform_point(each.to_world, to_vec(mesh.positions[vertex]));
  };
  return {point(a), point(b), point(c)};
}

// The emission of a triangle, as the mean at its middle and at three points near its corners; at
// most that of the factor.
double brightness(const Scene& scene, const Mesh& mesh, const SceneMaterial& material, Hit hit) {
  if (material.use(Slot::emissive).texture == kNone) return luminance(material.factors.emissive);
  constexpr std::array<Float2, 4> kProbes{
      {{1.0F / 3, 1.0F / 3}, {0.1F, 0.1F}, {0.8F, 0.1F}, {0.1F, 0.8F}}};
  double sum = 0;
  for (const Float2& look : kProbes) {
    hit.u = look[0];
    hit.v = look[1];
    sum += luminance(material_at({scene, mesh, material, hit}).emissive);
  }
  return sum / kProbes.size();
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

bool is_emissive(const SceneMaterial& material) {
  return !material.factors.unlit && max_value(material.factors.emissive) > 0;
}

Emitters::Emitters(const Scene& scene, double dim) {
  std::map<std::uint32_t, std::vector<float>> shining;  // by mesh: emission of its triangles
  for (std::uint32_t i = 0; i < scene.meshes.size(); ++i) {
    const Mesh& mesh = scene.meshes[i];
    const SceneMaterial& material = material_of(scene, mesh);
    if (!is_emissive(material) || luminance(material.factors.emissive) <= dim) continue;
    std::vector<float>& each = shining[i];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const double light = brightness(scene, mesh, material, {0, 0, i, t, 0, 0});
      each.push_back(light > dim ? static_cast<float>(light) : 0.0F);
    }
  }
  std::vector<float> weights;
  for (std::uint32_t i = 0; i < scene.instances.size() && !shining.empty(); ++i) {
    const Instance& instance = scene.instances[i];
    const auto end = shining.lower_bound(instance.mesh + instance.count);
    for (auto each = shining.lower_bound(instance.mesh); each != end; ++each) {
      if (areas_.size() + each->second.size() > kMostTriangles) break;
      add(scene, i, each->first, each->second, weights);
    }
  }
  const float most = weights.empty() ? 0 : *std::max_element(weights.begin(), weights.end());
  if (!(most > 0)) {
    shapes_.clear();
    return;
  }
  for (float& weight : weights) weight /= most;
  weights.resize((weights.size() + kRow - 1) / kRow * kRow);
  choice_ = PiecewiseConstant2d(kRow, weights);
}

void Emitters::add(const Scene& scene, std::uint32_t instance, std::uint32_t mesh,
                   const std::vector<float>& brightness, std::vector<float>& weights) {
  shapes_.push_back({instance, mesh, areas_.size()});
  for (std::size_t t = 0; t < brightness.size(); ++t) {
    const Corners corners = corners_of(scene.instances[instance], scene.meshes[mesh], t);
    const double area = length(corners.normal()) / 2;
    const double power = area * static_cast<double>(brightness[t]);
    areas_.push_back(static_cast<float>(area));
    weights.push_back(std::isfinite(power) ? static_cast<float>(power) : 0.0F);
  }
}

EmissiveTriangle Emitters::sample(const Scene& scene, const Vec3d& from,
                                  const Float2& random) const {
  const Float2 point = choice_.sample(random).point;
  const std::size_t rows = (areas_.size() + kRow - 1) / kRow;
  const float x = point[0] * kRow;
  const float y = point[1] * static_cast<float>(rows);
  const std::size_t column = std::min(static_cast<std::size_t>(x), kRow - 1);
  const std::size_t row = std::min(static_cast<std::size_t>(y), rows - 1);
  const std::size_t number = std::min(row * kRow + column, areas_.size() - 1);
  const auto after =
      std::upper_bound(shapes_.begin(), shapes_.end(), number,
                       [](std::size_t value, const Shape& shape) { return value < shape.first; });
  const Shape& shape = *(after - 1);

  Hit hit{0, shape.instance, shape.mesh, static_cast<std::uint32_t>(number - shape.first), 0, 0};
  const float root = std::sqrt(std::clamp(x - static_cast<float>(column), 0.0F, 1.0F));
  hit.u = 1 - root;
  hit.v = std::clamp(y - static_cast<float>(row), 0.0F, 1.0F) * root;
  const Instance& instance = scene.instances[hit.instance];
  const Mesh& mesh = scene.meshes[hit.mesh];
  const Corners corners = corners_of(instance, mesh, hit.triangle);
  EmissiveTriangle lit;
  lit.position = corners.a + (corners.b - corners.a) * static_cast<double>(hit.u) +
                 (corners.c - corners.a) * static_cast<double>(hit.v);
  const Vec3d offset = lit.position - from;
  hit.distance = length(offset);
  if (!(hit.distance > 0)) return {};
  lit.direction = offset / hit.distance;

  const SceneMaterial& material = material_of(scene, mesh);
  const double mirrored = determinant(instance.to_world) < 0 ? -1 : 1;
  const double along = dot(corners.normal(), lit.direction) * mirrored;
  if (is_culled(material) && along > 0) return {};
  const double area = 2 * static_cast<double>(areas_[number]);
  lit.normal = corners.normal() * (along > 0 ? -mirrored : mirrored) / area;
  lit.pdf = pdf(hit, std::fabs(along) / area);
  if (!(lit.pdf > 0)) return {};
  const Surface surface = surface_at(scene, hit, {from, lit.direction});
  const double covered =
      has_holes(material) ? static_cast<double>(coverage_at(scene, mesh, material, hit)) : 1.0;
  lit.radiance = emitted(surface.material, surface.frame.to_local(-lit.direction)) * covered;
  return lit;
}

double Emitters::density(std::size_t number) const {
  const std::size_t rows = (areas_.size() + kRow - 1) / kRow;
  const std::size_t row = number / kRow;
  const Float2 point{(static_cast<float>(number % kRow) + 0.5F) / kRow,
                     (static_cast<float>(row) + 0.5F) / static_cast<float>(rows)};
  return choice_.density(point) / static_cast<double>(rows * kRow);
}

double Emitters::pdf(const Hit& hit, double cosine) const {
  const std::uint64_t body = hit.body();
  const auto shape = std::lower_bound(
      shapes_.begin(), shapes_.end(), body, [](const Shape& each, std::uint64_t wanted) {
        return (std::uint64_t{each.instance} << 32U | each.mesh) < wanted;
      });
  if (shape == shapes_.end() || shape->instance != hit.instance || shape->mesh != hit.mesh) {
    return 0;
  }
  const std::size_t number = shape->first + hit.triangle;
  const double seen = static_cast<double>(areas_[number]) * cosine;
  if (!(seen > 0)) return 0;
  return density(number) * hit.distance * hit.distance / seen;
}

}  // namespace gltfx::render

// SPDX-License-Identifier: Apache-2.0
#include "preview/markers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/packed.hpp"
#include "render/surface.hpp"
#include "render/transform.hpp"

namespace gltfx::preview {
namespace {

using MarkerCorners = std::array<std::uint32_t, 3>;

// A hexagon, counter-clockwise.
constexpr std::array<MarkerCorners, 4> kDisc{{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}};
// Corners: +x, -x, +y, -y, +z, -z.
constexpr std::array<MarkerCorners, 8> kOctahedron{
    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
// Three corners around the first end, three around the second.
constexpr std::array<MarkerCorners, 6> kTube{
    {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}, {2, 0, 5}, {0, 3, 5}}};
constexpr std::array<Vec3d, 6> kAxes{Vec3d(1, 0, 0),  Vec3d(-1, 0, 0), Vec3d(0, 1, 0),
                                     Vec3d(0, -1, 0), Vec3d(0, 0, 1),  Vec3d(0, 0, -1)};

// On a circle around the normal of a frame: part `i` of `count`.
Vec3d around(const render::Frame& frame, int i, int count) {
  const double angle = 2 * std::numbers::pi * i / count;
  return frame.to_world({std::cos(angle), std::sin(angle), 0});
}

class MarkerMesh {
 public:
  explicit MarkerMesh(const render::Mesh& vertices) : from_(vertices) {
    mesh_.material = vertices.material;
    mesh_.unlit = vertices.normals.empty();
    mesh_.uvs.resize(vertices.uvs.size());
  }

  void add_vertex(std::uint32_t vertex, const Vec3d& direction) {
    mesh_.positions.push_back(from_.positions[vertex]);
    mesh_.marker_directions.push_back(to_float3(direction));
    if (!from_.normals.empty()) mesh_.normals.push_back(from_.normals[vertex]);
    if (!from_.colors.empty()) mesh_.colors.push_back(from_.colors[vertex]);
    for (std::size_t set = 0; set < mesh_.uvs.size(); ++set) {
      if (!from_.uvs[set].empty()) mesh_.uvs[set].push_back(from_.uvs[set][vertex]);
    }
  }

  // Of the last six vertices.
  void add_triangles(std::span<const MarkerCorners> triangles) {
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size()) - 6;
    for (const MarkerCorners& each : triangles) {
      mesh_.triangles.push_back({first + each[0], first + each[1], first + each[2]});
    }
  }

  render::Mesh take() { return std::move(mesh_); }

 private:
  const render::Mesh& from_;
  render::Mesh mesh_;
};

std::size_t step_over(std::size_t count) { return count / (kMostMarkers + 1) + 1; }

}  // namespace

std::size_t marker_bytes(const render::Mesh& vertices) {
  std::size_t vertex = 2 * sizeof(Float3);
  if (!vertices.normals.empty()) vertex += sizeof(Float3);
  if (!vertices.colors.empty()) vertex += sizeof(Float4);
  vertex += vertices.uvs.size() * sizeof(Float2);
  return 6 * vertex + kOctahedron.size() * sizeof(MarkerCorners);
}

render::Mesh point_markers(const render::Mesh& vertices, std::span<const std::uint32_t> points) {
  MarkerMesh markers(vertices);
  const std::size_t step = step_over(points.size());
  for (std::size_t i = 0; i < points.size(); i += step) {
    const Vec3d normal = vertices.normals.empty() ? Vec3d() : to_vec(vertices.normals[points[i]]);
    if (length(normal) > 0) {
      const render::Frame frame = render::frame_around(normalize(normal));
      for (int corner = 0; corner < 6; ++corner) {
        markers.add_vertex(points[i], around(frame, corner, 6));
      }
      markers.add_triangles(kDisc);
    } else {
      for (const Vec3d& axis : kAxes) markers.add_vertex(points[i], axis);
      markers.add_triangles(kOctahedron);
    }
  }
  return markers.take();
}

render::Mesh line_markers(const render::Mesh& vertices,
                          std::span<const std::array<std::uint32_t, 2>> segments) {
  MarkerMesh markers(vertices);
  const std::size_t step = step_over(segments.size());
  for (std::size_t i = 0; i < segments.size(); i += step) {
    const auto [first, second] = segments[i];
    const Vec3d along = to_vec(vertices.positions[second]) - to_vec(vertices.positions[first]);
    const double norm = length(along);
    const bool is_line = norm > 0 && std::isfinite(norm);
    const render::Frame frame = render::frame_around(is_line ? along / norm : Vec3d(0, 1, 0));
    for (const std::uint32_t end : segments[i]) {
      for (int corner = 0; corner < 3; ++corner) markers.add_vertex(end, around(frame, corner, 3));
    }
    markers.add_triangles(kTube);
  }
  return markers.take();
}

bool has_markers(const render::Scene& scene) {
  return std::any_of(scene.meshes.begin(), scene.meshes.end(),
                     [](const render::Mesh& mesh) { return !mesh.marker_directions.empty(); });
}

void give_markers_size(render::Scene& scene, double radius) {
  for (const render::Instance& instance : scene.instances) {
    const double scale = std::cbrt(std::fabs(render::determinant(instance.to_world)));
    const double own = scale > 0 && std::isfinite(scale) ? radius / scale : radius;
    for (std::uint32_t i = instance.mesh; i < instance.mesh + instance.count; ++i) {
      render::Mesh& mesh = scene.meshes[i];
      if (mesh.marker_directions.empty()) continue;
      const SharedArray<Float3> directions = std::move(mesh.marker_directions);
      for (std::size_t v = 0; v < directions.size(); ++v) {
        mesh.positions[v] = to_float3(to_vec(mesh.positions[v]) + to_vec(directions[v]) * own);
      }
    }
  }
}

double marker_radius(const Subject& subject, std::uint32_t side) {
  const double blurred = 0.01 * length(subject.middle());  // smaller ones lose their shape
  const double extent = std::max(subject.size(), blurred);
  return extent > 1e-9 ? extent * std::max(0.003, 1.0 / std::max(side, 1U)) : 1;
}

}  // namespace gltfx::preview

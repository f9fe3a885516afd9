// SPDX-License-Identifier: Apache-2.0
#include "preview/framing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/packed.hpp"
#include "preview/framing_faces.hpp"
#include "preview/framing_strays.hpp"
#include "preview/framing_surroundings.hpp"
#include "render/surface.hpp"
#include "render/transform.hpp"

namespace gltfx::preview {
namespace {

constexpr std::size_t kMostPoints = 200000;
constexpr double kEnoughSeen = 0.01;                   // of the area of all surfaces, projected
constexpr double kYfov = 28 * std::numbers::pi / 180;  // of a 48 mm lens on 35 mm film
constexpr double kMargin = 0.90;  // part of the picture that the subject may fill

bool is_sane(const Vec3d& p) {
  constexpr double kFar = 1e18;  // beyond it rays cannot be traced
  return std::fabs(p.x) < kFar && std::fabs(p.y) < kFar && std::fabs(p.z) < kFar;
}

// Whether no ray ever hits a surface of the material, independent of its textures.
bool is_invisible(const render::SceneMaterial& material) {
  if (!render::has_holes(material)) return false;
  if (material.alpha_mode == render::AlphaMode::mask) return material.alpha < material.alpha_cutoff;
  return material.alpha <= 0;
}

// Sums over all meshes before one.
std::vector<std::size_t> visible_triangles(const render::Scene& scene) {
  std::vector<std::size_t> sums{0};
  sums.reserve(scene.meshes.size() + 1);
  for (const render::Mesh& mesh : scene.meshes) {
    const bool seen = !is_invisible(render::material_of(scene, mesh));
    sums.push_back(sums.back() + (seen ? mesh.triangles.size() : 0));
  }
  return sums;
}

// Corners of triangles, three by three, evenly chosen over all instances. Vertices that no triangle
// uses do not count.
Subject surfaces_of(const render::Scene& scene, Which which) {
  const std::vector<std::size_t> sums = visible_triangles(scene);
  const bool some = which == Which::framed && !scene.framed.empty();
  const std::size_t count = some ? scene.framed.size() : scene.instances.size();
  const auto instance = [&](std::size_t i) -> const render::Instance& {
    return scene.instances[some ? scene.framed[i] : i];
  };
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < count; ++i) {
    triangles += sums[instance(i).mesh + instance(i).count] - sums[instance(i).mesh];
  }
  const std::size_t step = triangles * 3 / kMostPoints + 1;
  Subject subject;
  subject.points.reserve(3 * (triangles / step + 1));
  subject.faces.reserve(triangles / step + 1);
  std::size_t next = 0;      // index of the next triangle
  std::uint32_t bodies = 0;  // of all instances before one
  for (std::size_t i = 0; i < count; ++i) {
    const render::Instance& each = instance(i);
    const bool mirrored = render::determinant(each.to_world) < 0;
    const std::size_t before = sums[each.mesh];
    const std::size_t own = sums[each.mesh + each.count] - before;
    auto mesh_end = sums.begin() + each.mesh + 1;
    for (; next < own; next += step) {
      if (*mesh_end <= before + next) {
        mesh_end = std::upper_bound(mesh_end, sums.end(), before + next);
      }
      const render::Mesh& mesh =
          scene.meshes[static_cast<std::size_t>(mesh_end - sums.begin()) - 1];
      const auto& triangle = mesh.triangles[before + next - *(mesh_end - 1)];
      std::array<Vec3d, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = render::transform_point(each.to_world, to_vec(mesh.positions[triangle[k]]));
      }
      if (!std::all_of(p.begin(), p.end(), is_sane)) continue;
      for (const Vec3d& corner : p) subject.points.push_back(to_float3(corner));
      const render::SceneMaterial& material = render::material_of(scene, mesh);
      const auto number = static_cast<std::uint32_t>(mesh_end - sums.begin()) - 1 - each.mesh;
      subject.faces.push_back({bodies + number, mirrored, render::is_culled(material),
                               render::has_holes(material) || material.factors.transmission > 0});
    }
    bodies += each.count;
    next -= own;
  }
  return subject;
}

Vec3d backward_of(const Direction& direction) {
  const double turn = direction.azimuth * std::numbers::pi / 180;
  const double rise = direction.elevation * std::numbers::pi / 180;
  return {std::sin(turn) * std::cos(rise), std::sin(rise), std::cos(turn) * std::cos(rise)};
}

bool is_flat(const Subject& subject) {
  constexpr double kAlmost = 0.999;  // of all area
  Vec3d largest;
  double all = 0;
  for (std::size_t i = 0; i < subject.faces.size(); ++i) {
    const Vec3d area = area_vector(subject, i);
    all += length(area);
    if (length(area) > length(largest)) largest = area;
  }
  if (!(length(largest) > 0)) return false;
  const Vec3d normal = normalize(largest);
  double along = 0;
  for (std::size_t i = 0; i < subject.faces.size(); ++i) {
    along += std::fabs(dot(area_vector(subject, i), normal));
  }
  return along >= kAlmost * all;
}

// The part of the projected area that is visible: back faces of culled surfaces are not.
double fronts_seen(const Subject& subject, const Direction& direction) {
  const Vec3d backward = backward_of(direction);
  double seen = 0;
  double all = 0;
  for (std::size_t i = 0; i < subject.faces.size(); ++i) {
    const double area = dot(area_vector(subject, i), backward);
    all += std::fabs(area);
    seen += subject.faces[i].culled ? std::max(0.0, area) : std::fabs(area);
  }
  return all > 0 ? seen / all : 0.0;
}

// Bounds of points along the planes of a camera's frustum: they give the position from which a
// perspective camera sees all points. With `wide` and `high` 0, the bounds of the picture of an
// orthographic one.
struct Slanted {
  double left = -std::numeric_limits<double>::infinity(), right = left, lower = left, upper = left;
  double nearest = left;
};

Slanted slant(const std::vector<Float3>& points, const render::View& view, const Vec3d& middle,
              double wide, double high) {
  Slanted s;
  for (const Float3& point : points) {
    const Vec3d p = to_vec(point) - middle;
    const double x = dot(p, view.right);
    const double y = dot(p, view.up);
    const double z = dot(p, view.backward);
    s.right = std::max(s.right, x + wide * z);
    s.left = std::max(s.left, -x + wide * z);
    s.upper = std::max(s.upper, y + high * z);
    s.lower = std::max(s.lower, -y + high * z);
    s.nearest = std::max(s.nearest, z);
  }
  return s;
}

}  // namespace

double Subject::size() const { return std::max(length(greatest - least), 1e-12); }

void Subject::forget_faces() {
  points = std::vector<Float3>();
  faces = std::vector<Face>();
}

std::optional<Subject> find_subject(const render::Scene& scene, Which which) {
  Subject subject = surfaces_of(scene, which);
  if (subject.points.empty()) return std::nullopt;
  drop_surroundings(subject);
  drop_strays(subject);
  FaceBox box;
  for (const Float3& point : subject.points) box.add(to_vec(point));
  subject.least = box.least;
  subject.greatest = box.greatest;
  subject.flat = is_flat(subject);
  return subject;
}

Direction usual_direction(const Subject& subject) {
  const Vec3d extent = subject.greatest - subject.least;
  const bool flat = extent.y < 0.2 * std::max(extent.x, extent.z);
  const bool upright = extent.z < 0.05 * std::max(extent.x, extent.y);  // a picture, a sheet
  const Direction usual{upright ? 20.0 : 32.0, flat ? 38.0 : 18.0};
  // Where only back faces are visible: from behind, from below, from both.
  const double opposite = usual.azimuth + 180;
  Direction best = usual;
  double most = 0;
  for (const Direction& each :
       {usual, Direction{opposite, usual.elevation}, Direction{usual.azimuth, -usual.elevation},
        Direction{opposite, -usual.elevation}}) {
    const double seen = fronts_seen(subject, each);
    if (seen >= kEnoughSeen) return each;
    if (seen > most) best = each;
    most = std::max(most, seen);
  }
  return best;
}

render::View view_from(const Direction& direction) {
  render::View view;
  view.backward = backward_of(direction);
  const Vec3d over(0, 1, 0);
  const bool steep = std::fabs(view.backward.y) > 0.9999;
  const double turn = direction.azimuth * std::numbers::pi / 180;
  view.right =
      steep ? Vec3d(std::cos(turn), 0, -std::sin(turn)) : normalize(cross(over, view.backward));
  view.up = cross(view.backward, view.right);
  return view;
}

render::View frame(const Subject& subject, const Direction& direction, double aspect) {
  render::View view = view_from(direction);
  view.half_height = std::tan(kYfov / 2) * (aspect < 1 ? 1 / aspect : 1);
  view.half_width = view.half_height * aspect;

  const double wide = view.half_width * kMargin;
  const double high = view.half_height * kMargin;
  const Vec3d middle = subject.middle();
  const Slanted s = slant(subject.points, view, middle, wide, high);
  double distance = std::max((s.right + s.left) / (2 * wide), (s.upper + s.lower) / (2 * high));
  distance = std::max(distance, s.nearest + subject.size() * 0.05);
  const double x = (s.right - s.left) / 2;
  const double y = (s.upper - s.lower) / 2;
  view.origin = middle + view.right * x + view.up * y + view.backward * distance;
  view.inside = subject.enclosed;
  return view;
}

render::View frame_orthographic(const Subject& subject, const Direction& direction, double aspect,
                                const Subject& scene) {
  render::View view = view_from(direction);
  view.perspective = false;
  const Vec3d middle = subject.middle();
  const Slanted s = slant(subject.points, view, middle, 0, 0);
  view.half_height = std::max((s.upper + s.lower) / 2, (s.right + s.left) / 2 / aspect) / kMargin;
  view.half_height = std::max(view.half_height, subject.size() * 1e-3);  // a line from its end
  view.half_width = view.half_height * aspect;
  const double before = dot(scene.middle() - middle, view.backward) + scene.size();
  view.origin = middle + view.right * ((s.right - s.left) / 2) +
                view.up * ((s.upper - s.lower) / 2) + view.backward * before;
  return view;
}

}  // namespace gltfx::preview

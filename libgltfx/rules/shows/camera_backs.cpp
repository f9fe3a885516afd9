// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/camera.hpp"
#include "model/fields.hpp"
#include "rules/finding.hpp"
#include "rules/shows/shows.hpp"
#include "rules/shows/triangle_reader.hpp"

namespace gltfx::validate {
namespace {

using model::Affine;
using model::RootArray;

Vec3d column(const Affine& transform, std::size_t index) {
  const model::Vector3& from = transform.columns[index];
  return {from[0], from[1], from[2]};
}

Vec3d moved_to(const Affine& transform, const Float3& place) {
  return column(transform, 0) * static_cast<double>(place[0]) +
         column(transform, 1) * static_cast<double>(place[1]) +
         column(transform, 2) * static_cast<double>(place[2]) + column(transform, 3);
}

struct Eye {
  std::uint32_t node = 0;
  bool perspective = true;
  Vec3d place, backward;

  // Whether the front of a triangle is towards the camera, wherever that looks; also if it is seen
  // along its plane.
  bool faces(const Vec3d& corner, const Vec3d& front) const {
    constexpr double kAlong = 1e-3;
    const Vec3d to = perspective ? place - corner : backward;
    return dot(front, to) >= -kAlong * length(front) * length(to);
  }
};

class CameraBacks {
 public:
  CameraBacks(DataPhase& phase, const PlacedScene& scene)
      : phase_(phase), context_(phase.context), scene_(scene) {}

  void run() {
    if (context_.asset.count(RootArray::cameras) == 0 || scene_.moves()) return;
    if (!scene_.complete() || scene_.parts().empty() || !read_eyes()) return;
    const auto& primitives = scene_.parts();
    const bool rigid = std::all_of(primitives.begin(), primitives.end(), [&](const Placed& each) {
      const model::Primitive& primitive = primitive_of(each);
      return primitive.targets.empty() && primitive.mode &&
             model::draws_triangles(*primitive.mode) && !is_double_sided(primitive);
    });
    if (!rigid) return;
    for (const Eye& eye : eyes_) {
      if (sees_front(eye).value_or(true)) return;
    }
    const std::uint32_t node = eyes_.front().node;
    report_element(
        phase_.sink, context_, RootArray::nodes, node, Code::CAMERA_SEES_BACKS,
        fmt::format(
            "The camera of {} has only backs of triangles in view, which viewers do not draw{}.",
            object_label(context_, RootArray::nodes, node),
            eyes_.size() > 1 ? "; the same is true for the other cameras of the scene" : ""));
  }

 private:
  static constexpr std::size_t kMostCameras = 16;

  const model::Primitive& primitive_of(const Placed& placed) const {
    return context_.views.meshes[placed.mesh].primitives[placed.primitive];
  }
  bool is_double_sided(const model::Primitive& primitive) const {
    return primitive.material &&
           model::true_member(context_.document,
                              context_.asset.elements(RootArray::materials)[*primitive.material],
                              "doubleSided");
  }

  // False: there are none, too many, or some that cannot be read.
  bool read_eyes() {
    for (std::uint32_t i = 0; i < context_.views.nodes.size(); ++i) {
      const auto& camera = context_.views.nodes[i].camera;
      if (!camera || scene_.pose().in_scene[i] == 0) continue;
      const auto read = model::read_camera(context_.asset, *camera);
      if (!read || eyes_.size() == kMostCameras) return false;
      const Affine& world = scene_.pose().world[i];
      eyes_.push_back({i, read->perspective, column(world, 3), column(world, 2)});
    }
    return !eyes_.empty();
  }

  // Stops at the first front. Nothing: some triangles cannot be read, or are too many.
  std::optional<bool> sees_front(const Eye& eye) {
    bool any = false;
    for (const Placed& each : scene_.parts()) {
      const auto triangles = TriangleReader::open(phase_, primitive_of(each));
      if (!triangles) return std::nullopt;
      const Affine& world = scene_.pose().world[each.node];
      const bool mirrored = world.determinant() < 0;
      for (std::uint64_t i = 0; i < triangles->count(); ++i) {
        if (!phase_.budget.take(1, 9)) return std::nullopt;
        const auto corners = triangles->corners(i);
        if (!corners) continue;
        std::array<Vec3d, 3> places;
        for (std::size_t k = 0; k < 3; ++k) {
          places[k] = moved_to(world, triangles->position((*corners)[k]));
        }
        Vec3d front = cross(places[1] - places[0], places[2] - places[0]);
        if (mirrored) front = -front;
        if (!(length(front) > 0)) continue;
        any = true;
        if (eye.faces(places[0], front)) return true;
      }
    }
    return any ? std::optional(false) : std::nullopt;
  }

  DataPhase& phase_;
  const Context& context_;
  const PlacedScene& scene_;
  std::vector<Eye> eyes_;
};

}  // namespace

void check_camera_backs(DataPhase& phase, const PlacedScene& scene) {
  CameraBacks(phase, scene).run();
}

}  // namespace gltfx::validate

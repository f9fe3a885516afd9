// SPDX-License-Identifier: Apache-2.0
#include "measure/scene_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "base/packed.hpp"
#include "measure/drawn.hpp"
#include "measure/shape.hpp"

namespace gltfx::measure {
namespace {

using model::Affine;
using model::NodeIndex;
using model::Vector3;

// Triangles that may be transformed, for all scenes together: about a second.
constexpr std::uint64_t kMostTriangles = std::uint64_t{1} << 27U;
constexpr std::string_view kTooOften = "There are too many triangles and copies.";

/// The normals of triangles, as long as their areas.
struct AreaVectors {
  std::vector<Vector3> all;
  double sum = 0;  ///< of the areas
};

void add_areas(const std::vector<Float3>& positions, const std::vector<model::Triangle>& triangles,
               AreaVectors& to) {
  for (const auto& [a, b, c] : triangles) {
    const Vec3d from = to_vec(positions[a]);
    const Vec3d area = cross(to_vec(positions[b]) - from, to_vec(positions[c]) - from) / 2;
    const double size = length(area);
    if (!std::isfinite(size)) continue;
    to.all.push_back({area.x, area.y, area.z});
    to.sum += size;
  }
}

/// How often a mesh is drawn with transforms.
struct Transforms {
  double similar = 0;                      ///< the factors of those that scale all areas alike
  std::map<Linear, std::uint64_t> others;  ///< finite ones
  bool infinite = false;                   ///< there are others that are not finite

  bool empty() const { return similar == 0 && others.empty() && !infinite; }
};

class SceneAreas {
 public:
  explicit SceneAreas(const Source& source)
      : source_(source), budget_(geometry_bytes(source)), drawn_(source) {}

  // The area, or nothing, with the reason in why().
  std::optional<double> of(std::uint32_t scene) {
    why_ = {};
    area_ = 0;
    drawn_.enter(scene);
    for (const auto& [mesh, nodes] : drawn_.by_mesh()) {
      if (why_.empty()) add_mesh(mesh, nodes);
    }
    return why_.empty() ? std::optional(area_) : std::nullopt;
  }
  std::string_view why() const { return why_; }

 private:
  // Of those that are not similar: more would take more than a second.
  static constexpr std::size_t kMostTransforms = std::size_t{1} << 20U;

  void add_mesh(std::uint32_t mesh, const std::vector<NodeIndex>& nodes) {
    Transforms rigid;
    for (const NodeIndex node : nodes) {
      const auto pose = drawn_.pose_of(node);
      if (!pose) {
        why_ = drawn_.why();
        return;
      }
      Transforms posed;
      add_transforms(node, *pose, pose->is_rigid() ? rigid : posed);
      if (!why_.empty()) return;
      if (!pose->is_rigid()) add(read_posed(mesh, *pose), posed);
    }
    if (!rigid.empty() && why_.empty()) add_rigid(mesh, rigid);
  }

  // Many scenes may draw a mesh, mostly without distorting it.
  void add_rigid(std::uint32_t mesh, const Transforms& transforms) {
    const auto known = sums_.find(mesh);
    if (known != sums_.end() && transforms.others.empty()) {
      return add({{}, known->second}, transforms);
    }
    const AreaVectors areas = read_rigid(mesh);
    if (!why_.empty()) return;
    sums_[mesh] = areas.sum;
    add(areas, transforms);
  }

  void add_transforms(NodeIndex node, const MeshPose& pose, Transforms& to) {
    const std::vector<Affine> transforms = drawn_.transforms_of(node, pose);
    if (transforms.empty()) why_ = drawn_.why();
    for (const Affine& transform : transforms) {
      const Linear linear = linear_part(transform);
      if (const auto factor = common_factor(linear)) {
        to.similar += *factor;
      } else if (!is_finite(linear)) {
        to.infinite = true;
      } else {
        ++to.others[linear];
      }
      if (to.others.size() > kMostTransforms) {
        why_ = kTooOften;
        return;
      }
    }
  }

  AreaVectors read_rigid(std::uint32_t mesh) {
    AreaVectors areas;
    Shape shape;
    why_ = read_shape(source_, source_.views().meshes[mesh], budget_, shape);
    if (why_.empty()) add_areas(shape.positions, shape.triangles, areas);
    return areas;
  }
  AreaVectors read_posed(std::uint32_t mesh, const MeshPose& pose) {
    AreaVectors areas;
    model::GeometryRequest request;
    request.weights = pose.weights;
    request.joints = pose.joints;
    request.surface = false;
    const auto primitives = pointers_to(source_.views().meshes[mesh].primitives);
    read_primitives(source_, primitives, request, budget_, [&](const ReadPrimitive& read) {
      if (is_fault(read.error)) {
        why_ = read.error == model::GeometryError::too_large ? kTooLarge : kUnreadVertices;
        return false;
      }
      add_areas(read.geometry.positions, read.geometry.triangles, areas);
      return true;
    });
    return areas;
  }

  void add(const AreaVectors& areas, const Transforms& transforms) {
    area_ += transforms.similar * areas.sum;
    if (transforms.infinite && areas.sum > 0) area_ = std::numeric_limits<double>::infinity();
    for (const auto& [linear, count] : transforms.others) {
      if (!why_.empty()) return;
      area_ += transformed(areas, linear) * static_cast<double>(count);
    }
  }

  // Areas turn with the cofactors of a transform.
  double transformed(const AreaVectors& areas, const Linear& linear) {
    if (areas.all.size() > kMostTriangles - transformed_) {
      why_ = kTooOften;
      return 0;
    }
    transformed_ += areas.all.size();
    const auto& [x, y, z] = linear;
    const Affine cofactors{{{model::cross(y, z), model::cross(z, x), model::cross(x, y), {}}}};
    double sum = 0;
    for (const Vector3& area : areas.all) {
      const Vector3 moved = cofactors.vector(area);
      sum += std::sqrt(model::dot(moved, moved));
    }
    return sum;
  }

  const Source& source_;
  model::MemoryBudget budget_;
  DrawnMeshes drawn_;
  std::map<std::uint32_t, double> sums_;  // of the areas of meshes
  std::uint64_t transformed_ = 0;
  double area_ = 0;
  std::string_view why_;
};

}  // namespace

void take_scene_areas(Taking& taking, Column& column) {
  const Source& source = taking.source();
  SceneAreas areas(source);
  for (std::uint32_t scene = 0; scene < taking.count(MeasureScope::scene); ++scene) {
    if (!is_affordable(source, scene)) {
      column.could_not_be_taken(scene, kTooManyScenes);
      continue;
    }
    const auto area = areas.of(scene);
    if (!area) {
      column.could_not_be_taken(scene, areas.why());
    } else if (std::isfinite(*area)) {
      column.set(scene, MeasureValue(*area));
    } else {
      column.does_not_apply(scene, "Something is drawn at infinity.");
    }
  }
}

}  // namespace gltfx::measure

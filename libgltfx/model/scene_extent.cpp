// SPDX-License-Identifier: Apache-2.0
#include "model/scene_extent.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "base/checked.hpp"
#include "model/instancing.hpp"
#include "model/memory_budget.hpp"
#include "model/pose.hpp"

namespace gltfx::model {
namespace {

constexpr std::uint64_t kMostJoints = std::uint64_t{1}
                                      << 20U;  // limit for all skinned meshes together

/// A bounding box, extended by include().
class ExtentBox {
 public:
  ExtentBox() = default;
  explicit ExtentBox(const std::optional<SceneBounds>& bounds)
      : empty_(!bounds), bounds_(bounds.value_or(SceneBounds())) {}

  bool empty() const { return empty_; }
  void include(const Vector3& point) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!std::isfinite(point[i])) return;
    }
    if (empty_) bounds_ = {point, point};
    empty_ = false;
    for (std::size_t i = 0; i < 3; ++i) {
      bounds_.least[i] = std::min(bounds_.least[i], point[i]);
      bounds_.greatest[i] = std::max(bounds_.greatest[i], point[i]);
    }
  }
  /// The corners of another box, moved (Arvo, "Transforming axis-aligned bounding boxes", 1990).
  void include(const ExtentBox& other, const Affine& transform) {
    if (other.empty_) return;
    Vector3 least{};
    Vector3 greatest{};
    for (std::size_t column = 0; column < 3; ++column) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double a = transform.columns[column][i] * other.bounds_.least[column];
        const double b = transform.columns[column][i] * other.bounds_.greatest[column];
        least[i] += std::min(a, b);
        greatest[i] += std::max(a, b);
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      least[i] += transform.columns[3][i];
      greatest[i] += transform.columns[3][i];
    }
    include(least);
    include(greatest);
  }
  const SceneBounds& bounds() const { return bounds_; }
  /// The greatest absolute value of a coordinate.
  double reach() const {
    double reach = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      reach = std::max({reach, -bounds_.least[i], bounds_.greatest[i]});
    }
    return reach;
  }

 private:
  bool empty_ = true;
  SceneBounds bounds_;
};

// `min` and `max` of normalized integers are written as those integers.
double scale_of(const Format& format) {
  const bool integer = format.normalized && is_integer(format.component);
  return integer ? value_range(format.component).most : 1;
}

void include_positions(const json::Document& document, const Accessor& accessor, ExtentBox& box) {
  const auto least = float_array<3>(document, accessor.min);
  const auto greatest = float_array<3>(document, accessor.max);
  if (!least || !greatest || accessor.format.type != ElementType::vec3) return;
  const double scale = scale_of(accessor.format);
  for (const auto& corner : {*least, *greatest}) {
    box.include({corner[0] / scale, corner[1] / scale, corner[2] / scale});
  }
}

ExtentBox box_of(const json::Document& document, const Views& views, const Mesh& mesh) {
  ExtentBox box;
  for (const Primitive& primitive : mesh.primitives) {
    const Attribute* positions = primitive.find(SemanticKind::position);
    if (positions == nullptr || !positions->accessor) continue;
    include_positions(document, views.accessors[*positions->accessor], box);
  }
  return box;
}

class ExtentMeasurer {
 public:
  ExtentMeasurer(const Asset& asset, const Views& views, const ResourceData& resources,
                 std::span<const MeshFacts> meshes, std::uint64_t instance_bytes, const Pose& pose)
      : asset_(asset),
        views_(views),
        resources_(resources),
        meshes_(meshes),
        budget_(instance_bytes),
        pose_(pose) {
    for (const Mesh& mesh : views.meshes) {
      boxes_.push_back(box_of(asset.document(), views, mesh));
    }
  }

  SceneExtent run() {
    for (std::size_t i = 0; i < views_.nodes.size(); ++i) {
      const Node& node = views_.nodes[i];
      if (pose_.in_scene[i] == 0 || !node.mesh) continue;
      const double before = box_.reach();
      take(node, pose_.world[i]);
      if (box_.reach() > before) extent_.farthest = static_cast<NodeIndex>(i);
    }
    if (!box_.empty()) extent_.bounds = box_.bounds();
    return extent_;
  }

 private:
  void take(const Node& node, const Affine& world) {
    const std::uint64_t triangles = meshes_.empty() ? 0 : meshes_[*node.mesh].triangles;
    const auto instances = read_instancing(asset_, views_, resources_, node, budget_);
    const std::uint64_t times = instances && instances->readable ? instances->transforms.size() : 1;
    extent_.triangles =
        saturating_add(extent_.triangles, checked_mul(triangles, times).value_or(UINT64_MAX));
    const ExtentBox& own = boxes_[*node.mesh];
    if (node.skin) return take_skinned(own, *node.skin);
    if (!instances || !instances->readable) return box_.include(own, world);
    for (const Affine& each : instances->transforms) box_.include(own, world * each);
  }

  // The node does not move a skinned mesh: its joints do.
  void take_skinned(const ExtentBox& own, std::uint32_t skin) {
    const std::vector<Affine>& joints = joints_of(skin);
    const std::uint64_t count = joints.size() <= joints_left_ ? joints.size() : 1;
    joints_left_ -= std::min(joints_left_, count);
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(count, joints.size()); ++i) {
      box_.include(own, joints[i]);
    }
  }

  const std::vector<Affine>& joints_of(std::uint32_t skin) {
    const auto [entry, fresh] = joints_.try_emplace(skin);
    if (fresh) entry->second = joint_matrices(asset_, views_, resources_, skin, pose_);
    return entry->second;
  }

  const Asset& asset_;
  const Views& views_;
  const ResourceData& resources_;
  const std::span<const MeshFacts> meshes_;
  MemoryBudget budget_;
  const Pose& pose_;
  std::vector<ExtentBox> boxes_;  // by mesh
  std::map<std::uint32_t, std::vector<Affine>> joints_;
  std::uint64_t joints_left_ = kMostJoints;
  ExtentBox box_;
  SceneExtent extent_;
};

}  // namespace

SceneExtent scene_extent(const Asset& asset, const Views& views, const ResourceData& resources,
                         std::span<const MeshFacts> meshes, std::uint64_t instance_bytes,
                         const Pose& pose) {
  return ExtentMeasurer(asset, views, resources, meshes, instance_bytes, pose).run();
}

void include_bounds(const SceneBounds& others, const Affine& transform,
                    std::optional<SceneBounds>& bounds) {
  ExtentBox box(bounds);
  box.include(ExtentBox(others), transform);
  if (!box.empty()) bounds = box.bounds();
}

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
#include "model/scene_box.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/checked.hpp"
#include "model/draco.hpp"
#include "model/instancing.hpp"

namespace gltfx::model {
namespace {

constexpr std::uint64_t kMostTransforms = std::uint64_t{1} << 28U;  // of vertices
constexpr std::uint64_t kTransformBytes = std::uint64_t{1} << 28U;  // of copies and joints
constexpr const char* kTooMany = "has too many vertices and copies";

std::uint64_t readable_geometry(const GeometrySource& source) {
  return saturating_add(std::uint64_t{1} << 28U,
                        checked_mul(source.resources.buffer_bytes(), 64).value_or(UINT64_MAX));
}

// Whether each axis goes to one axis, so that the corners of a box are enough.
bool maps_axes(const Affine& transform) {
  for (std::size_t column = 0; column < 3; ++column) {
    const Vector3& axis = transform.columns[column];
    if (std::count(axis.begin(), axis.end(), 0.0) < 2) return false;
  }
  return true;
}

/// The drawn vertices of a mesh.
struct MeshPoints {
  std::vector<std::array<float, 3>> points;
  Box box;
};

class BoxReader {
 public:
  explicit BoxReader(const GeometrySource& source)
      : source_(source), budget_(readable_geometry(source)) {}

  std::optional<Error> read(const Mesh& mesh, const GeometryRequest& request, MeshPoints& to) {
    const bool rigid = request.weights.empty() && request.joints.empty();
    Geometry geometry;
    std::optional<std::uint32_t> vertices;  // the accessor of those in `geometry`
    std::vector<bool> known;                // those of them that are added
    for (const Primitive& primitive : mesh.primitives) {
      if (primitive.node == json::kNoNode) continue;
      const Attribute* const at = primitive.find(SemanticKind::position);
      if (at == nullptr) continue;  // draws nothing
      const bool plain = rigid && !read_draco(source_.asset, primitive);
      GeometryError error = GeometryError::none;
      if (plain && at->accessor && vertices == at->accessor) {
        error = read_elements(source_, primitive, budget_, geometry);
      } else {
        geometry = {};
        known.clear();
        error = read_geometry(source_, primitive, request, budget_, geometry);
        vertices = plain ? at->accessor : std::nullopt;
      }
      if (error == GeometryError::empty) continue;
      if (error == GeometryError::too_large) return Error{kTooMany};
      if (error != GeometryError::none) return Error{"has geometry that cannot be read"};
      add(geometry, known, to);
    }
    return std::nullopt;
  }

  std::optional<Error> add_node(NodeIndex index, const Pose& pose, std::optional<MeshPoints>& rigid,
                                Box& box) {
    const Node& node = source_.views.nodes[index];
    const Mesh& mesh = source_.views.meshes[*node.mesh];
    std::vector<float> weights = morph_weights(source_.asset, source_.views, index);
    const bool morphs = std::any_of(weights.begin(), weights.end(), [](float w) { return w != 0; });
    GeometryRequest request;
    request.surface = false;
    if (morphs) request.weights = weights;
    std::vector<Affine> transforms{pose.world[index]};
    if (node.skin) {
      const std::vector<Affine>* const joints = joints_of(*node.skin, pose);
      if (joints == nullptr) return Error{kTooMany};
      request.joints = *joints;
      if (!joints->empty()) transforms.front() = {};
    } else if (auto instances = read_instancing(source_.asset, source_.views, source_.resources,
                                                node, transform_budget_)) {
      if (!instances->readable) return Error{"has instances that cannot be read"};
      for (Affine& each : instances->transforms) each = pose.world[index] * each;
      transforms = std::move(instances->transforms);
    }
    if (!morphs && request.joints.empty()) {
      if (!rigid) {
        if (auto error = read(mesh, request, rigid.emplace())) return error;
      }
      return add(*rigid, transforms, box);
    }
    MeshPoints points;
    if (auto error = read(mesh, request, points)) return error;
    return add(points, transforms, box);
  }

 private:
  static void add(const Geometry& geometry, std::vector<bool>& known, MeshPoints& to) {
    known.resize(geometry.positions.size(), false);
    const auto use = [&](std::uint32_t vertex) {
      if (known[vertex]) return;
      known[vertex] = true;
      const std::array<float, 3>& at = geometry.positions[vertex];
      to.points.push_back(at);
      to.box.add({double{at[0]}, double{at[1]}, double{at[2]}});
    };
    for (const auto& each : geometry.triangles) std::for_each(each.begin(), each.end(), use);
    for (const auto& each : geometry.segments) std::for_each(each.begin(), each.end(), use);
    std::for_each(geometry.points.begin(), geometry.points.end(), use);
  }

  std::optional<Error> add(const MeshPoints& mesh, const std::vector<Affine>& transforms,
                           Box& box) {
    if (mesh.box.empty()) return std::nullopt;
    for (const Affine& transform : transforms) {
      if (maps_axes(transform)) {
        box.add(transform.point(mesh.box.least));
        box.add(transform.point(mesh.box.greatest));
        continue;
      }
      if (mesh.points.size() > kMostTransforms - transformed_) return Error{kTooMany};
      transformed_ += mesh.points.size();
      for (const auto& at : mesh.points)
        box.add(transform.point({double{at[0]}, double{at[1]}, double{at[2]}}));
    }
    return std::nullopt;
  }

  // Null: there are too many.
  const std::vector<Affine>* joints_of(std::uint32_t skin, const Pose& pose) {
    const auto [known, is_new] = joints_.try_emplace(skin);
    if (is_new) {
      known->second = joint_matrices(source_.asset, source_.views, source_.resources, skin, pose);
      if (!transform_budget_.take(checked_mul(known->second.size(), sizeof(Affine))))
        return nullptr;
    }
    return &known->second;
  }

  const GeometrySource& source_;
  MemoryBudget budget_;
  MemoryBudget transform_budget_{kTransformBytes};
  std::uint64_t transformed_ = 0;
  std::map<std::uint32_t, std::vector<Affine>> joints_;  // by skin
};

}  // namespace

void Box::add(const Vector3& point) {
  for (std::size_t i = 0; i < 3; ++i) {
    least[i] = std::min(least[i], point[i]);
    greatest[i] = std::max(greatest[i], point[i]);
  }
}

Vector3 Box::center() const {
  Vector3 center{};
  for (std::size_t i = 0; i < 3; ++i) center[i] = least[i] / 2 + greatest[i] / 2;
  return center;
}

double Box::diagonal() const {
  if (empty()) return 0;
  return std::hypot(greatest[0] - least[0], greatest[1] - least[1], greatest[2] - least[2]);
}

Box moved_box(const Affine& transform, const Box& box) {
  Box moved{transform.columns[3], transform.columns[3]};
  for (std::size_t column = 0; column < 3; ++column) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = transform.columns[column][k] * box.least[column];
      const double b = transform.columns[column][k] * box.greatest[column];
      moved.least[k] += std::min(a, b);
      moved.greatest[k] += std::max(a, b);
    }
  }
  return moved;
}

Result<Box> mesh_box(const GeometrySource& source, const Mesh& mesh) {
  GeometryRequest request;
  request.surface = false;
  MeshPoints points;
  if (auto error = BoxReader(source).read(mesh, request, points)) return *std::move(error);
  return points.box;
}

Result<Box> scene_box(const GeometrySource& source, const Pose& pose) {
  std::map<std::uint32_t, std::vector<NodeIndex>> by_mesh;
  for (std::size_t i = 0; i < source.views.nodes.size(); ++i) {
    const Node& node = source.views.nodes[i];
    if (pose.in_scene[i] != 0 && node.mesh)
      by_mesh[*node.mesh].push_back(static_cast<NodeIndex>(i));
  }
  BoxReader reader(source);
  Box box;
  for (const auto& [mesh, nodes] : by_mesh) {
    std::optional<MeshPoints> rigid;  // read once for all nodes
    for (const NodeIndex node : nodes) {
      if (auto error = reader.add_node(node, pose, rigid, box)) return *std::move(error);
    }
  }
  return box;
}

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
#include "measure/scene_area.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "base/packed.hpp"
#include "measure/drawn.hpp"
#include "measure/shape.hpp"
#include "model/instancing.hpp"

namespace gltfx::measure {
namespace {

using model::Affine;
using model::NodeIndex;
using model::Vector3;

// Triangles that may be transformed, for all scenes together: about a second.
constexpr std::uint64_t kMostTriangles = std::uint64_t{1} << 27U;

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

/// The linear part of a transform.
using Linear = std::array<Vector3, 3>;

// How much larger all areas become; nothing: that depends on their directions.
std::optional<double> common_factor(const Linear& linear) {
  constexpr double kUnequal = 1e-12;
  const auto& [x, y, z] = linear;
  const double square = model::dot(x, x);
  for (const double difference : {model::dot(y, y) - square, model::dot(z, z) - square,
                                  model::dot(x, y), model::dot(y, z), model::dot(z, x)}) {
    if (!(std::abs(difference) <= kUnequal * square)) return std::nullopt;
  }
  return square;
}

/// How often a mesh is drawn with each.
using Transforms = std::map<Linear, std::uint64_t>;

class SceneAreas {
 public:
  explicit SceneAreas(const Source& source) : source_(source), budget_(geometry_bytes(source)) {}

  // The area, or nothing, with the reason in why().
  std::optional<double> of(std::uint32_t scene) {
    why_ = {};
    area_ = 0;
    // By mesh: those that many nodes draw are read once.
    std::map<std::uint32_t, std::vector<NodeIndex>> by_mesh;
    for (const NodeIndex node : nodes_of_scene(source_, scene).drawn) {
      by_mesh[*source_.views().nodes[node].mesh].push_back(node);
    }
    const model::Pose& pose = source_.pose(scene);
    for (const auto& [mesh, nodes] : by_mesh) {
      if (why_.empty()) add_mesh(mesh, nodes, pose);
    }
    return why_.empty() ? std::optional(area_) : std::nullopt;
  }
  std::string_view why() const { return why_; }

 private:
  void add_mesh(std::uint32_t mesh, const std::vector<NodeIndex>& nodes, const model::Pose& pose) {
    Transforms plain;
    for (const NodeIndex node : nodes) {
      const auto weights = model::morph_weights(source_.asset(), source_.views(), node);
      const bool morphed =
          std::any_of(weights.begin(), weights.end(), [](float weight) { return weight != 0; });
      const auto& skin = source_.views().nodes[node].skin;
      std::vector<Affine> joints;
      if (skin) {
        joints = model::joint_matrices(source_.asset(), source_.views(), source_.resources(), *skin,
                                       pose);
      }
      // Skins move vertices to the space of the scene.
      const Affine world = joints.empty() ? pose.world[node] : Affine();
      if (joints.empty() && !morphed) {
        add_transforms(node, world, plain);
        continue;
      }
      Transforms posed;
      add_transforms(node, world, posed);
      add(read_posed(mesh, weights, joints), posed);
    }
    if (!plain.empty() && why_.empty()) add_plain(mesh, plain);
  }

  // Many scenes may draw a mesh, mostly without distorting it.
  void add_plain(std::uint32_t mesh, const Transforms& transforms) {
    const auto known = sums_.find(mesh);
    const bool alike = std::all_of(transforms.begin(), transforms.end(), [](const auto& each) {
      return common_factor(each.first).has_value();
    });
    if (known != sums_.end() && alike) return add({{}, known->second}, transforms);
    const AreaVectors areas = read_plain(mesh);
    if (!why_.empty()) return;
    sums_[mesh] = areas.sum;
    add(areas, transforms);
  }

  void add_transforms(NodeIndex node, const Affine& world, Transforms& to) {
    model::MemoryBudget budget(kInstanceBytes);
    const auto copies = model::read_instancing(
        source_.asset(), source_.views(), source_.resources(), source_.views().nodes[node], budget);
    if (!copies) {
      ++to[linear_of(world)];
    } else if (!copies->readable) {
      why_ = "The transforms of copies cannot be read.";
    } else {
      for (const Affine& copy : copies->transforms) ++to[linear_of(world * copy)];
    }
  }
  static Linear linear_of(const Affine& transform) {
    return {transform.columns[0], transform.columns[1], transform.columns[2]};
  }

  AreaVectors read_plain(std::uint32_t mesh) {
    AreaVectors areas;
    Shape shape;
    why_ = read_shape(source_, source_.views().meshes[mesh], budget_, shape);
    if (why_.empty()) add_areas(shape.positions, shape.triangles, areas);
    return areas;
  }
  AreaVectors read_posed(std::uint32_t mesh, const std::vector<float>& weights,
                         const std::vector<Affine>& joints) {
    AreaVectors areas;
    for (const model::Primitive& primitive : source_.views().meshes[mesh].primitives) {
      model::GeometryRequest request;
      request.weights = weights;
      request.joints = joints;
      request.surface = false;
      model::Geometry geometry;
      const auto error =
          model::read_geometry(source_.geometry(), primitive, request, budget_, geometry);
      if (error == model::GeometryError::too_large) why_ = kTooLarge;
      if (error == model::GeometryError::no_positions || error == model::GeometryError::packed) {
        why_ = "Vertices could not be read.";
      }
      if (error == model::GeometryError::none) {
        add_areas(geometry.positions, geometry.triangles, areas);
      }
    }
    return areas;
  }

  void add(const AreaVectors& areas, const Transforms& transforms) {
    for (const auto& [linear, count] : transforms) {
      const auto factor = common_factor(linear);
      const double each = factor ? *factor * areas.sum : transformed(areas, linear);
      area_ += each * static_cast<double>(count);
    }
  }

  // Areas turn with the cofactors of a transform.
  double transformed(const AreaVectors& areas, const Linear& linear) {
    if (areas.all.size() > kMostTriangles - transformed_) {
      why_ = "There are too many triangles and copies.";
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
  std::map<std::uint32_t, double> sums_;  // of the areas of meshes
  std::uint64_t transformed_ = 0;
  double area_ = 0;
  std::string_view why_;
};

}  // namespace

void take_scene_areas(Taking& taking, Column& column) {
  const Source& source = taking.source();
  SceneAreas areas(source);
  SceneWork work(source);
  for (std::uint32_t scene = 0; scene < taking.count(MeasureScope::scene); ++scene) {
    if (!work.take(source.views().nodes.size())) {
      column.could_not_be_taken(scene, "There are too many scenes.");
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

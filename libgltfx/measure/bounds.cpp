// SPDX-License-Identifier: Apache-2.0
// Extents of scenes and meshes, exact: of the vertices that elements draw, not of the corners of
// boxes.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "measure/drawn.hpp"
#include "measure/take.hpp"
#include "model/instancing.hpp"

namespace gltfx::measure {
namespace {

using model::Affine;
using model::NodeIndex;
using model::Vector3;

constexpr std::uint64_t kGeometryBytes = std::uint64_t{1} << 32U;
// Vertices that may be transformed, for all scenes together: about a second.
constexpr std::uint64_t kMostTransforms = std::uint64_t{1} << 28U;

struct Box {
  Vector3 least{kFar, kFar, kFar}, greatest{-kFar, -kFar, -kFar};

  bool empty() const { return !(least[0] <= greatest[0]); }
  void add(const Vector3& point) {
    for (std::size_t i = 0; i < 3; ++i) {
      least[i] = std::min(least[i], point[i]);
      greatest[i] = std::max(greatest[i], point[i]);
    }
  }
  double size(std::size_t axis) const { return greatest[axis] - least[axis]; }
  double center(std::size_t axis) const { return least[axis] / 2 + greatest[axis] / 2; }
  // From a point to the box; 0 inside.
  double distance(const Vector3& from) const {
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double off = std::max({least[i] - from[i], from[i] - greatest[i], 0.0});
      square += off * off;
    }
    return std::sqrt(square);
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
};

// The vertices that elements of primitives draw.
struct DrawnVertices {
  std::vector<Vector3> points;
  Box box;
};

void add_drawn(const model::Geometry& geometry, DrawnVertices& to) {
  std::vector<bool> drawn(geometry.positions.size());
  for (const auto& triangle : geometry.triangles) {
    for (const std::uint32_t vertex : triangle) drawn[vertex] = true;
  }
  for (const auto& segment : geometry.segments) {
    for (const std::uint32_t vertex : segment) drawn[vertex] = true;
  }
  for (const std::uint32_t vertex : geometry.points) drawn[vertex] = true;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (!drawn[i]) continue;
    const auto& at = geometry.positions[i];
    to.points.push_back(
        {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])});
    to.box.add(to.points.back());
  }
}

// Whether each axis goes to one axis: the corners of a box tell the rest.
bool keeps_axes(const Affine& transform) {
  for (std::size_t column = 0; column < 3; ++column) {
    const auto& axis = transform.columns[column];
    if (std::count(axis.begin(), axis.end(), 0.0) < 2) return false;
  }
  return true;
}

// Why there is no extent.
enum class Failure : std::uint8_t { none, unread, too_much };

class Extents {
 public:
  explicit Extents(Taking& taking) : source_(taking.source()), budget_(kGeometryBytes) {}

  struct Extent {
    Box box;
    Failure failure = Failure::none;
  };

  // In the space of the mesh, without morph targets and skins.
  Extent of_mesh(std::uint32_t mesh) {
    Extent extent;
    extent.box = vertices_of(mesh, {}, {}, extent.failure).box;
    return extent;
  }

  Extent of_scene(std::uint32_t scene) {
    Extent extent;
    // By mesh: those that many nodes draw are read once.
    std::map<std::uint32_t, std::vector<NodeIndex>> by_mesh;
    for (const NodeIndex node : nodes_of_scene(source_, scene).drawn) {
      by_mesh[*source_.views().nodes[node].mesh].push_back(node);
    }
    const model::Pose& pose = source_.pose(scene);
    for (const auto& [mesh, nodes] : by_mesh) {
      DrawnVertices plain;
      bool read = false;
      for (const NodeIndex node : nodes) {
        if (extent.failure != Failure::none) return extent;
        const auto weights = model::morph_weights(source_.asset(), source_.views(), node);
        const auto& skin = source_.views().nodes[node].skin;
        const bool moved =
            std::any_of(weights.begin(), weights.end(), [](float weight) { return weight != 0; });
        if (skin || moved) {
          add_posed(node, mesh, weights, pose, extent);
          continue;
        }
        if (!read) plain = vertices_of(mesh, {}, {}, extent.failure);
        read = true;
        add(node, plain, pose.world[node], extent);
      }
    }
    return extent;
  }

 private:
  DrawnVertices vertices_of(std::uint32_t mesh, const std::vector<float>& weights,
                            const std::vector<Affine>& joints, Failure& failure) {
    DrawnVertices vertices;
    for (const model::Primitive& primitive : source_.views().meshes[mesh].primitives) {
      model::GeometryRequest request;
      request.weights = weights;
      request.joints = joints;
      model::Geometry geometry;
      const auto error =
          model::read_geometry(source_.geometry(), primitive, request, budget_, geometry);
      if (error == model::GeometryError::too_large) failure = Failure::too_much;
      if (error == model::GeometryError::no_positions || error == model::GeometryError::packed) {
        failure = Failure::unread;
      }
      if (error != model::GeometryError::none) continue;
      add_drawn(geometry, vertices);
    }
    return vertices;
  }

  // Skins move vertices to the space of the scene; the transform of the node has no effect.
  void add_posed(NodeIndex node, std::uint32_t mesh, const std::vector<float>& weights,
                 const model::Pose& pose, Extent& extent) {
    std::vector<Affine> joints;
    const auto& skin = source_.views().nodes[node].skin;
    if (skin) {
      joints =
          model::joint_matrices(source_.asset(), source_.views(), source_.resources(), *skin, pose);
    }
    const auto vertices = vertices_of(mesh, weights, joints, extent.failure);
    add(node, vertices, joints.empty() ? pose.world[node] : Affine(), extent);
  }

  void add(NodeIndex node, const DrawnVertices& vertices, const Affine& world, Extent& extent) {
    model::MemoryBudget budget(kInstanceBytes);
    const auto copies = model::read_instancing(
        source_.asset(), source_.views(), source_.resources(), source_.views().nodes[node], budget);
    if (!copies) return add(vertices, world, extent);
    if (!copies->readable) {
      extent.failure = Failure::unread;
      return;
    }
    for (const Affine& copy : copies->transforms) {
      add(vertices, world * copy, extent);
      if (extent.failure != Failure::none) return;
    }
  }

  void add(const DrawnVertices& vertices, const Affine& world, Extent& extent) {
    if (vertices.box.empty()) return;
    if (keeps_axes(world)) {
      extent.box.add(world.point(vertices.box.least));
      extent.box.add(world.point(vertices.box.greatest));
      return;
    }
    if (vertices.points.size() > kMostTransforms - transforms_) {
      extent.failure = Failure::too_much;
      return;
    }
    transforms_ += vertices.points.size();
    for (const Vector3& vertex : vertices.points) extent.box.add(world.point(vertex));
  }

  const Source& source_;
  model::MemoryBudget budget_;
  std::uint64_t transforms_ = 0;
};

class ExtentColumns {
 public:
  ExtentColumns(Taking& taking, MeasureScope on) : taking_(taking), on_(on) {}

  void take(std::size_t element, const Extents::Extent& extent) {
    const Box& box = extent.box;
    constexpr std::array<std::array<Name, 4>, 3> kAxes{{
        {Name::size_x, Name::min_x, Name::max_x, Name::center_x},
        {Name::size_y, Name::min_y, Name::max_y, Name::center_y},
        {Name::size_z, Name::min_z, Name::max_z, Name::center_z},
    }};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& [size, least, greatest, center] = kAxes[axis];
      set(size, element, extent, box.size(axis));
      set(least, element, extent, box.least[axis]);
      set(greatest, element, extent, box.greatest[axis]);
      set(center, element, extent, box.center(axis));
    }
    set(Name::size_max, element, extent, std::max({box.size(0), box.size(1), box.size(2)}));
    const double distance = box.distance({});
    set(Name::origin_distance, element, extent, distance);
    set(Name::pivot_distance, element, extent, distance);
    take_deviation(element, extent);
  }

 private:
  // In percent of the product.
  void take_deviation(std::size_t element, const Extents::Extent& extent) {
    constexpr std::array<Name, 3> kAxes{Name::product_deviation_x, Name::product_deviation_y,
                                        Name::product_deviation_z};
    std::optional<double> greatest;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double wanted = taking_.parameters().product[axis];
      const double off = 100 * std::fabs(extent.box.size(axis) - wanted) / wanted;
      set_deviation(kAxes[axis], element, extent, wanted > 0 ? std::optional(off) : std::nullopt);
      if (wanted > 0) greatest = std::max(greatest.value_or(0), off);
    }
    set_deviation(Name::product_deviation, element, extent, greatest);
  }
  void set_deviation(Name name, std::size_t element, const Extents::Extent& extent,
                     std::optional<double> value) {
    if (value) return set(name, element, extent, *value);
    Column* column = taking_.column(on_, name);
    if (column == nullptr) return;
    const auto& product = taking_.parameters().product;
    if (std::any_of(product.begin(), product.end(), [](double size) { return size > 0; })) {
      column->does_not_apply(element, "The product may have any size along this axis.");
    } else {
      column->could_not_be_taken(element, "No product is known for this asset.");
    }
  }

  void set(Name name, std::size_t element, const Extents::Extent& extent, double value) {
    Column* column = taking_.column(on_, name);
    if (column == nullptr) return;
    if (extent.failure == Failure::unread) {
      column->could_not_be_taken(element, "Vertices could not be read.");
    } else if (extent.failure == Failure::too_much) {
      column->could_not_be_taken(element, "There are too many vertices and copies.");
    } else if (extent.box.empty() || !std::isfinite(value)) {
      column->does_not_apply(element, "Nothing is drawn.");
    } else {
      column->set(element, MeasureValue(value));
    }
  }

  Taking& taking_;
  MeasureScope on_;
};

bool wants_any(Taking& taking, MeasureScope on, std::initializer_list<Name> names) {
  return std::any_of(names.begin(), names.end(),
                     [&](Name name) { return taking.column(on, name) != nullptr; });
}

}  // namespace

void take_bounds(Taking& taking) {
  Extents extents(taking);
  if (wants_any(taking, MeasureScope::mesh,
                {Name::size_x, Name::size_y, Name::size_z, Name::pivot_distance})) {
    ExtentColumns columns(taking, MeasureScope::mesh);
    for (std::uint32_t mesh = 0; mesh < taking.count(MeasureScope::mesh); ++mesh) {
      columns.take(mesh, extents.of_mesh(mesh));
    }
  }
  if (!wants_any(
          taking, MeasureScope::scene,
          {Name::size_x, Name::size_y, Name::size_z, Name::size_max, Name::min_x, Name::min_y,
           Name::min_z, Name::max_x, Name::max_y, Name::max_z, Name::center_x, Name::center_y,
           Name::center_z, Name::origin_distance, Name::product_deviation,
           Name::product_deviation_x, Name::product_deviation_y, Name::product_deviation_z})) {
    return;
  }
  ExtentColumns columns(taking, MeasureScope::scene);
  SceneWork work(taking.source());
  for (std::uint32_t scene = 0; scene < taking.count(MeasureScope::scene); ++scene) {
    Extents::Extent extent;
    extent.failure = Failure::too_much;
    if (work.take(taking.source().views().nodes.size())) extent = extents.of_scene(scene);
    columns.take(scene, extent);
  }
}

}  // namespace gltfx::measure

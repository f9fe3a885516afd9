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

#include "base/packed.hpp"
#include "measure/drawn.hpp"
#include "measure/shape.hpp"
#include "measure/take.hpp"

namespace gltfx::measure {
namespace {

using model::Affine;
using model::NodeIndex;
using model::Vector3;

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

Vector3 wide(const Float3& at) {
  return {static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
}

// The vertices that elements of primitives draw.
struct DrawnVertices {
  std::vector<Float3> points;
  Box box;

  // `known`: by vertex, whether it has been added.
  void add(const model::Geometry& geometry, std::vector<bool>& known) {
    const auto add = [&](std::uint32_t vertex) {
      if (known[vertex]) return;
      known[vertex] = true;
      points.push_back(geometry.positions[vertex]);
      box.add(wide(points.back()));
    };
    for (const auto& triangle : geometry.triangles)
      std::for_each(triangle.begin(), triangle.end(), add);
    for (const auto& segment : geometry.segments)
      std::for_each(segment.begin(), segment.end(), add);
    std::for_each(geometry.points.begin(), geometry.points.end(), add);
  }
};

// Whether each axis goes to one axis: the corners of a box tell the rest.
bool keeps_axes(const Affine& transform) {
  for (std::size_t column = 0; column < 3; ++column) {
    const auto& axis = transform.columns[column];
    if (std::count(axis.begin(), axis.end(), 0.0) < 2) return false;
  }
  return true;
}

class Extents {
 public:
  explicit Extents(Taking& taking)
      : source_(taking.source()), budget_(geometry_bytes(source_)), drawn_(source_) {}

  struct Extent {
    Box box;
    std::string_view why;  // not empty: it is not known
  };

  // In the space of the mesh, without morph targets and skins.
  Extent of_mesh(std::uint32_t mesh) {
    Extent extent;
    extent.box = rigid_box(mesh, extent.why);
    return extent;
  }

  Extent of_scene(std::uint32_t scene) {
    Extent extent;
    drawn_.enter(scene);
    for (const auto& [mesh, nodes] : drawn_.by_mesh()) {
      rigid_.reset();
      for (const NodeIndex node : nodes) {
        add(node, mesh, extent);
        if (!extent.why.empty()) return extent;
      }
    }
    return extent;
  }

 private:
  void add(NodeIndex node, std::uint32_t mesh, Extent& extent) {
    const auto pose = drawn_.pose_of(node);
    if (!pose) {
      extent.why = drawn_.why();
      return;
    }
    const std::vector<Affine> transforms = drawn_.transforms_of(node, *pose);
    if (transforms.empty()) extent.why = drawn_.why();
    if (!pose->is_rigid()) {
      const DrawnVertices vertices = vertices_of(mesh, *pose, extent.why);
      for (const Affine& transform : transforms) add(vertices, transform, extent);
      return;
    }
    const Box box = rigid_box(mesh, extent.why);
    for (const Affine& transform : transforms) {
      if (!extent.why.empty() || box.empty()) return;
      if (keeps_axes(transform)) {
        add(box, transform, extent);
        continue;
      }
      if (!rigid_) rigid_ = vertices_of(mesh, {}, extent.why);
      add(*rigid_, transform, extent);
    }
  }

  static void add(const Box& box, const Affine& transform, Extent& extent) {
    extent.box.add(transform.point(box.least));
    extent.box.add(transform.point(box.greatest));
  }
  void add(const DrawnVertices& vertices, const Affine& transform, Extent& extent) {
    if (vertices.box.empty()) return;
    if (keeps_axes(transform)) return add(vertices.box, transform, extent);
    if (vertices.points.size() > kMostTransforms - transforms_) {
      extent.why = "There are too many vertices and copies.";
      return;
    }
    transforms_ += vertices.points.size();
    for (const Float3& point : vertices.points) extent.box.add(transform.point(wide(point)));
  }

  // Without its points, so that those of all meshes may be kept.
  Box rigid_box(std::uint32_t mesh, std::string_view& why) {
    const auto known = rigid_boxes_.find(mesh);
    if (known != rigid_boxes_.end()) {
      if (!known->second.why.empty()) why = known->second.why;
      return known->second.box;
    }
    Extent& extent = rigid_boxes_[mesh];
    rigid_ = vertices_of(mesh, {}, extent.why);
    extent.box = rigid_->box;
    if (!extent.why.empty()) why = extent.why;
    return extent.box;
  }

  DrawnVertices vertices_of(std::uint32_t mesh, const MeshPose& pose, std::string_view& why) {
    model::GeometryRequest request;
    request.weights = pose.weights;
    request.joints = pose.joints;
    request.surface = false;
    DrawnVertices vertices;
    std::vector<bool> known;  // of the last vertices
    const auto primitives = pointers_to(source_.views().meshes[mesh].primitives);
    read_primitives(source_, primitives, request, budget_, [&](const ReadPrimitive& read) {
      const std::uint64_t count = read.geometry.positions.size();
      const bool affordable = !read.fresh || budget_.take(count * sizeof(Float3));
      if (!affordable || read.error == model::GeometryError::too_large) {
        why = kTooLarge;
      } else if (is_fault(read.error)) {
        why = kUnreadVertices;
      } else {
        if (read.fresh) known.assign(static_cast<std::size_t>(count), false);
        vertices.add(read.geometry, known);
      }
      return why.empty();
    });
    return vertices;
  }

  const Source& source_;
  model::MemoryBudget budget_;
  DrawnMeshes drawn_;
  std::uint64_t transforms_ = 0;
  std::map<std::uint32_t, Extent> rigid_boxes_;  // by mesh
  std::optional<DrawnVertices> rigid_;           // of the last mesh
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
    if (!extent.why.empty()) {
      column->could_not_be_taken(element, extent.why);
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
  for (std::uint32_t scene = 0; scene < taking.count(MeasureScope::scene); ++scene) {
    Extents::Extent extent;
    extent.why = kTooManyScenes;
    if (is_affordable(taking.source(), scene)) extent = extents.of_scene(scene);
    columns.take(scene, extent);
  }
}

}  // namespace gltfx::measure

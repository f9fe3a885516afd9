// SPDX-License-Identifier: Apache-2.0
#include "model/shape.hpp"

#include <algorithm>
#include <cmath>

#include "model/double_array.hpp"
#include "model/fields.hpp"

namespace gltfx::model {
namespace {

Vector3 vector_member(const json::Document& document, json::NodeId object, std::string_view name,
                      const Vector3& absent) {
  return double_array<3>(document, document.find(object, name)).value_or(absent);
}

Vector3 half_size(const json::Document& document, const ShapeObject& shape) {
  if (shape.type == "box") {
    Vector3 half{1, 1, 1};
    if (shape.form != json::kNoNode) half = vector_member(document, shape.form, "size", half);
    for (double& each : half) each /= 2;
    return half;
  }
  const double radius = shape.form == json::kNoNode
                            ? 0.5
                            : number_member(document, shape.form, "radius").value_or(0.5);
  return {radius, radius, radius};
}

std::optional<BoundingVolume> read_volume(const Asset& asset, const Node& node,
                                          const std::vector<ShapeObject>& shapes) {
  const json::Document& document = asset.document();
  if (node.object == json::kNoNode) return std::nullopt;
  const json::NodeId object = object_member(document, node.object, "boundingVolume");
  if (object == json::kNoNode) return std::nullopt;
  const auto index = unsigned_member(document, object, "shape");
  if (!index || *index >= shapes.size()) return std::nullopt;
  const ShapeObject& shape = shapes[static_cast<std::size_t>(*index)];
  const bool is_box = shape.type == "box";
  if (!is_box && shape.type != "sphere") return std::nullopt;
  BoundingVolume volume;
  volume.object = object;
  volume.shape = static_cast<std::uint32_t>(*index);
  volume.is_box = is_box;
  volume.half = half_size(document, shape);
  const Vector3 scale = vector_member(document, object, "scale", {1, 1, 1});
  for (std::size_t k = 0; k < 3; ++k) volume.half[k] *= std::abs(scale[k]);
  volume.center = vector_member(document, object, "translation", {});
  volume.rotation =
      unit(double_array<4>(document, document.find(object, "rotation")).value_or(volume.rotation));
  return volume;
}

double length_of(const Vector3& of) { return std::hypot(of[0], of[1], of[2]); }

// From a point outside of an ellipsoid to its nearest point, r * r * p / (r * r + t) for the t that
// puts it on the surface (D. Eberly, "Distance from a Point to an Ellipse, an Ellipsoid, or a
// Hyperellipsoid", 2013).
double distance_to_ellipsoid(const Vector3& radii, const Vector3& point) {
  constexpr int kHalvings = 80;
  double least = 0;
  double most = length_of({radii[0] * point[0], radii[1] * point[1], radii[2] * point[2]});
  const auto part = [&](std::size_t k, double t) {
    const double below = radii[k] * radii[k] + t;
    return below > 0 ? point[k] / below : 0;
  };
  for (int i = 0; i < kHalvings && least < most; ++i) {
    const double t = least / 2 + most / 2;
    const bool outside =
        length_of({radii[0] * part(0, t), radii[1] * part(1, t), radii[2] * part(2, t)}) > 1;
    (outside ? least : most) = t;
  }
  Vector3 way{};
  for (std::size_t k = 0; k < 3; ++k) {
    way[k] = radii[k] > 0 ? point[k] - radii[k] * radii[k] * part(k, most) : point[k];
  }
  return length_of(way);
}

}  // namespace

std::vector<ShapeObject> read_shapes(const Asset& asset) {
  const json::Document& document = asset.document();
  std::vector<ShapeObject> shapes;
  const json::NodeId array = document.find(document.root(), "shapes");
  if (array == json::kNoNode || document.kind(array) != json::Kind::array) return shapes;
  for (const json::NodeId element : document.elements(array)) {
    ShapeObject& shape = shapes.emplace_back();
    if (!document.is_object(element)) continue;
    shape.object = element;
    shape.type = string_member(document, element, "type");
    if (!shape.type.empty()) shape.form = object_member(document, element, shape.type);
    if (shape.form == json::kNoNode || (shape.type != "mesh" && !shape.is_convex())) continue;
    shape.mesh_value = document.find(shape.form, "mesh");
    shape.mesh = asset.index(shape.form, "mesh", RootArray::meshes);
  }
  return shapes;
}

Affine BoundingVolume::to_frame() const {
  const Quaternion back{-rotation[0], -rotation[1], -rotation[2], rotation[3]};
  Affine turned = Affine::from_parts({}, back, {1, 1, 1});
  const Vector3 moved = turned.vector(center);
  turned.columns[3] = {-moved[0], -moved[1], -moved[2]};
  return turned;
}

double BoundingVolume::distance(const Vector3& point) const {
  Vector3 at{};
  for (std::size_t k = 0; k < 3; ++k) at[k] = std::abs(point[k]);
  if (is_box) {
    const Vector3 beyond{at[0] - half[0], at[1] - half[1], at[2] - half[2]};
    const double most = std::max({beyond[0], beyond[1], beyond[2]});
    if (most <= 0) return most;
    return length_of(
        {std::max(beyond[0], 0.0), std::max(beyond[1], 0.0), std::max(beyond[2], 0.0)});
  }
  const double least = std::min({half[0], half[1], half[2]});
  if (least == half[0] && least == half[1] && least == half[2]) return length_of(at) - least;
  Vector3 part{};
  for (std::size_t k = 0; k < 3; ++k) {
    part[k] = half[k] > 0 ? at[k] / half[k] : (at[k] > 0 ? HUGE_VAL : 0);
  }
  const double inside = length_of(part);
  return inside <= 1 ? (inside - 1) * least : distance_to_ellipsoid(half, at);
}

double BoundingVolume::size() const {
  return 2 * (is_box ? length_of(half) : std::max({half[0], half[1], half[2]}));
}

std::vector<std::optional<BoundingVolume>> read_bounding_volumes(const Asset& asset,
                                                                 const std::vector<Node>& nodes) {
  std::vector<std::optional<BoundingVolume>> volumes(nodes.size());
  const std::vector<ShapeObject> shapes = read_shapes(asset);
  if (shapes.empty()) return volumes;
  for (std::size_t i = 0; i < nodes.size(); ++i) volumes[i] = read_volume(asset, nodes[i], shapes);
  return volumes;
}

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
/// The shapes of glTF 2.1 ("Shapes").
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/asset.hpp"
#include "model/node.hpp"

namespace gltfx::model {

/// One element of `shapes`. Absent parts are json::kNoNode.
struct ShapeObject {
  json::NodeId object = json::kNoNode;      ///< kNoNode: the element of the array is not an object
  std::string type;                         ///< "box"; empty: none
  json::NodeId form = json::kNoNode;        ///< the member by the name of the type
  json::NodeId mesh_value = json::kNoNode;  ///< the index in the text, of the types with a mesh
  std::optional<std::uint32_t> mesh;        ///< index of an object

  bool is_convex() const { return type == "convexMesh"; }
};

/// All shapes, by index.
std::vector<ShapeObject> read_shapes(const Asset& asset);

/// A box or a sphere around the geometry of a node. Its frame has the origin in the middle and the
/// axes of the shape, in the units of the node.
struct BoundingVolume {
  json::NodeId object = json::kNoNode;  ///< the value of `boundingVolume`
  std::uint32_t shape = 0;              ///< index
  bool is_box = true;                   ///< else a sphere, which `scale` may make an ellipsoid
  Vector3 half{};                       ///< half of the size along each axis, scaled
  Vector3 center{};                     ///< in the space of the node
  Quaternion rotation{0, 0, 0, 1};      ///< from the frame to the node, of length 1

  /// From the space of the node to the frame.
  Affine to_frame() const;
  /// From a point in the frame to the volume; negative inside. It does not decrease when the
  /// absolute value of a coordinate grows.
  double distance(const Vector3& point) const;
  /// The diagonal of a box, the greatest diameter of a sphere.
  double size() const;
};

/// By node, the volumes whose shape is a box or a sphere.
std::vector<std::optional<BoundingVolume>> read_bounding_volumes(const Asset& asset,
                                                                 const std::vector<Node>& nodes);

}  // namespace gltfx::model

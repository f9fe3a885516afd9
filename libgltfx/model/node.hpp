// SPDX-License-Identifier: Apache-2.0
/// Nodes of the scene graph, lists of their indices, and their transforms: translation, rotation,
/// scale, and matrices of them (specification section 3.5).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "model/asset.hpp"

namespace gltfx::model {

using Vector3 = std::array<double, 3>;
/// x, y, z, w, as glTF writes rotations.
using Quaternion = std::array<double, 4>;

/// A matrix of three rows: what glTF's transforms are, whose fourth row is always 0 0 0 1. Double
/// precision, so that long chains of parents add no visible error.
struct Affine {
  /// The columns x, y, z of the linear part, then the translation.
  std::array<Vector3, 4> columns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};

  /// From a column-major 4 x 4 matrix; its last row is ignored.
  static Affine from_matrix(const std::array<float, 16>& matrix);
  /// Scale first, then rotation, then translation. The rotation need not be of unit length; one of
  /// length zero has no effect.
  static Affine from_parts(const Vector3& translation, const Quaternion& rotation,
                           const Vector3& scale);

  Vector3 point(const Vector3& at) const;
  Vector3 vector(const Vector3& along) const;
  /// Determinant of the linear part: negative if the transform mirrors.
  double determinant() const;
  bool operator==(const Affine&) const = default;
};

/// Applies `inner` first, then `outer`.
Affine operator*(const Affine& outer, const Affine& inner);

inline double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector3 cross(const Vector3& a, const Vector3& b);
/// The unit vector in the direction of `a`; zero if `a` is zero.
inline Vector3 unit(const Vector3& a) {
  const double length = std::sqrt(dot(a, a));
  if (!(length > 0)) return {};
  const double scale = 1 / length;
  return {a[0] * scale, a[1] * scale, a[2] * scale};
}

/// Interpolates two rotations along the shorter arc, for `t` from 0 to 1; of unit length.
Quaternion slerp(const Quaternion& from, const Quaternion& to, double t);
/// Normalizes to unit length; gives the identity for length 0.
Quaternion unit(const Quaternion& q);

/// Position of a node in the root array `nodes`.
using NodeIndex = std::uint32_t;
inline constexpr NodeIndex kNoNodeIndex = UINT32_MAX;

/// One node. Absent members are json::kNoNode, broken indices are empty.
struct Node {
  json::NodeId object = json::kNoNode;  ///< kNoNode: the element of the array is not an object
  json::NodeId matrix = json::kNoNode;
  json::NodeId translation = json::kNoNode;
  json::NodeId rotation = json::kNoNode;
  json::NodeId scale = json::kNoNode;
  json::NodeId children = json::kNoNode;
  json::NodeId weights = json::kNoNode;
  json::NodeId extensions = json::kNoNode;
  json::NodeId extras = json::kNoNode;
  json::NodeId mesh_value = json::kNoNode;    ///< the index in the text
  json::NodeId camera_value = json::kNoNode;  ///< likewise
  json::NodeId skin_value = json::kNoNode;    ///< likewise
  std::optional<std::uint32_t> mesh;
  std::optional<std::uint32_t> camera;
  std::optional<std::uint32_t> skin;
};

/// Reads a node in one pass over its members; the last of repeated ones counts.
Node read_node(const Asset& asset, json::NodeId object);

/// All nodes, by index.
std::vector<Node> read_nodes(const Asset& asset);

/// `count` numbers of an array, rounded to single precision into `values`. False when the value is
/// not an array of exactly so many finite numbers within [least, most].
bool read_floats(const json::Document& document, json::NodeId array, std::size_t count,
                 float* values, double least = -std::numeric_limits<double>::infinity(),
                 double most = std::numeric_limits<double>::infinity());

/// An array member of N numbers as single precision, or nothing when it is absent or malformed.
template <std::size_t N>
std::optional<std::array<float, N>> float_array(
    const json::Document& document, json::NodeId array,
    double least = -std::numeric_limits<double>::infinity(),
    double most = std::numeric_limits<double>::infinity()) {
  std::array<float, N> values{};
  if (!read_floats(document, array, N, values.data(), least, most)) return std::nullopt;
  return values;
}

/// The local transform of a node as it is written; malformed members count as absent.
struct Transform {
  std::optional<std::array<float, 16>> matrix;  ///< column-major
  std::optional<std::array<float, 3>> translation;
  std::optional<std::array<float, 4>> rotation;  ///< x, y, z, w; each within [-1, 1]
  std::optional<std::array<float, 3>> scale;
  /// Whether nothing is written, or only values without effect.
  bool is_identity() const;
};
Transform read_transform(const json::Document& document, const Node& node);

/// Calls `use(position, index, span)` for every element of an array of indices: `index` is a
/// std::optional, empty when the element is not an index of an object in `target`; `span` is the
/// element's place in the text. Does nothing for a value that is not an array.
template <typename Use>
void for_each_index(const Asset& asset, json::NodeId array, RootArray target, Use use) {
  const json::Document& document = asset.document();
  if (array == json::kNoNode) return;
  std::uint64_t position = 0;
  if (document.kind(array) == json::Kind::number_array) {
    for (json::NumberCursor at(document, array); at.valid(); at.advance()) {
      use(position++, asset.index(at.number().value, target), at.number().span);
    }
  } else if (document.kind(array) == json::Kind::array) {
    for (const json::NodeId element : document.elements(array)) {
      const auto index = document.is_number(element)
                             ? asset.index(document.number(element).value, target)
                             : std::nullopt;
      use(position++, index, document.span(element));
    }
  }
}

}  // namespace gltfx::model

// SPDX-License-Identifier: Apache-2.0
#include "model/node.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace gltfx::model {
namespace {

// Nearly parallel rotations are blended linearly, to avoid a division by the sine of their angle.
constexpr double kNearlyParallel = 1 - 1e-9;

template <std::size_t N>
std::array<double, N> combine(const std::array<double, N>& a, double by_a,
                              const std::array<double, N>& b, double by_b) {
  std::array<double, N> sum{};
  for (std::size_t i = 0; i < N; ++i) sum[i] = a[i] * by_a + b[i] * by_b;
  return sum;
}

template <std::size_t N>
double inner_product(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
  return sum;
}

Vector3 times(const Vector3& a, double factor) { return combine(a, factor, a, 0); }

constexpr std::array<float, 16> kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

std::optional<std::uint32_t> index_of(const Asset& asset, json::NodeId value, RootArray array) {
  const json::Document& document = asset.document();
  if (value == json::kNoNode || !document.is_number(value)) return std::nullopt;
  return asset.index(document.number(value).value, array);
}

using Field = json::NodeId Node::*;
constexpr std::pair<std::string_view, Field> kFields[] = {
    {"mesh", &Node::mesh_value},
    {"children", &Node::children},
    {"translation", &Node::translation},
    {"rotation", &Node::rotation},
    {"scale", &Node::scale},
    {"matrix", &Node::matrix},
    {"skin", &Node::skin_value},
    {"camera", &Node::camera_value},
    {"weights", &Node::weights},
    {"extensions", &Node::extensions},
    {"extras", &Node::extras},
};

// By KeyId: the field that a member of that name fills, or null. Large files have a million nodes.
std::vector<Field> fields_by_key(const json::Document& document) {
  std::vector<Field> fields(document.key_count(), nullptr);
  for (const auto& [name, field] : kFields) {
    const json::KeyId key = document.key_id(name);
    if (key != json::kNoKey) fields[key] = field;
  }
  return fields;
}

void read_indices(const Asset& asset, Node& node) {
  node.mesh = index_of(asset, node.mesh_value, RootArray::meshes);
  node.camera = index_of(asset, node.camera_value, RootArray::cameras);
  node.skin = index_of(asset, node.skin_value, RootArray::skins);
}

template <std::size_t N>
bool is_absent_or(const std::optional<std::array<float, N>>& value,
                  const std::array<float, N>& neutral) {
  return !value || *value == neutral;
}

}  // namespace

Affine Affine::from_matrix(const std::array<float, 16>& matrix) {
  Affine affine;
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      affine.columns[column][row] = static_cast<double>(matrix[column * 4 + row]);
    }
  }
  return affine;
}

Affine Affine::from_parts(const Vector3& translation, const Quaternion& rotation,
                          const Vector3& scale) {
  const auto [x, y, z, w] = unit(rotation);
  Affine affine;
  affine.columns[0] =
      times({1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)}, scale[0]);
  affine.columns[1] =
      times({2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)}, scale[1]);
  affine.columns[2] =
      times({2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}, scale[2]);
  affine.columns[3] = translation;
  return affine;
}

Vector3 Affine::vector(const Vector3& along) const {
  Vector3 result{};
  for (std::size_t row = 0; row < 3; ++row) {
    result[row] =
        columns[0][row] * along[0] + columns[1][row] * along[1] + columns[2][row] * along[2];
  }
  return result;
}

Vector3 Affine::point(const Vector3& at) const { return combine(vector(at), 1, columns[3], 1); }

double Affine::determinant() const { return dot(cross(columns[0], columns[1]), columns[2]); }

Affine operator*(const Affine& outer, const Affine& inner) {
  Affine product;
  for (std::size_t i = 0; i < 3; ++i) product.columns[i] = outer.vector(inner.columns[i]);
  product.columns[3] = outer.point(inner.columns[3]);
  return product;
}

Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Quaternion unit(const Quaternion& q) {
  const double length = std::sqrt(inner_product(q, q));
  return length > 0 ? combine(q, 1 / length, q, 0) : Quaternion{0, 0, 0, 1};
}

Quaternion slerp(const Quaternion& from, const Quaternion& to, double t) {
  const Quaternion a = unit(from);
  Quaternion b = unit(to);
  double cosine = inner_product(a, b);
  if (cosine < 0) {
    b = combine(b, -1, b, 0);
    cosine = -cosine;
  }
  if (cosine > kNearlyParallel) return unit(combine(a, 1 - t, b, t));
  const double angle = std::acos(cosine);
  return unit(combine(a, std::sin((1 - t) * angle), b, std::sin(t * angle)));
}

Node read_node(const Asset& asset, json::NodeId object) {
  Node node;
  node.object = object;
  if (object == json::kNoNode) return node;
  const json::Document& document = asset.document();
  for (const auto member : document.members(object)) {
    const std::string_view name = document.key(member.key_id);
    const auto* const field = std::find_if(std::begin(kFields), std::end(kFields),
                                           [&](const auto& each) { return each.first == name; });
    if (field != std::end(kFields)) node.*(field->second) = member.value;
  }
  read_indices(asset, node);
  return node;
}

std::vector<Node> read_nodes(const Asset& asset) {
  const json::Document& document = asset.document();
  const std::vector<Field> fields = fields_by_key(document);
  std::vector<Node> nodes(asset.count(RootArray::nodes));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Node& node = nodes[i];
    node.object = asset.elements(RootArray::nodes)[i];
    if (node.object == json::kNoNode) continue;
    for (const auto member : document.members(node.object)) {
      if (const Field field = fields[member.key_id]) node.*field = member.value;
    }
    read_indices(asset, node);
  }
  return nodes;
}

bool read_floats(const json::Document& document, json::NodeId array, std::size_t count,
                 float* values, double least, double most) {
  if (array == json::kNoNode || document.kind(array) != json::Kind::number_array) return false;
  if (document.array_size(array) != count) return false;
  for (json::NumberCursor at(document, array); at.valid(); at.advance()) {
    const double value = at.number().value;
    if (!std::isfinite(value) || value < least || value > most) return false;
    *values++ = static_cast<float>(value);
  }
  return true;
}

Transform read_transform(const json::Document& document, const Node& node) {
  Transform transform;
  transform.matrix = float_array<16>(document, node.matrix);
  transform.translation = float_array<3>(document, node.translation);
  transform.rotation = float_array<4>(document, node.rotation, -1, 1);
  transform.scale = float_array<3>(document, node.scale);
  return transform;
}

bool Transform::is_identity() const {
  return is_absent_or(matrix, kIdentity) && is_absent_or(translation, {0, 0, 0}) &&
         is_absent_or(rotation, {0, 0, 0, 1}) && is_absent_or(scale, {1, 1, 1});
}

}  // namespace gltfx::model

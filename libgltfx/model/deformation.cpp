// SPDX-License-Identifier: Apache-2.0
#include "model/deformation.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "model/skin.hpp"

namespace gltfx::model {
namespace {

class Morphing {
 public:
  Morphing(const PrimitiveData& data, std::span<const std::uint32_t> tex_coords, Geometry& geometry)
      : data_(data), tex_coords_(tex_coords), geometry_(geometry) {}

  void add(json::NodeId target, float weight) {
    for (const Attribute& attribute : read_attributes(data_.source().asset, target)) {
      add(attribute, weight);
    }
  }

 private:
  void add(const Attribute& attribute, float weight) {
    switch (attribute.semantic.kind) {
      case SemanticKind::position:
        return add(attribute, weight, 3, geometry_.positions);
      case SemanticKind::normal:
        return add(attribute, weight, 3, geometry_.normals);
      case SemanticKind::tangent:  // the handedness does not change
        return add(attribute, weight, 3, geometry_.tangents);
      case SemanticKind::color:
        if (attribute.semantic.set == 0) add(attribute, weight, 4, geometry_.colors);
        return;
      case SemanticKind::texcoord:
        return add_tex_coord(attribute, weight);
      default:
        return;
    }
  }

  void add_tex_coord(const Attribute& attribute, float weight) {
    const auto at = std::find(tex_coords_.begin(), tex_coords_.end(), attribute.semantic.set);
    if (at == tex_coords_.end()) return;
    add(attribute, weight, 2,
        geometry_.tex_coords[static_cast<std::size_t>(at - tex_coords_.begin())]);
  }

  template <std::size_t N>
  void add(const Attribute& attribute, float weight, unsigned components, Vectors<N>& to) {
    if (to.empty()) return;
    const auto elements = data_.open(attribute.accessor);
    if (!elements || elements->count() != to.size()) return;
    add_elements(*elements, weight, components, to);
  }

  const PrimitiveData& data_;
  std::span<const std::uint32_t> tex_coords_;
  Geometry& geometry_;
};

// A set of joints and its weights.
struct Influences {
  ElementBlocks joints, weights;
};

// By number of the set, which a file chooses freely.
std::vector<const Attribute*> sets_of(const Primitive& primitive, SemanticKind kind,
                                      std::size_t count) {
  std::vector<const Attribute*> sets(count);
  for (const Attribute& each : primitive.attributes) {
    if (each.semantic.kind == kind && each.semantic.set < count) sets[each.semantic.set] = &each;
  }
  return sets;
}

std::vector<Influences> open_influences(const PrimitiveData& data, std::size_t vertices) {
  std::vector<Influences> sets;
  const std::size_t count = joint_sets(data.primitive());
  const auto joints_of = sets_of(data.primitive(), SemanticKind::joints, count);
  const auto weights_of = sets_of(data.primitive(), SemanticKind::weights, count);
  const auto fits = [&](const std::optional<AccessorData>& elements) {
    return elements && elements->count() == vertices && elements->components() == 4;
  };
  for (std::size_t set = 0; set < count; ++set) {
    if (joints_of[set] == nullptr || weights_of[set] == nullptr)
      continue;  // missing, because another set is repeated
    auto joints = data.open(*joints_of[set]);
    auto weights = data.open(*weights_of[set]);
    if (!fits(joints) || !fits(weights)) continue;
    sets.push_back({ElementBlocks(*std::move(joints)), ElementBlocks(*std::move(weights))});
  }
  return sets;
}

// A partial weighted sum of matrices.
struct Blend {
  Affine sum{{}};
  double weight = 0;
  std::size_t first_joint = 0;

  void add(const Affine& joint, double by) {
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t r = 0; r < 3; ++r) sum.columns[c][r] += joint.columns[c][r] * by;
    }
    weight += by;
  }
};

Vector3 wide(const float* from) {
  return {static_cast<double>(from[0]), static_cast<double>(from[1]), static_cast<double>(from[2])};
}

void store(const Vector3& from, float* to) {
  for (std::size_t k = 0; k < 3; ++k) to[k] = static_cast<float>(from[k]);
}

class Skinning {
 public:
  Skinning(std::span<const Affine> joints, Geometry& geometry)
      : joints_(joints), geometry_(geometry) {}

  void run(std::vector<Influences> sets) {
    constexpr std::size_t kBlock = 1024;
    for (std::size_t first = 0; first < geometry_.positions.size(); first += kBlock) {
      const std::size_t count = std::min(kBlock, geometry_.positions.size() - first);
      std::vector<Blend> blends(count);
      for (std::size_t set = 0; set < sets.size(); ++set) add(sets[set], first, set == 0, blends);
      for (std::size_t i = 0; i < count; ++i) move(first + i, blends[i]);
    }
  }

 private:
  void add(Influences& set, std::size_t first, bool is_first, std::vector<Blend>& blends) {
    Vectors<4> joints(blends.size());
    Vectors<4> weights(blends.size());
    set.joints.read(first, joints);
    set.weights.read(first, weights);
    for (std::size_t i = 0; i < blends.size(); ++i) {
      if (is_first) blends[i].first_joint = static_cast<std::size_t>(joints[i][0]);
      for (std::size_t k = 0; k < 4; ++k) {
        const auto joint = static_cast<std::size_t>(joints[i][k]);
        if (!(weights[i][k] > 0) || joint >= joints_.size()) continue;
        blends[i].add(joints_[joint], static_cast<double>(weights[i][k]));
      }
    }
  }

  void move(std::size_t vertex, const Blend& blend) {
    Affine matrix = blend.sum;
    if (blend.weight > 0) {
      for (auto& column : matrix.columns) {
        for (double& value : column) value /= blend.weight;
      }
    } else {
      matrix = joints_[std::min(blend.first_joint, joints_.size() - 1)];
    }
    float* position = geometry_.positions[vertex].data();
    const Vector3 from = wide(position);
    const Vector3& origin = geometry_.origin;
    store(matrix.point({from[0] + origin[0], from[1] + origin[1], from[2] + origin[2]}), position);
    if (!geometry_.normals.empty()) turn(vertex, matrix);
  }

  // Normals use the inverse transpose, up to their length: the matrix of cofactors, which exists
  // for singular matrices, too.
  void turn(std::size_t vertex, const Affine& matrix) {
    const auto& [x, y, z, t] = matrix.columns;
    const double side = matrix.determinant() < 0 ? -1 : 1;
    const Affine cofactors{{cross(y, z), cross(z, x), cross(x, y), t}};
    float* normal = geometry_.normals[vertex].data();
    const Vector3 turned = unit(cofactors.vector(wide(normal)));
    store({turned[0] * side, turned[1] * side, turned[2] * side}, normal);
    if (geometry_.tangents.empty()) return;
    float* tangent = geometry_.tangents[vertex].data();
    store(unit(matrix.vector(wide(tangent))), tangent);
    if (side < 0) tangent[3] = -tangent[3];
  }

  std::span<const Affine> joints_;
  Geometry& geometry_;
};

}  // namespace

void morph(const PrimitiveData& data, std::span<const float> weights,
           std::span<const std::uint32_t> tex_coords, Geometry& geometry) {
  const auto& targets = data.primitive().targets;
  Morphing morphing(data, tex_coords, geometry);
  for (std::size_t i = 0; i < std::min(targets.size(), weights.size()); ++i) {
    if (weights[i] != 0) morphing.add(targets[i], weights[i]);
  }
}

bool skin(const PrimitiveData& data, std::span<const Affine> joints, Geometry& geometry) {
  std::vector<Influences> sets = open_influences(data, geometry.positions.size());
  if (sets.empty()) return false;
  Skinning(joints, geometry).run(std::move(sets));
  geometry.origin = {};
  return true;
}

}  // namespace gltfx::model

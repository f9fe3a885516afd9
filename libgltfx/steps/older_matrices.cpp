// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "model/animation.hpp"
#include "model/node.hpp"
#include "steps/json_edits.hpp"
#include "steps/older_version.hpp"

namespace gltfx::steps {
namespace {

using model::Affine;
using model::Quaternion;
using model::Vector3;

// The difference of an axis before and after, as a part of its length, up to which it is rounded.
constexpr double kRounded = 1e-5;

/// The parts of a matrix, in single precision.
struct MatrixParts {
  std::array<float, 3> translation{};
  std::array<float, 4> rotation{};
  std::array<float, 3> scale{};
};

// Shepperd's method, for axes of unit length that do not mirror.
Quaternion quaternion_of(const std::array<Vector3, 3>& axes) {
  const auto at = [&](std::size_t row, std::size_t column) { return axes[column][row]; };
  const double trace = at(0, 0) + at(1, 1) + at(2, 2);
  if (trace > 0) {
    const double s = std::sqrt(trace + 1) * 2;
    return {(at(2, 1) - at(1, 2)) / s, (at(0, 2) - at(2, 0)) / s, (at(1, 0) - at(0, 1)) / s, s / 4};
  }
  std::size_t i = at(0, 0) < at(1, 1) ? 1 : 0;
  if (at(i, i) < at(2, 2)) i = 2;
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  const double s = std::sqrt(at(i, i) - at(j, j) - at(k, k) + 1) * 2;
  Quaternion q{};
  q[i] = s / 4;
  q[j] = (at(i, j) + at(j, i)) / s;
  q[k] = (at(i, k) + at(k, i)) / s;
  q[3] = (at(k, j) - at(j, k)) / s;
  return q;
}

// Nothing: the matrix shears, or has an axis without length.
std::optional<MatrixParts> parts_of_matrix(const Affine& matrix) {
  std::array<Vector3, 3> axes{matrix.columns[0], matrix.columns[1], matrix.columns[2]};
  Vector3 scale{};
  for (std::size_t i = 0; i < 3; ++i) {
    scale[i] = std::sqrt(model::dot(axes[i], axes[i]));
    if (!(scale[i] > 0)) return std::nullopt;
  }
  if (matrix.determinant() < 0) scale[0] = -scale[0];
  for (std::size_t i = 0; i < 3; ++i) {
    for (double& each : axes[i]) each /= scale[i];
  }
  const Quaternion rotation = model::unit(quaternion_of(axes));
  const Affine again = Affine::from_parts(matrix.columns[3], rotation, scale);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t row = 0; row < 3; ++row) {
      const double off = std::abs(again.columns[i][row] - matrix.columns[i][row]);
      if (!(off <= kRounded * std::abs(scale[i]))) return std::nullopt;
    }
  }
  MatrixParts parts;
  for (std::size_t i = 0; i < 3; ++i) {
    parts.translation[i] = static_cast<float>(matrix.columns[3][i]);
    parts.scale[i] = static_cast<float>(scale[i]);
  }
  for (std::size_t i = 0; i < 4; ++i) parts.rotation[i] = static_cast<float>(rotation[i]);
  return parts;
}

}  // namespace

void split_matrices(OlderVersion& asset) {
  const StepData& data = asset.data;
  std::set<model::NodeIndex> nodes;
  for (const model::Animation& animation : data.views.animations) {
    for (const model::AnimationChannel& channel : animation.channels) {
      if (channel.path == model::AnimationPath::weights && channel.node)
        nodes.insert(*channel.node);
    }
  }
  for (const model::NodeIndex index : nodes) {
    const model::Node& node = data.views.nodes[index];
    if (node.object == json::kNoNode || node.matrix == json::kNoNode) continue;
    const auto matrix = model::float_array<16>(data.document, node.matrix);
    const auto parts = matrix ? parts_of_matrix(Affine::from_matrix(*matrix)) : std::nullopt;
    if (!parts) {
      asset.refuse(node.object, "has a matrix that is no translation, rotation and scale");
      continue;
    }
    asset.other_objects = true;
    json::Editor& editor = asset.changes.editor;
    remove_member(data.document, editor, node.object, "matrix");
    for (const char* name : {"translation", "rotation", "scale"}) {
      remove_member(data.document, editor, node.object, name);
    }
    editor.append_member(node.object, "translation",
                         fmt::format("[{}]", fmt::join(parts->translation, ",")));
    editor.append_member(node.object, "rotation",
                         fmt::format("[{}]", fmt::join(parts->rotation, ",")));
    editor.append_member(node.object, "scale", fmt::format("[{}]", fmt::join(parts->scale, ",")));
  }
}

}  // namespace gltfx::steps

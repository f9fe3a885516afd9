// SPDX-License-Identifier: Apache-2.0
// The local transform of a node: in one form only, and decomposable (specification section 3.5.3).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "model/node.hpp"
#include "rules/context.hpp"
#include "rules/core/animated.hpp"
#include "rules/core/rotation.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"

namespace gltfx::validate {
namespace {

using Matrix = std::array<float, 16>;
using Vector = std::array<double, 3>;
using Rotation = std::array<Vector, 3>;  // columns

// Cosine of the angle between two axes above which a matrix shears for certain: half a degree.
constexpr double kShear = 0.01;
constexpr double kNormTolerance = 0.00005;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector column(const Matrix& m, std::size_t c) { return {m[4 * c], m[4 * c + 1], m[4 * c + 2]}; }

double determinant(const Rotation& m) {
  return m[0][0] * (m[1][1] * m[2][2] - m[2][1] * m[1][2]) -
         m[1][0] * (m[0][1] * m[2][2] - m[2][1] * m[0][2]) +
         m[2][0] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
}

// Largest sum of absolute values in a column.
double norm(const Rotation& m, const Matrix& whole) {
  double greatest = 0;
  for (const Vector& axis : m) {
    greatest = std::max(greatest, std::abs(axis[0]) + std::abs(axis[1]) + std::abs(axis[2]));
  }
  const double last = std::abs(double{whole[12]}) + std::abs(double{whole[13]}) +
                      std::abs(double{whole[14]}) + std::abs(double{whole[15]});
  return std::max(greatest, last);
}

// Shepperd's method: the quaternion x, y, z, w of a rotation matrix. Single precision, as in the
// established test.
std::array<float, 4> quaternion(const Rotation& r) {
  const double trace = r[0][0] + r[1][1] + r[2][2];
  std::array<float, 4> q{};
  if (trace > 0) {
    double s = std::sqrt(trace + 1);
    q[3] = static_cast<float>(s * 0.5);
    s = 0.5 / s;
    q[0] = static_cast<float>((r[1][2] - r[2][1]) * s);
    q[1] = static_cast<float>((r[2][0] - r[0][2]) * s);
    q[2] = static_cast<float>((r[0][1] - r[1][0]) * s);
    return q;
  }
  std::size_t i = r[0][0] < r[1][1] ? 1 : 0;
  if (r[i][i] < r[2][2]) i = 2;
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  double s = std::sqrt(r[i][i] - r[j][j] - r[k][k] + 1);
  q[i] = static_cast<float>(s * 0.5);
  s = 0.5 / s;
  q[3] = static_cast<float>((r[j][k] - r[k][j]) * s);
  q[j] = static_cast<float>((r[i][j] + r[j][i]) * s);
  q[k] = static_cast<float>((r[i][k] + r[k][i]) * s);
  return q;
}

Rotation rotation_of(const std::array<float, 4>& q) {
  const double x = q[0];
  const double y = q[1];
  const double z = q[2];
  const double w = q[3];
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
           {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
           {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}}};
}

bool shears(const Rotation& axes, const Vector& lengths) {
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    if (std::abs(dot(axes[a], axes[b])) > kShear * lengths[a] * lengths[b]) return true;
  }
  return false;
}

double rounded(double value) { return double{static_cast<float>(value)}; }

// Empty if the matrix can be decomposed, otherwise the reason, to follow "The matrix": "shears:
// ...". Column-major, single precision as everywhere in glTF. The test is the established one (the
// norm of the matrix after decomposition and composition changes by less than 0.00005), which
// accepts some sheared matrices; `strictly` also requires columns at right angles.
std::string_view why_not_decomposable(const Matrix& matrix, bool strictly) {
  if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0 || matrix[15] != 1) {
    return "its last row is not 0, 0, 0, 1";
  }
  const Rotation axes{column(matrix, 0), column(matrix, 1), column(matrix, 2)};
  const double det = determinant(axes);
  if (det == 0) return "its determinant is 0";
  Vector lengths{};
  for (std::size_t c = 0; c < 3; ++c) lengths[c] = std::sqrt(dot(axes[c], axes[c]));
  if (strictly && shears(axes, lengths)) return "its axes are not perpendicular";
  Vector scale = lengths;
  if (det < 0) scale[0] = -scale[0];
  Rotation turned = axes;
  for (std::size_t c = 0; c < 3; ++c) {
    for (double& part : turned[c]) part = rounded(part * rounded(1 / scale[c]));
  }
  Rotation again = rotation_of(quaternion(turned));
  for (std::size_t c = 0; c < 3; ++c) {
    for (double& part : again[c]) part = rounded(rounded(part) * rounded(scale[c]));
  }
  const double change = std::abs(norm(again, matrix) - norm(axes, matrix));
  return change < kNormTolerance ? "" : "translation, rotation and scale do not reproduce it";
}

// A little more than the error of a unit quaternion in 8 bits.
constexpr double kUnitTolerance = 0.00769;

void check_unit(const Context& context, json::NodeId rotation, const Path& path) {
  const auto value = model::float_array<4>(context.document, rotation, -1, 1);
  if (!value) return;
  double square = 0;
  for (const float part : *value) square += double{part} * part;
  const double length = std::sqrt(square);
  if (std::abs(length - 1) <= kUnitTolerance) return;
  std::string help;
  if (length > 0) {
    std::array<double, 4> unit{};
    for (std::size_t i = 0; i < 4; ++i) unit[i] = double{(*value)[i]} / length;
    help =
        fmt::format("write [{:.6g}, {:.6g}, {:.6g}, {:.6g}]", unit[0], unit[1], unit[2], unit[3]);
  }
  context.schema_sink.report(
      Path(path, "rotation"),
      finding_on(context, rotation, Code::ROTATION_NON_UNIT,
                 fmt::format("The quaternion has length {:.4g}; it must be 1.", length), help));
}

void check_matrix(const Context& context, const model::Node& node, const Path& path) {
  const model::Transform transform = model::read_transform(context.document, node);
  if (!transform.matrix) return;
  const Path at(path, "matrix");
  if (transform.translation || transform.rotation || transform.scale) {
    Finding finding = finding_on(
        context, node.matrix, Code::NODE_MATRIX_TRS,
        fmt::format("The node has both a matrix and {}.", transform.translation ? "a translation"
                                                          : transform.rotation  ? "a rotation"
                                                                                : "a scale"));
    finding.help = "remove the matrix, or remove translation, rotation and scale";
    context.schema_sink.report(at, std::move(finding));
  }
  model::Transform alone;
  alone.matrix = transform.matrix;
  if (alone.is_identity()) {
    context.schema_sink.report(at, finding_on(context, node.matrix, Code::NODE_MATRIX_DEFAULT,
                                              "The matrix is the identity, which is the default."));
    return;
  }
  const auto reason =
      why_not_decomposable(*transform.matrix, !context.deviations.matrices_compare_by_norm);
  if (reason.empty()) return;
  context.schema_sink.report(
      at,
      finding_on(
          context, node.matrix, Code::NODE_MATRIX_NON_TRS,
          fmt::format("The matrix cannot be decomposed into translation, rotation and scale: {}.",
                      reason)));
}

void check_node(const Context& context, json::NodeId object, const Path& path) {
  if (context.document.find(object, "matrix") == json::kNoNode) return;
  check_matrix(context, model::read_node(context.asset, object), path);
}

// By node: whether an animation writes its scale.
std::vector<bool> animated_scales(const Context& context) {
  std::vector<bool> animated(context.views.nodes.size());
  for (const model::Animation& animation : context.views.animations) {
    for (const model::AnimationChannel& channel : animation.channels) {
      if (channel.node && channel.path == model::AnimationPath::scale)
        animated[*channel.node] = true;
    }
  }
  return animated;
}

// A scale of zero at the start or end of an animation is the usual way to hide parts for a while.
void check_scales(const Context& context) {
  std::optional<std::vector<bool>> animated;  // made at the first zero
  std::optional<Animated> by_pointer;
  const auto& nodes = context.views.nodes;
  const Path root;
  const Path list(root, "nodes");
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].scale == json::kNoNode) continue;
    const auto scale = model::float_array<3>(context.document, nodes[i].scale);
    if (!scale) continue;
    const auto zeros = std::count(scale->begin(), scale->end(), 0.0F);
    if (zeros == 0) continue;
    if (!animated) animated = animated_scales(context);
    if (!by_pointer) by_pointer.emplace(context);
    if ((*animated)[i] || by_pointer->contains(fmt::format("/nodes/{}/scale", i))) continue;
    const Path node(list, std::uint64_t{i});
    report_link(context, Path(node, "scale"), nodes[i].scale, Code::NODE_SCALE_ZERO,
                zeros == 3
                    ? "The scale is 0 along all axes: the node and its descendants are invisible."
                    : "The scale is 0 along an axis: the node is flattened.");
  }
}

// --- Fixes ---

/// Both forms of a transform.
struct Forms {
  Forms(Fixing& fixing, json::NodeId object)
      : node(model::read_node(fixing.elements(), object)),
        parts(model::read_transform(fixing.document(), node)) {
    std::swap(whole.matrix, parts.matrix);
  }
  /// Readers may draw a malformed value differently.
  bool are_sound() const {
    const auto is_sound = [](json::NodeId member, const auto& value) {
      return member == json::kNoNode || value;
    };
    const auto& m = whole.matrix;
    return m && (*m)[3] == 0 && (*m)[7] == 0 && (*m)[11] == 0 && (*m)[15] == 1 &&
           is_sound(node.translation, parts.translation) &&
           is_sound(node.rotation, parts.rotation) && is_sound(node.scale, parts.scale);
  }
  bool are_equal() const;

  model::Node node;
  model::Transform parts, whole;
};

// Within single precision.
bool Forms::are_equal() const {
  const auto affine = [](const auto& list, auto otherwise) {
    for (std::size_t i = 0; list && i < otherwise.size(); ++i) otherwise[i] = double{(*list)[i]};
    return otherwise;
  };
  const auto a = model::Affine::from_matrix(*whole.matrix);
  const auto b = model::Affine::from_parts(affine(parts.translation, model::Vector3{0, 0, 0}),
                                           affine(parts.rotation, model::Quaternion{0, 0, 0, 1}),
                                           affine(parts.scale, model::Vector3{1, 1, 1}));
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      const double one = a.columns[column][row];
      const double other = b.columns[column][row];
      if (!(std::abs(one - other) <= 1e-6 * std::max(1.0, std::abs(one)))) return false;
    }
  }
  return true;
}

// Most viewers draw the matrix, and so does `bake`. So the matrix is deleted if the other form is
// equal, and the other form if it is the identity; a matrix that is the identity is kept if the
// other form is not.
bool keep_one_form(Fixing& fixing, const Subject& matrix) {
  const Forms forms(fixing, matrix.owner);
  if (!forms.are_sound()) return false;
  if (forms.are_equal()) return fixing.remove_member(forms.node.matrix);
  if (!forms.parts.is_identity()) return false;
  bool removed = false;
  for (const json::NodeId part : {forms.node.translation, forms.node.rotation, forms.node.scale}) {
    if (part != json::kNoNode) removed = fixing.remove_member(part) || removed;
  }
  return removed;
}

bool remove_default_matrix(Fixing& fixing, const Subject& matrix) {
  const Forms forms(fixing, matrix.owner);
  return forms.are_sound() && forms.parts.is_identity() && fixing.remove_member(matrix.value);
}

// The rotation is the same: readers normalize, or scale with the square of the length.
bool make_unit(Fixing& fixing, const Subject& rotation) {
  const auto value = model::float_array<4>(fixing.document(), rotation.value, -1, 1);
  if (!value) return false;
  double square = 0;
  for (const float part : *value) square += double{part} * part;
  if (square == 0) return false;
  std::array<float, 4> unit{};
  for (std::size_t i = 0; i < 4; ++i) {
    unit[i] = static_cast<float>(double{(*value)[i]} / std::sqrt(square)) + 0.0F;
  }
  return fixing.replace(rotation.value,
                        fmt::format("[{}, {}, {}, {}]", unit[0], unit[1], unit[2], unit[3]));
}

constexpr FixEntry kTransformFixes[] = {{Code::NODE_MATRIX_DEFAULT, remove_default_matrix},
                                        {Code::NODE_MATRIX_TRS, keep_one_form},
                                        {Code::ROTATION_NON_UNIT, make_unit}};

}  // namespace

void check_rotation(const Context& context, json::NodeId object, const Path& path) {
  const json::NodeId rotation = context.document.find(object, "rotation");
  if (rotation != json::kNoNode) check_unit(context, rotation, path);
}

const RuleGroup& node_transform_rules() {
  static constexpr LinkRule kLinkRules[] = {check_scales};
  static constexpr ObjectRuleEntry kObjectRules[] = {{"node", check_rotation, "rotation"},
                                                     {"node", check_node}};
  static constexpr RuleGroup group{
      .object_rules = kObjectRules, .link_rules = kLinkRules, .fixes = kTransformFixes};
  return group;
}

}  // namespace gltfx::validate

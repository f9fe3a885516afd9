// SPDX-License-Identifier: Apache-2.0
// The local transform of a node: one form of it, and one that can be taken apart (specification
// section 3.5.3).
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/node.hpp"
#include "validate/context.hpp"
#include "validate/rules/animated.hpp"
#include "validate/rules/decompose.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

// What quantisation to 8 bits does to a unit quaternion, and a little more.
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

// Nodes are turned like this, and so are lights that surround the scene.
void check_rotation(const Context& context, json::NodeId object, const Path& path) {
  const json::NodeId rotation = context.document.find(object, "rotation");
  if (rotation != json::kNoNode) check_unit(context, rotation, path);
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

// A scale that an animation begins or ends with is how glTF hides parts for a while.
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

}  // namespace

const Family& node_transform_family() {
  static constexpr LinkRule kLinkRules[] = {check_scales};
  static constexpr ObjectRuleEntry kObjectRules[] = {
      {"node", check_rotation, "rotation"},
      {"node", check_node},
      {"EXT_lights_image_based.light", check_rotation}};
  static constexpr Family family{
      .order = 380, .object_rules = kObjectRules, .link_rules = kLinkRules};
  return family;
}

}  // namespace gltfx::validate

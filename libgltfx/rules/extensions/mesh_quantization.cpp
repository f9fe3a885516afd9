// SPDX-License-Identifier: Apache-2.0
// Meshes with quantized positions: the node that scales them back should not change their normals.
// This relates a node to the formats of its mesh.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "model/accessor.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

bool is_quantized(const Context& context, const model::Primitive& primitive) {
  const model::Attribute* position = primitive.find(model::SemanticKind::position);
  if (position == nullptr || !position->accessor) return false;
  const bool lit = primitive.find(model::SemanticKind::normal) != nullptr;
  return lit && model::is_integer(context.views.accessors[*position->accessor].format.component);
}

void check_node(const Context& context, const model::Node& node, const Path& path) {
  const auto scale = model::float_array<3>(context.document, node.scale);
  if (!node.mesh || !scale) return;
  const float first = std::abs((*scale)[0]);
  if (first == std::abs((*scale)[1]) && first == std::abs((*scale)[2])) return;
  const auto& primitives = context.views.meshes[*node.mesh].primitives;
  const bool quantized =
      std::any_of(primitives.begin(), primitives.end(),
                  [&](const model::Primitive& each) { return is_quantized(context, each); });
  if (!quantized) return;
  report_link(
      context, Path(path, "scale"), node.scale, Code::QUANTIZED_MESH_SCALE_NOT_UNIFORM,
      fmt::format("The quantized positions and normals of {} are scaled by {}, {} and {}.",
                  object_label(context, model::RootArray::meshes, *node.mesh),
                  number_text((*scale)[0]), number_text((*scale)[1]), number_text((*scale)[2])));
}

void check_nodes(const Context& context) {
  const Path root;
  const Path list(root, "nodes");
  const auto& nodes = context.views.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) check_node(context, nodes[i], Path(list, i));
}

}  // namespace

const RuleGroup& mesh_quantization_rules() {
  static constexpr LinkRule kLinkRules[] = {check_nodes};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
// Meshes with quantised positions: the node that scales them back should keep normals where they
// are. A relation of a node to the formats of its mesh.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text.hpp"
#include "model/accessor.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr RuleDescription kRules[] = {
    {"QUANTIZED_MESH_SCALE_NOT_UNIFORM", Severity::hint,
     "Quantised positions are scaled back by different factors",
     "Many readers turn normals and tangents like positions; scaled differently along the axes "
     "they no longer stand on the surface.",
     "Quantise all three axes with the same step.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [1, 2, 1]}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}],
 "accessors": [{"componentType": 5122, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC3", "count": 3}]})",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["KHR_mesh_quantization"], "extensionsRequired": ["KHR_mesh_quantization"],
 "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [2, 2, 2]}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}],
 "accessors": [{"componentType": 5122, "type": "VEC3", "count": 3, "min": [0, 0, 0], "max": [0, 0, 0]},
  {"componentType": 5126, "type": "VEC3", "count": 3}]})",
     Fix::none, false},
};

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
  report_link(context, Path(path, "scale"), node.scale, "QUANTIZED_MESH_SCALE_NOT_UNIFORM",
              fmt::format("Mesh {} has quantised positions and normals, and is scaled by {}, {} "
                          "and {}.",
                          *node.mesh, number_text((*scale)[0]), number_text((*scale)[1]),
                          number_text((*scale)[2])));
}

void check_nodes(const Context& context) {
  if (context.khronos()) return;
  const Path root;
  const Path list(root, "nodes");
  const auto& nodes = context.views.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) check_node(context, nodes[i], Path(list, i));
}

constexpr LinkRule kLinkRules[] = {check_nodes};

}  // namespace

const Family& quantization_family() {
  static const Family family{"quantization", kRules, {}, kLinkRules};
  return family;
}

}  // namespace gltfx::validate

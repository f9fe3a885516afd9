// SPDX-License-Identifier: Apache-2.0
#include "validate/rules/vertex_alpha.hpp"

namespace gltfx::validate {

VertexAlpha::VertexAlpha(const Context& context) {
  for (const model::Mesh& mesh : context.views.meshes) {
    for (const model::Primitive& primitive : mesh.primitives) add(context, primitive);
  }
}

void VertexAlpha::add(const Context& context, const model::Primitive& primitive) {
  const auto* color = primitive.find(model::SemanticKind::color);
  if (color == nullptr || !color->accessor) return;
  const model::Accessor& accessor = context.views.accessors[*color->accessor];
  if (accessor.format.type != model::ElementType::vec4) return;
  if (primitive.material) materials_.insert(*primitive.material);
  any_ = any_ || context.document.find(primitive.node, "extensions") != json::kNoNode;
}

}  // namespace gltfx::validate

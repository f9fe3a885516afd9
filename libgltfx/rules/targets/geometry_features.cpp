// SPDX-License-Identifier: Apache-2.0
// Features of accessors, primitives and morph targets.
#include <optional>
#include <set>
#include <string_view>

#include "model/fields.hpp"
#include "rules/targets/features.hpp"

namespace gltfx::validate {
namespace {

using model::ComponentType;
using model::SemanticKind;

class GeometryFeatures {
 public:
  GeometryFeatures(const Context& context, Features& features)
      : document_(context.document),
        asset_(context.asset),
        views_(context.views),
        features_(features) {}

  void find() {
    for (const model::Accessor& accessor : views_.accessors) {
      if (accessor.node != json::kNoNode && accessor.sparse != json::kNoNode) {
        note(accessor.buffer_view ? "accessor.sparse" : "accessor.sparse-only", accessor.node);
      }
    }
    for (const model::Mesh& mesh : views_.meshes) {
      if (mesh.node != json::kNoNode) find_mesh(mesh);
    }
  }

 private:
  void note(std::string_view name, json::NodeId node) { features_.note(name, node); }
  void note_if(bool has, std::string_view name, json::NodeId node) {
    features_.note_if(has, name, node);
  }

  void find_mesh(const model::Mesh& mesh) {
    note_if(mesh.primitives.size() > 1, "mesh.several-primitives", mesh.node);
    std::set<std::uint32_t> positions;
    for (const model::Primitive& primitive : mesh.primitives) {
      if (primitive.node == json::kNoNode) continue;
      const model::Attribute* position = primitive.find(SemanticKind::position);
      if (position != nullptr && position->accessor) {
        note_if(!positions.insert(*position->accessor).second, "mesh.attributes-shared",
                primitive.node);
        find_extent(views_.accessors[*position->accessor], primitive);
      }
      find_primitive(primitive, position != nullptr);
    }
    for (const model::Primitive& primitive : mesh.primitives) {
      if (!primitive.targets.empty()) return find_names(mesh);
    }
  }

  void find_extent(const model::Accessor& positions, const model::Primitive& primitive) {
    note_if(primitive.indices && positions.count.value_or(0) > 65536,
            "primitive.vertices-over-65536", primitive.node);
    for (const json::NodeId corner : {positions.min, positions.max}) {
      const auto values = model::float_array<3>(document_, corner);
      note_if(values && is_far(*values), "attribute.position-over-million", primitive.node);
    }
  }

  void find_names(const model::Mesh& mesh) {
    const json::NodeId extras = model::object_member(document_, mesh.node, "extras");
    note_if(document_.find(extras, "targetNames") != json::kNoNode, "morph.target-names",
            mesh.node);
    const json::NodeId weights = document_.find(mesh.node, "weights");
    if (weights == json::kNoNode || document_.kind(weights) != json::Kind::number_array) return;
    for (json::NumberCursor at(document_, weights); at.valid(); at.advance()) {
      note_if(at.number().value != 0, "morph.mesh-weights", mesh.node);
    }
  }

  void find_primitive(const model::Primitive& primitive, bool has_positions) {
    const json::NodeId node = primitive.node;
    const bool extended = document_.find(node, "extensions") != json::kNoNode;
    note_if(!has_positions && !extended, "primitive.no-positions", node);
    note_if(!primitive.material, "primitive.no-material", node);
    find_mode(primitive);
    find_indices(primitive);
    for (const model::Attribute& attribute : primitive.attributes) {
      find_attribute(attribute, node);
    }
    find_targets(primitive);
  }

  void find_mode(const model::Primitive& primitive) {
    if (!primitive.mode) return;
    constexpr std::string_view kNames[]{"primitive.points",
                                        "primitive.lines",
                                        "primitive.line-loop",
                                        "primitive.line-strip",
                                        "",
                                        "primitive.triangle-strip",
                                        "primitive.triangle-fan"};
    const std::string_view name = kNames[static_cast<std::size_t>(*primitive.mode)];
    note_if(!name.empty(), name, primitive.node);
    const bool triangles = model::draws_triangles(*primitive.mode);
    if (triangles && primitive.find(SemanticKind::normal) == nullptr && !is_unlit(primitive)) {
      note("primitive.no-normals", primitive.node);
    }
  }

  // An unlit material does not need normals.
  bool is_unlit(const model::Primitive& primitive) const {
    if (!primitive.material) return false;
    const json::NodeId material = asset_.elements(model::RootArray::materials)[*primitive.material];
    return model::extension_object(document_, material, "KHR_materials_unlit") != json::kNoNode;
  }

  void find_indices(const model::Primitive& primitive) {
    note_if(primitive.indices_node == json::kNoNode, "index.none", primitive.node);
    if (!primitive.indices) return;
    const ComponentType type = views_.accessors[*primitive.indices].format.component;
    note_if(type == ComponentType::uint8, "index.uint8", primitive.node);
    note_if(type == ComponentType::uint16, "index.uint16", primitive.node);
    note_if(type == ComponentType::uint32, "index.uint32", primitive.node);
  }

  void find_attribute(const model::Attribute& attribute, json::NodeId node) {
    const model::Format format =
        attribute.accessor ? views_.accessors[*attribute.accessor].format : model::Format();
    find_component(attribute.semantic, format, node);
    if (attribute.accessor) find_stride(views_.accessors[*attribute.accessor], format, node);
    switch (attribute.semantic.kind) {
      case SemanticKind::tangent:
        return note("attribute.tangent", node);
      case SemanticKind::texcoord:
        note_if(attribute.semantic.set == 1, "attribute.texcoord-1", node);
        note_if(attribute.semantic.set == 2, "attribute.texcoord-2", node);
        return note_if(attribute.semantic.set == 4, "attribute.texcoord-4", node);
      case SemanticKind::color:
        note_if(attribute.semantic.set == 0, "attribute.color-0", node);
        note_if(attribute.semantic.set == 0 && format.type == model::ElementType::vec4,
                "attribute.color-0-alpha", node);
        return note_if(attribute.semantic.set == 1, "attribute.color-1", node);
      case SemanticKind::joints:
        return note_if(attribute.semantic.set == 1, "attribute.joints-1", node);
      case SemanticKind::application:
        return note("attribute.custom", node);
      default:
        return;
    }
  }

  void find_component(const model::Semantic& semantic, const model::Format& format,
                      json::NodeId node) {
    const bool bytes = format.component == ComponentType::uint8;
    const bool shorts = format.component == ComponentType::uint16;
    switch (semantic.kind) {
      case SemanticKind::texcoord:
        note_if(bytes, "attribute.texcoord-uint8", node);
        return note_if(shorts, "attribute.texcoord-uint16", node);
      case SemanticKind::color:
        note_if(bytes && semantic.set == 0, "attribute.color-uint8", node);
        return note_if(shorts && semantic.set == 0, "attribute.color-uint16", node);
      case SemanticKind::joints:
        return note_if(shorts, "attribute.joints-uint16", node);
      case SemanticKind::weights:
        note_if(bytes, "attribute.weights-uint8", node);
        return note_if(shorts, "attribute.weights-uint16", node);
      default:
        return;
    }
  }

  void find_stride(const model::Accessor& accessor, const model::Format& format,
                   json::NodeId node) {
    const model::BufferView* view = views_.view_of(accessor);
    note_if(view != nullptr && view->byte_stride.value_or(0) > model::element_size(format),
            "accessor.interleaved", node);
    // Elements of a compressed primitive come from its extension.
    const bool extended = document_.find(node, "extensions") != json::kNoNode ||
                          document_.find(accessor.node, "extensions") != json::kNoNode;
    note_if(view == nullptr && accessor.sparse == json::kNoNode && !extended, "accessor.zeros",
            accessor.node);
  }

  void find_targets(const model::Primitive& primitive) {
    const std::size_t count = primitive.targets.size();
    if (count == 0) return;
    note("morph.target", primitive.node);
    note_if(count > 4, "morph.targets-over-4", primitive.node);
    note_if(count > 8, "morph.targets-over-8", primitive.node);
    note_if(count > 16, "morph.targets-over-16", primitive.node);
    note_if(count > 32, "morph.targets-over-32", primitive.node);
    for (const json::NodeId target : primitive.targets) find_target(target, primitive.node);
  }

  void find_target(json::NodeId target, json::NodeId node) {
    if (target == json::kNoNode || !document_.is_object(target)) return;
    for (const auto member : document_.members(target)) {
      const SemanticKind kind = model::parse_semantic(document_.key(member.key_id)).kind;
      note_if(kind == SemanticKind::normal, "morph.normal", node);
      note_if(kind == SemanticKind::tangent, "morph.tangent", node);
      note_if(kind == SemanticKind::color, "morph.color", node);
      note_if(kind == SemanticKind::texcoord, "morph.texcoord", node);
      const auto index = document_.is_number(member.value)
                             ? document_.unsigned_integer(member.value)
                             : std::nullopt;
      note_if(index && *index < views_.accessors.size() &&
                  views_.accessors[*index].sparse != json::kNoNode,
              "morph.sparse", node);
    }
  }

  const json::Document& document_;
  const model::Asset& asset_;
  const model::Views& views_;
  Features& features_;
};

}  // namespace

void find_geometry_features(const Context& context, Features& features) {
  GeometryFeatures(context, features).find();
}

}  // namespace gltfx::validate

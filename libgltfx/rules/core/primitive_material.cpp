// SPDX-License-Identifier: Apache-2.0
// Tangents and texture coordinates that materials need from primitives: missing and unused ones.

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "rules/context.hpp"
#include "rules/core/mesh_state.hpp"
#include "rules/extensions/materials_variants.hpp"
#include "rules/extensions/structural_metadata.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

using model::Attribute;
using model::Primitive;
using model::SemanticKind;

// One material on one primitive: the default one or one of a variant.
struct MaterialUse {
  const MeshState& state;
  const Primitive& primitive;
  json::NodeId place;  // the index of the material
  const Path& path;    // of that index

  std::string material() const {
    return object_label(state.context, model::RootArray::materials, *primitive.material);
  }

  void report(Code code, std::string message) const {
    state.context.link_sink.report(path,
                                   finding_on(state.context, place, code, std::move(message)));
  }
};

void check_texcoords(const MaterialUse& material_use, const MaterialNeed& need,
                     TexCoords& texcoords) {
  for (const TexCoordNeed& each : need.texcoords) {
    if (texcoords.use(each.set)) continue;
    material_use.report(
        Code::MESH_PRIMITIVE_TOO_FEW_TEXCOORDS,
        fmt::format("The texture {} uses TEXCOORD_{}, which the primitive does not have.",
                    member_label(material_use.state.context, each.pointer), each.set));
  }
}

void check_tangent_space(const MaterialUse& material_use, const MaterialNeed& need) {
  if (!need.tangent_space) return;
  const bool normal = material_use.primitive.find(SemanticKind::normal) != nullptr;
  const bool tangent = material_use.primitive.find(SemanticKind::tangent) != nullptr;
  if (normal && tangent) return;
  const std::string_view missing = normal ? "TANGENT" : tangent ? "NORMAL" : "NORMAL and TANGENT";
  if (need.normal_texture) {
    material_use.report(Code::MESH_PRIMITIVE_GENERATED_TANGENT_SPACE,
                        fmt::format("The primitive has no {}, but {} has a normal texture.",
                                    missing, material_use.material()));
  } else {
    material_use.report(
        Code::MESH_PRIMITIVE_NO_TANGENT_SPACE,
        fmt::format(
            "The primitive has no {}, but {} requires a tangent space and has no normal texture.",
            missing, material_use.material()));
  }
}

// Without NORMAL, which is reported, tangents are ignored anyway.
void check_unused_tangent(const Context& context, const Primitive& primitive, const Path& path) {
  const Attribute* tangent = primitive.find(SemanticKind::tangent);
  if (tangent == nullptr) return;
  const bool ignored = primitive.find(SemanticKind::normal) == nullptr;
  if (ignored && !context.deviations.consequences_are_reported) return;
  report_link(context, Path(path, tangent->name), tangent->value, Code::UNUSED_MESH_TANGENT,
              "TANGENT is not used because the material has no texture in tangent space.");
}

void check_unused_texcoords(const Context& context, const TexCoords& texcoords, const Path& path) {
  for (const auto& set : texcoords.sets()) {
    if (set.used) continue;
    report_link(context, Path(path, set.attribute->name), set.attribute->value, Code::UNUSED_OBJECT,
                fmt::format("{} is not used by any texture of the material.", set.attribute->name));
  }
}

}  // namespace

void MaterialCheck::check_variants() {
  const Context& context = state_.context;
  SeenVariants seen;
  for_each_mapping(context, state_.active, primitive_.node, path_,
                   [&](json::NodeId mapping, std::uint64_t index, const Path& at) {
                     if (!check_variants_exist(context, mapping, at)) return;
                     check_unique_variants(context, mapping, index, at, seen);
                     const json::NodeId value = context.document.find(mapping, "material");
                     report_references(context, value);
                     const auto material =
                         context.asset.index(mapping, "material", model::RootArray::materials);
                     if (!material) return;
                     const MaterialNeed& need = state_.materials.of(*material);
                     const Path place(at, "material");
                     const MaterialUse material_use{state_, primitive_, value, place};
                     check_texcoords(material_use, need, texcoords_);
                     if (!need.tangent_space || context.deviations.fewer_materials_need_tangents)
                       return;
                     tangent_space_ = true;
                     if (!need.normal_texture) check_tangent_space(material_use, need);
                   });
}

void MaterialCheck::check_material() {
  const Context& context = state_.context;
  report_references(context, primitive_.material_node);
  if (primitive_.material) {
    const MaterialNeed& need = state_.materials.of(*primitive_.material);
    const Path at(path_, "material");
    const MaterialUse material_use{state_, primitive_, primitive_.material_node, at};
    check_tangent_space(material_use, need);
    check_texcoords(material_use, need, texcoords_);
    tangent_space_ = tangent_space_ || need.tangent_space;
  }
  if (!state_.unseen.empty()) return;
  const Path attributes(path_, "attributes");
  if (!tangent_space_) check_unused_tangent(context, primitive_, attributes);
  const bool any = visit_data_texcoords(context, primitive_.node,
                                        [&](std::uint64_t set) { texcoords_.use(set); });
  if (!any) check_unused_texcoords(context, texcoords_, attributes);
}

}  // namespace gltfx::validate

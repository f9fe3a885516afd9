// SPDX-License-Identifier: Apache-2.0
// What materials ask of primitives: tangents and texture coordinates, neither too few nor for
// nothing.
#include "validate/rules/primitive_material.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"
#include "validate/rules/mesh_state.hpp"
#include "validate/rules/variants.hpp"

namespace gltfx::validate {
namespace {

using model::Attribute;
using model::Primitive;
using model::SemanticKind;

// The texture coordinates of a primitive, and which of them some material reads.
class TexCoords {
 public:
  TexCoords(const Context& context, const Primitive& primitive) : khronos_(context.khronos()) {
    std::uint64_t highest = 0;
    for (const Attribute& attribute : primitive.attributes) {
      if (attribute.semantic.kind != SemanticKind::texcoord) continue;
      sets_.push_back({&attribute, false});
      highest = std::max(highest, attribute.semantic.set);
    }
    std::sort(sets_.begin(), sets_.end(), [](const Set& a, const Set& b) {
      return a.attribute->semantic.set < b.attribute->semantic.set;
    });
    // The Khronos validator counts sets that have a gap as none.
    if (khronos_ && !sets_.empty() && highest != sets_.size() - 1) sets_.clear();
  }

  struct Set {
    const Attribute* attribute;
    bool used;
  };

  // Marks a set as read; false when the primitive does not have it.
  bool use(std::uint64_t set) {
    const auto at = std::lower_bound(sets_.begin(), sets_.end(), set,
                                     [](const Set& each, std::uint64_t wanted) {
                                       return each.attribute->semantic.set < wanted;
                                     });
    if (at == sets_.end() || at->attribute->semantic.set != set) return false;
    at->used = true;
    return true;
  }

  const std::vector<Set>& sets() const { return sets_; }

 private:
  bool khronos_;
  std::vector<Set> sets_;  // by number
};

// One material on one primitive: the default one or that of a variant.
struct Wearing {
  const MeshState& state;
  const Primitive& primitive;
  json::NodeId place;  // the index of the material
  const Path& path;    // of that index

  void report(std::string_view code, std::string message, std::string help = {}) const {
    state.context.link_sink.report(
        path, finding_on(state.context, place, code, std::move(message), std::move(help)));
  }
};

void check_texcoords(const Wearing& wearing, const MaterialNeed& need, TexCoords& texcoords) {
  for (const TexCoordNeed& each : need.texcoords) {
    if (texcoords.use(each.set)) continue;
    wearing.report("MESH_PRIMITIVE_TOO_FEW_TEXCOORDS",
                   fmt::format("{} reads TEXCOORD_{}, which the primitive does not have.",
                               printable(each.pointer), each.set));
  }
}

void check_tangent_space(const Wearing& wearing, const MaterialNeed& need) {
  if (!need.tangent_space) return;
  const bool normal = wearing.primitive.find(SemanticKind::normal) != nullptr;
  const bool tangent = wearing.primitive.find(SemanticKind::tangent) != nullptr;
  if (normal && tangent) return;
  const std::string_view missing = normal ? "TANGENT" : tangent ? "NORMAL" : "NORMAL and TANGENT";
  if (need.normal_texture) {
    wearing.report(
        "MESH_PRIMITIVE_GENERATED_TANGENT_SPACE",
        fmt::format("The material has a normal texture, but the primitive has no {}.", missing));
  } else {
    wearing.report("MESH_PRIMITIVE_NO_TANGENT_SPACE",
                   fmt::format("The material reads a texture in tangent space, but the primitive "
                               "has no {}, and the material no normal texture.",
                               missing));
  }
}

void check_variants(const MeshState& state, const Primitive& primitive, const Path& path,
                    TexCoords& texcoords, bool& tangent_space) {
  const Context& context = state.context;
  SeenVariants seen;
  for_each_mapping(
      context, state.active, primitive.node, path,
      [&](json::NodeId mapping, std::uint64_t index, const Path& at) {
        if (!check_variants_exist(context, mapping, at)) return;
        check_unique_variants(context, mapping, index, at, seen);
        const auto material = context.asset.index(mapping, "material", model::RootArray::materials);
        if (!material) return;
        const MaterialNeed& need = state.materials.of(*material);
        const Path place(at, "material");
        check_texcoords({state, primitive, context.document.find(mapping, "material"), place}, need,
                        texcoords);
        tangent_space = tangent_space || need.tangent_space;
      });
}

// Without NORMAL the tangents are ignored anyway, which is reported.
void check_unused_tangent(const Context& context, const Primitive& primitive, const Path& path) {
  const Attribute* tangent = primitive.find(SemanticKind::tangent);
  if (tangent == nullptr) return;
  if (!context.khronos() && primitive.find(SemanticKind::normal) == nullptr) return;
  context.link_sink.report(
      Path(path, tangent->name),
      finding_on(context, tangent->value, "UNUSED_MESH_TANGENT",
                 "TANGENT is not used: the material has no texture in tangent space."));
}

void check_unused_texcoords(const Context& context, const TexCoords& texcoords, const Path& path) {
  for (const auto& set : texcoords.sets()) {
    if (set.used) continue;
    context.link_sink.report(
        Path(path, set.attribute->name),
        finding_on(context, set.attribute->value, "UNUSED_OBJECT",
                   fmt::format("No texture of the material reads {}.", set.attribute->name)));
  }
}

}  // namespace

void check_material(const MeshState& state, const Primitive& primitive, const Path& path) {
  const Context& context = state.context;
  TexCoords texcoords(context, primitive);
  bool tangent_space = false;
  check_variants(state, primitive, path, texcoords, tangent_space);
  // A quirk that parity needs: tangents that only a variant's material uses count as unused.
  if (context.khronos()) tangent_space = false;
  if (primitive.material) {
    const MaterialNeed& need = state.materials.of(*primitive.material);
    const Path at(path, "material");
    const Wearing wearing{state, primitive, primitive.material_node, at};
    check_tangent_space(wearing, need);
    check_texcoords(wearing, need, texcoords);
    tangent_space = tangent_space || need.tangent_space;
  }
  const Path attributes(path, "attributes");
  if (!tangent_space) check_unused_tangent(context, primitive, attributes);
  check_unused_texcoords(context, texcoords, attributes);
}

const Family& primitive_material_family() {
  static const Family family{"primitive_material", primitive_material_rules(), {}, {}};
  return family;
}

}  // namespace gltfx::validate

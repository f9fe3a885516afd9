// SPDX-License-Identifier: Apache-2.0
// Lobes of materials that are invisible: switched off, hidden by metal, or without a property that
// they need. The texts of the extensions state this in prose.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/core/animated.hpp"
#include "rules/core/material_needs.hpp"
#include "rules/finding.hpp"
#include "rules/payload/texture_slots.hpp"

namespace gltfx::validate {
namespace {

using model::number_member;
using model::object_member;

// Data shared by all materials of an asset.
struct Shared {
  const Context& context;
  const Animated& animated;
  const VertexAlpha& vertices;
};

// One material.
class MaterialCheck {
 public:
  MaterialCheck(const Shared& shared, json::NodeId material, std::uint64_t index, const Path& path)
      : shared_(shared),
        context_(shared.context),
        document_(shared.context.document),
        material_(material),
        index_(index),
        path_(path),
        extensions_(path, "extensions") {}

  void check() const {
    check_ior();
    check_dispersion();
    check_metal();
    check_alpha_mode();
    check_unlit();
    check_switched_off();
  }

 private:
  json::NodeId extension(std::string_view name) const {
    return model::extension_object(document_, material_, name);
  }

  std::string pointer(std::string_view member) const {
    return fmt::format("{}/{}", path_.pointer(), member);
  }

  // Whether a missing member of an extension may exist under another name.
  bool is_doubtful(std::string_view name) const {
    const schema::Set& schemas = context_.schemas;
    const schema::ExtensionId id = schemas.find_extension(name);
    if (id == schema::kNone) return true;
    const schema::ShapeId home = schemas.extensions()[id].shape_on(schemas.find_type("material"));
    return home == schema::kNone ||
           has_unknown_member(context_, schemas.shape(home).type, extension(name));
  }

  // A factor of an extension that has a numeric default; nothing if it may change.
  std::optional<double> fixed(std::string_view name, std::string_view member,
                              double otherwise) const {
    const json::NodeId object = extension(name);
    if (object == json::kNoNode) return std::nullopt;
    if (shared_.animated.contains(pointer(fmt::format("extensions/{}/{}", name, member)))) {
      return std::nullopt;
    }
    const auto value = number_member(document_, object, member);
    return value || is_doubtful(name) ? value : std::optional(otherwise);
  }

  // Reports at a member of an extension, or at the extension itself.
  void report(std::string_view name, std::string_view member, Code code,
              std::string message) const {
    const Path at(extensions_, name);
    if (member.empty()) {
      report_link(context_, at, extension(name), code, std::move(message));
    } else {
      report_member(context_.link_sink, context_, at, extension(name), member, code,
                    std::move(message));
    }
  }

  // An index of 0 reflects everything: no light enters.
  void check_ior() const {
    const json::NodeId object = extension("KHR_materials_ior");
    const auto ior = number_member(document_, object, "ior");
    if (!ior || *ior != 0) return;
    const std::string animated = pointer("extensions/KHR_materials_ior/ior");
    if (shared_.animated.contains(animated)) {
      report("KHR_materials_ior", "ior", Code::KHR_MATERIALS_IOR_ZERO_ANIMATED,
             "ior is animated, but 0 in the material, so the animation is ignored.");
    }
    const json::NodeId volume = extension("KHR_materials_volume");
    const auto thickness = number_member(document_, volume, "thicknessFactor");
    if (!thickness || !(*thickness > 0)) return;
    report("KHR_materials_ior", "ior", Code::KHR_MATERIALS_IOR_ZERO_VOLUME,
           fmt::format("ior is 0, so the volume with thicknessFactor {} has no effect.",
                       number_text(*thickness)));
  }

  void check_dispersion() const {
    const json::NodeId object = extension("KHR_materials_dispersion");
    const auto dispersion = number_member(document_, object, "dispersion");
    constexpr double kRutile = 2.04;  // the maximum of all minerals
    if (!dispersion || *dispersion <= kRutile) return;
    report("KHR_materials_dispersion", "dispersion", Code::KHR_MATERIALS_DISPERSION_UNUSUAL,
           fmt::format("dispersion is {}, which is more than that of any material.",
                       number_text(*dispersion)));
  }

  // The default of metallicFactor is 1.
  void check_metal() const {
    const json::NodeId base = object_member(document_, material_, "pbrMetallicRoughness");
    const bool texture =
        object_member(document_, base, "metallicRoughnessTexture") != json::kNoNode;
    const double metallic = number_member(document_, base, "metallicFactor").value_or(1);
    if (texture || metallic != 1) return;
    const schema::TypeId type = context_.schemas.find_type("material.pbrMetallicRoughness");
    if (has_unknown_member(context_, type, base)) return;
    if (shared_.animated.contains(pointer("pbrMetallicRoughness/metallicFactor"))) return;
    if (extension("KHR_materials_pbrSpecularGlossiness") != json::kNoNode) return;
    constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kHidden{
        {{"KHR_materials_transmission", "transmissionFactor"},
         {"KHR_materials_diffuse_transmission", "diffuseTransmissionFactor"}}};
    for (const auto& [name, factor] : kHidden) {
      const auto value = number_member(document_, extension(name), factor);
      if (!value || !(*value > 0)) continue;
      const bool given = document_.find(base, "metallicFactor") != json::kNoNode;
      report(name, "", Code::KHR_MATERIALS_TRANSMISSION_METAL,
             fmt::format("The material is transmissive, but metallicFactor is {}.",
                         given ? "1" : "not set (default: 1)"));
      return;
    }
  }

  // Transmission is not coverage: glass is fully present.
  void check_alpha_mode() const {
    const std::string mode = model::string_member(document_, material_, "alphaMode");
    if (mode != "BLEND" && mode != "MASK") return;
    const auto transmission = fixed("KHR_materials_transmission", "transmissionFactor", 0);
    if (!transmission || !(*transmission > 0) || may_have_alpha()) return;
    report("KHR_materials_transmission", "", Code::KHR_MATERIALS_TRANSMISSION_ALPHA_MODE,
           fmt::format("alphaMode is {}, but alpha is 1; for transmission it should be OPAQUE.",
                       mode));
  }

  bool may_have_alpha() const {
    const json::NodeId base = object_member(document_, material_, "pbrMetallicRoughness");
    if (object_member(document_, base, "baseColorTexture") != json::kNoNode) return true;
    if (shared_.animated.contains(pointer("pbrMetallicRoughness/baseColorFactor"))) return true;
    if (shared_.vertices.on(static_cast<std::uint32_t>(index_))) return true;
    const json::NodeId factor = document_.find(base, "baseColorFactor");
    if (factor == json::kNoNode) return false;
    if (document_.kind(factor) != json::Kind::number_array) return true;
    double last = 1;
    for (json::NumberCursor at(document_, factor); at.valid(); at.advance()) {
      last = at.number().value;
    }
    return last != 1;
  }

  // The specification recommends fallback values for an unlit surface.
  void check_unlit_fallback() const {
    const auto& required = context_.checked.extensions_required;
    if (std::find(required.begin(), required.end(), "KHR_materials_unlit") != required.end()) {
      return;
    }
    const json::NodeId base = object_member(document_, material_, "pbrMetallicRoughness");
    const double metallic = number_member(document_, base, "metallicFactor").value_or(1);
    const double roughness = number_member(document_, base, "roughnessFactor").value_or(1);
    const bool shines = metallic != 0 || !(roughness > 0.5);
    if (!shines && !is_emissive()) return;
    report("KHR_materials_unlit", "", Code::KHR_MATERIALS_UNLIT_FALLBACK,
           shines
               ? fmt::format(
                     "Loaders without the extension use metallicFactor {} and roughnessFactor {}.",
                     number_text(metallic), number_text(roughness))
               : "Loaders without the extension show an emissive surface.");
  }

  bool is_emissive() const {
    const json::NodeId factor = document_.find(material_, "emissiveFactor");
    if (factor == json::kNoNode || document_.kind(factor) != json::Kind::number_array) return false;
    for (json::NumberCursor at(document_, factor); at.valid(); at.advance()) {
      if (at.number().value != 0) return true;
    }
    return false;
  }

  // Other members of an unlit material are for readers without the extension.
  void check_unlit() const {
    if (extension("KHR_materials_unlit") == json::kNoNode) return;
    check_unlit_fallback();
    constexpr std::array<std::string_view, 3> kTextures{"normalTexture", "occlusionTexture",
                                                        "emissiveTexture"};
    for (const std::string_view texture : kTextures) {
      if (report_unseen(material_, path_, texture)) return;
    }
    constexpr std::string_view kBase = "pbrMetallicRoughness";
    const json::NodeId base = object_member(document_, material_, kBase);
    report_unseen(base, Path(path_, kBase), "metallicRoughnessTexture");
  }

  bool report_unseen(json::NodeId owner, const Path& path, std::string_view texture) const {
    if (object_member(document_, owner, texture) == json::kNoNode) return false;
    report_member(context_.link_sink, context_, path, owner, texture,
                  Code::KHR_MATERIALS_UNLIT_TEXTURE,
                  fmt::format("{} has no effect because the material is unlit.", texture));
    return true;
  }

  // --- Extensions whose main factor is 0 ---

  // Whether an extension has no effect until its main factor is set.
  bool is_off_by_default(const schema::Extension& extension) const {
    const schema::Set& schemas = context_.schemas;
    const schema::ShapeId home = extension.shape_on(schemas.find_type("material"));
    if (home == schema::kNone || extension.strength.empty()) return false;
    const auto* factor = schemas.find_property(schemas.shape(home).type, extension.strength);
    return factor->default_json.find_first_of("123456789") == std::string::npos;
  }

  void check_switched_off() const {
    const json::NodeId extensions = object_member(document_, material_, "extensions");
    if (extensions == json::kNoNode) return;
    for (const auto member : document_.members(extensions)) {
      const schema::ExtensionId id = context_.schemas.find_extension(document_.key(member.key_id));
      if (id == schema::kNone) continue;
      const schema::Extension& each = context_.schemas.extensions()[id];
      if (each.successor.empty() && is_off_by_default(each) && is_fixed_at_zero(each)) {
        report_off(each);
      }
    }
  }

  // A number, or a colour, that is 0 or missing.
  bool is_fixed_at_zero(const schema::Extension& each) const {
    const json::NodeId value = document_.find(extension(each.name), each.strength);
    const bool color = value != json::kNoNode && document_.kind(value) == json::Kind::number_array;
    if (!color && value != json::kNoNode && !document_.is_number(value)) return false;
    if (!color) return fixed(each.name, each.strength, 0) == 0.0;
    if (shared_.animated.contains(
            pointer(fmt::format("extensions/{}/{}", each.name, each.strength)))) {
      return false;
    }
    for (json::NumberCursor at(document_, value); at.valid(); at.advance()) {
      if (at.number().value != 0) return false;
    }
    return true;
  }

  // Textures hidden by a factor of 0 are reported at their place.
  void report_off(const schema::Extension& off) const {
    std::vector<std::string> others;
    for (const auto member : document_.members(extension(off.name))) {
      const std::string_view name = document_.key(member.key_id);
      if (name.ends_with("Texture")) return;
      if (name != off.strength && name != "extras" && name != "extensions")
        others.push_back(printable(name));
    }
    if (others.empty()) return;
    report(off.name, "", Code::MATERIAL_LOBE_OFF,
           fmt::format("{} is 0, so {} {} no effect.", off.strength, join_and(others),
                       others.size() == 1 ? "has" : "have"));
  }

  const Shared& shared_;
  const Context& context_;
  const json::Document& document_;
  json::NodeId material_;
  std::uint64_t index_;
  const Path& path_;
  Path extensions_;
};

void check_materials(const Context& context) {
  const auto& materials = context.asset.elements(model::RootArray::materials);
  if (materials.empty()) return;
  const bool extended = std::any_of(materials.begin(), materials.end(), [&](json::NodeId each) {
    return each != json::kNoNode && context.document.find(each, "extensions") != json::kNoNode;
  });
  if (!extended) return;
  const Animated animated(context);
  const VertexAlpha vertices(context);
  const Shared shared{context, animated, vertices};
  const Path root;
  const Path array(root, "materials");
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (materials[i] == json::kNoNode) continue;
    const Path path(array, static_cast<std::uint64_t>(i));
    MaterialCheck(shared, materials[i], i, path).check();
  }
}

}  // namespace

const RuleGroup& material_lobes_rules() {
  static constexpr LinkRule kLinkRules[] = {check_materials};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

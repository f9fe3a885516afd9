// SPDX-License-Identifier: Apache-2.0
// Material extensions that need another property to be visible. They are named here because their
// texts state these conditions in prose: no schema word means "only with an emissive factor".

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"
#include "rules/fix.hpp"
#include "rules/payload/texture_slots.hpp"

namespace gltfx::validate {
namespace {

using model::number_member;
using model::object_member;

// One extension object on one material.
struct Subject {
  const Context& context;
  json::NodeId material;
  json::NodeId object;
  const Path& path;  // of the extension object

  void report(Code code, std::string message) const {
    report_link(context, path, object, code, std::move(message));
  }
};

// --- Textures that share a tangent space with the normal texture ---

// A set that is not a number counts as none.
std::optional<std::uint64_t> texcoord(const json::Document& document, json::NodeId texture) {
  if (!document.has_value(texture, "texCoord")) return 0;
  return model::unsigned_member(document, texture, "texCoord");
}

std::string texcoord_text(std::optional<std::uint64_t> set) {
  return set ? fmt::format("TEXCOORD_{}", *set) : std::string("none");
}

bool is_transformed(const json::Document& document, json::NodeId one, json::NodeId other) {
  return object_member(document, one, "extensions") != json::kNoNode ||
         object_member(document, other, "extensions") != json::kNoNode;
}

// Different tiling keeps the tangents; rotation does not.
void check_shared_mapping(const Subject& subject, json::NodeId normal, std::string_view member,
                          Code code) {
  const Context& context = subject.context;
  const json::NodeId texture = object_member(context.document, subject.object, member);
  const UvMapping wanted = read_uv_mapping(context.document, normal);
  const UvMapping found = read_uv_mapping(context.document, texture);
  if (wanted.difference(found).empty()) return;
  const bool set = wanted.texcoord != found.texcoord;
  Finding finding = finding_on(
      context, texture, code,
      set ? fmt::format("{} uses TEXCOORD_{}, but normalTexture uses TEXCOORD_{}.", member,
                        number_text(found.texcoord), number_text(wanted.texcoord))
          : fmt::format("{} and normalTexture have different transforms.", member));
  if (!set && wanted.rotation == found.rotation) finding.severity = Severity::hint;
  context.link_sink.report(Path(subject.path, member), std::move(finding));
}

void check_shared_texcoord(const Subject& subject, std::string_view member, Code code) {
  const Context& context = subject.context;
  const json::Document& document = context.document;
  const json::NodeId normal = object_member(document, subject.material, "normalTexture");
  const json::NodeId texture = object_member(document, subject.object, member);
  if (normal == json::kNoNode || texture == json::kNoNode) return;
  if (!context.deviations.texture_transforms_are_disregarded &&
      is_transformed(document, normal, texture)) {
    return check_shared_mapping(subject, normal, member, code);
  }
  const auto wanted = texcoord(document, normal);
  const auto found = texcoord(document, texture);
  const bool broken = !found || !wanted;
  if (found == wanted || (broken && !context.deviations.consequences_are_reported)) return;
  report_member(context.link_sink, context, subject.path, subject.object, member, code,
                fmt::format("{} uses {}, but normalTexture uses {}.", member, texcoord_text(found),
                            texcoord_text(wanted)));
}

void check_anisotropy(const Subject& subject) {
  check_shared_texcoord(subject, "anisotropyTexture",
                        Code::KHR_MATERIALS_ANISOTROPY_ANISOTROPY_TEXTURE_TEXCOORD);
}

void check_clearcoat(const Subject& subject) {
  check_shared_texcoord(subject, "clearcoatNormalTexture",
                        Code::KHR_MATERIALS_CLEARCOAT_CLEARCOAT_NORMAL_TEXTURE_TEXCOORD);
}

// --- Extensions without effect on their own ---

bool has_extension(const Subject& subject, std::string_view name) {
  return model::extension_object(subject.context.document, subject.material, name) != json::kNoNode;
}

void check_dispersion(const Subject& subject) {
  if (has_extension(subject, "KHR_materials_volume")) return;
  subject.report(Code::KHR_MATERIALS_DISPERSION_NO_VOLUME,
                 "The dispersion has no effect because the material has no KHR_materials_volume.");
}

bool is_black(const json::Document& document, json::NodeId material) {
  const json::NodeId factor = document.find(material, "emissiveFactor");
  if (factor == json::kNoNode) return !document.has_value(material, "emissiveFactor");
  if (document.kind(factor) != json::Kind::number_array) return false;
  std::size_t zeros = 0;
  for (json::NumberCursor at(document, factor); at.valid(); at.advance()) {
    if (at.number().value != 0) return false;
    ++zeros;
  }
  return zeros == 3;
}

void check_emissive_strength(const Subject& subject) {
  const json::Document& document = subject.context.document;
  const auto strength = number_member(document, subject.object, "emissiveStrength");
  if (!strength || *strength < 0 || *strength == 1) return;
  if (!is_black(document, subject.material)) return;
  const json::NodeId factor = document.find(subject.material, "emissiveFactor");
  subject.report(
      Code::KHR_MATERIALS_EMISSIVE_STRENGTH_ZERO_FACTOR,
      fmt::format("emissiveStrength is {}, but emissiveFactor is {}.", number_text(*strength),
                  factor == json::kNoNode ? "not set (default: black)" : "black"));
}

// --- Volume ---

// Light passes through a surface if an extension states how much. Extensions without a schema are
// assumed to transmit light.
bool lets_light_through(const Subject& subject, std::string_view name) {
  const schema::Set& schemas = subject.context.schemas;
  const schema::ExtensionId id = schemas.find_extension(name);
  if (id == schema::kNone) return true;
  const schema::Extension& extension = schemas.extensions()[id];
  const bool supported = extension.khronos_validator;
  if (!supported && subject.context.deviations.unsupported_extensions_are_skipped) return true;
  const schema::ShapeId home = extension.shape_on(schemas.find_type("material"));
  if (home == schema::kNone) return false;
  const schema::TypeId type = schemas.shape(home).type;
  if (type == schema::kNone) return false;
  const auto& properties = schemas.type(type).properties;
  return std::any_of(properties.begin(), properties.end(), [](const schema::Property& property) {
    return property.name.find("ransmission") != std::string::npos ||
           property.name.find("ransluc") != std::string::npos;
  });
}

bool is_transmissive(const Subject& subject) {
  const json::Document& document = subject.context.document;
  const json::NodeId extensions = object_member(document, subject.material, "extensions");
  for (const auto member : document.members(extensions)) {
    if (lets_light_through(subject, document.key(member.key_id))) return true;
  }
  return false;
}

void check_volume(const Subject& subject) {
  const json::Document& document = subject.context.document;
  if (!is_transmissive(subject)) {
    subject.report(
        Code::KHR_MATERIALS_VOLUME_NO_TRANSMISSION,
        "The volume has no effect because no extension of the material transmits light.");
  }
  const auto thickness = number_member(document, subject.object, "thicknessFactor");
  if (!thickness || !(*thickness > 0)) return;
  if (!model::true_member(document, subject.material, "doubleSided")) return;
  subject.report(
      Code::KHR_MATERIALS_VOLUME_DOUBLE_SIDED,
      fmt::format("The material is double-sided, but has a volume with thicknessFactor {}.",
                  number_text(*thickness)));
}

// --- Iridescence ---

void check_iridescence(const Context& context, json::NodeId object, const Path& path) {
  const json::Document& document = context.document;
  const auto thickness = [&](std::string_view member, double otherwise) {
    if (!document.has_value(object, member)) return std::optional(otherwise);
    const auto value = number_member(document, object, member);
    return value && *value >= 0 ? value : std::nullopt;
  };
  const auto least = thickness("iridescenceThicknessMinimum", 100);
  const auto most = thickness("iridescenceThicknessMaximum", 400);
  if (!least) return;
  const std::string_view texture = "iridescenceThicknessTexture";
  const std::string_view minimum = "iridescenceThicknessMinimum";
  if (object_member(document, object, texture) == json::kNoNode) {
    if (!document.holds(object, minimum)) return;
    report_member(context.schema_sink, context, path, object, minimum,
                  Code::KHR_MATERIALS_IRIDESCENCE_THICKNESS_RANGE_WITHOUT_TEXTURE,
                  "iridescenceThicknessMinimum has no effect without iridescenceThicknessTexture.");
  } else if (least == most) {
    report_member(
        context.schema_sink, context, path, object, texture,
        Code::KHR_MATERIALS_IRIDESCENCE_THICKNESS_TEXTURE_UNUSED,
        fmt::format(
            "The texture has no effect because the minimum and maximum thickness are both {}.",
            number_text(*least)));
  }
}

// --- All extensions of all materials, in the order of the text ---

struct Check {
  std::string_view extension;
  void (*run)(const Subject& subject);
};
constexpr std::array kChecks{
    Check{"KHR_materials_anisotropy", check_anisotropy},
    Check{"KHR_materials_clearcoat", check_clearcoat},
    Check{"KHR_materials_dispersion", check_dispersion},
    Check{"KHR_materials_emissive_strength", check_emissive_strength},
    Check{"KHR_materials_volume", check_volume},
};

void check_material(const Context& context, const ActiveExtensions& active, json::NodeId material,
                    const Path& path) {
  const json::Document& document = context.document;
  const json::NodeId extensions = object_member(document, material, "extensions");
  if (extensions == json::kNoNode) return;
  const Path at(path, "extensions");
  for (const auto member : document.members(extensions)) {
    const std::string_view name = document.key(member.key_id);
    const auto check = std::find_if(kChecks.begin(), kChecks.end(),
                                    [&](const Check& each) { return each.extension == name; });
    report_references(context, member.value);
    if (check == kChecks.end() || !document.is_object(member.value)) continue;
    if (active.contains(name)) {
      check->run({context, material, member.value, Path(at, name)});
    }
  }
}

void report_core_textures(const Context& context, const std::vector<json::NodeId>& materials) {
  constexpr std::array<std::string_view, 4> kTextures{"pbrMetallicRoughness", "normalTexture",
                                                      "occlusionTexture", "emissiveTexture"};
  for (const json::NodeId material : materials) {
    for (const std::string_view member : kTextures) {
      report_references(context, context.document.find(material, member));
    }
  }
}

void check_materials(const Context& context) {
  const ActiveExtensions active(context);
  const Path root;
  const Path array(root, "materials");
  const auto& materials = context.asset.elements(model::RootArray::materials);
  report_core_textures(context, materials);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (materials[i] == json::kNoNode) continue;
    check_material(context, active, materials[i], Path(array, static_cast<std::uint64_t>(i)));
  }
}

}  // namespace

const RuleGroup& material_extensions_rules() {
  static constexpr ObjectRuleEntry kObjectRules[] = {
      {"material.KHR_materials_iridescence", check_iridescence}};
  static constexpr LinkRule kLinkRules[] = {check_materials};
  static constexpr FixEntry kFixes[] = {
      {Code::KHR_MATERIALS_IRIDESCENCE_THICKNESS_RANGE_WITHOUT_TEXTURE, remove_marked}};
  static constexpr RuleGroup group{
      .object_rules = kObjectRules, .link_rules = kLinkRules, .fixes = kFixes};
  return group;
}

}  // namespace gltfx::validate

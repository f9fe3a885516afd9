// SPDX-License-Identifier: Apache-2.0
// Names of vertex attributes, and combinations of attributes.

#include <algorithm>
#include <array>
#include <set>
#include <string>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "model/fields.hpp"
#include "model/mesh.hpp"
#include "rules/context.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

using model::Attribute;
using model::SemanticKind;

// The sets of one indexed semantic in a primitive.
struct Sets {
  std::uint64_t count = 0;
  std::uint64_t highest = 0;
  bool continuous() const { return count == 0 || highest == count - 1; }
};

Sets count_sets(const std::vector<Attribute>& attributes, SemanticKind kind) {
  Sets sets;
  for (const Attribute& attribute : attributes) {
    if (attribute.semantic.kind != kind) continue;
    ++sets.count;
    sets.highest = std::max(sets.highest, attribute.semantic.set);
  }
  return sets;
}

bool has(const std::vector<Attribute>& attributes, SemanticKind kind) {
  return std::any_of(attributes.begin(), attributes.end(),
                     [&](const Attribute& each) { return each.semantic.kind == kind; });
}

std::string suggestion(std::string_view name) {
  static constexpr std::array<std::string_view, 7> kNames{
      "POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "COLOR_0", "JOINTS_0", "WEIGHTS_0"};
  const std::string_view near = nearest(name, kNames);
  if (!near.empty() && near != name) return fmt::format("did you mean '{}'?", near);
  return "start the name of a custom attribute with an underscore, such as _TEMPERATURE";
}

// Names of extension attributes are PREFIX_x:NAME. The schema file of an extension lists them;
// without such a file, any name with its prefix is accepted.
bool is_extension_attribute(const Context& context, std::string_view name, bool target) {
  if (context.deviations.unsupported_extensions_are_skipped) return false;
  const schema::ExtensionId id = context.schemas.find_extension(model::semantic_extension(name));
  if (id == schema::kNone) return true;
  const schema::Extension& extension = context.schemas.extensions()[id];
  const auto& known = target ? extension.morph_attributes : extension.vertex_attributes;
  return std::any_of(known.begin(), known.end(), [&](const schema::AttributeFormat& each) {
    return model::matches_semantic(each.semantic, name);
  });
}

// After version 2.0, other names are advised against, but indices must be right.
bool may_have_name(const Context& context, std::string_view name) {
  if (context.version <= schema::kVersion2) return false;
  static constexpr std::array<std::string_view, 4> kIndexed{"TEXCOORD_", "COLOR_", "JOINTS_",
                                                            "WEIGHTS_"};
  return std::none_of(kIndexed.begin(), kIndexed.end(),
                      [&](std::string_view stem) { return name.starts_with(stem); });
}

void check_name(const Context& context, std::string_view name, json::NodeId value, bool target,
                const Path& path) {
  const SemanticKind kind = model::parse_semantic(name).kind;
  const bool skinning = kind == SemanticKind::joints || kind == SemanticKind::weights;
  const bool good = kind == SemanticKind::extension
                        ? is_extension_attribute(context, name, target)
                        : kind != SemanticKind::invalid && !(target && skinning);
  if (good) return;
  Finding finding = finding_on(
      context, value, Code::MESH_PRIMITIVE_INVALID_ATTRIBUTE,
      target && skinning ? fmt::format("{} is not allowed in a morph target.", quoted(name))
                         : fmt::format("{} is not a glTF attribute.", quoted(name)),
      target && skinning ? std::string() : suggestion(name));
  if (may_have_name(context, name)) finding.severity = Severity::warning;
  context.schema_sink.report(Path(path, name), std::move(finding));
}

void check_names(const Context& context, const std::vector<Attribute>& attributes, bool target,
                 const Path& path) {
  if (context.deviations.reading_order) return;  // reported name by name
  for (const Attribute& attribute : attributes) {
    check_name(context, attribute.name, attribute.value, target, path);
  }
}

// In reading order: maps are `attributes` and the elements of `targets`.
void check_entry(const Context& context, std::string_view name, json::NodeId value,
                 const Path& map) {
  check_name(context, name, value, map.is_index(), map);
}

// An optional extension cannot be the source of the positions.
bool may_bring_positions(const Context& context, json::NodeId primitive) {
  const json::Document& document = context.document;
  const json::NodeId extensions = model::object_member(document, primitive, "extensions");
  if (extensions == json::kNoNode || context.deviations.unsupported_extensions_are_skipped) {
    return false;
  }
  for (const auto member : document.members(extensions)) {
    const schema::ExtensionId id = context.schemas.find_extension(document.key(member.key_id));
    if (id == schema::kNone) return true;
    const auto must = context.schemas.extensions()[id].must_be_required;
    if (must != schema::MustBeRequired::optional) return true;
  }
  return false;
}

void check_presence(const Context& context, const model::Primitive& primitive, const Path& path) {
  const auto& attributes = primitive.attributes;
  if (!has(attributes, SemanticKind::position) && !may_bring_positions(context, primitive.node)) {
    context.schema_sink.report(
        path, finding_on(context, primitive.attributes_node, Code::MESH_PRIMITIVE_NO_POSITION,
                         "The primitive has no POSITION, so nothing is drawn."));
  }
  const Attribute* tangent = primitive.find(SemanticKind::tangent);
  if (tangent == nullptr || has(attributes, SemanticKind::normal)) return;
  context.schema_sink.report(
      Path(path, tangent->name),
      finding_on(context, tangent->value, Code::MESH_PRIMITIVE_TANGENT_WITHOUT_NORMAL,
                 "TANGENT is ignored because the primitive has no NORMAL."));
}

void check_continuity(const Context& context, const model::Primitive& primitive, SemanticKind kind,
                      const Sets& sets, const Path& path) {
  if (sets.continuous()) return;
  const std::string_view name = model::semantic_prefix(kind);
  context.schema_sink.report(
      path, finding_on(context, primitive.attributes_node,
                       Code::MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY,
                       fmt::format("The number of {0} sets is {1}, but the highest one is {0}_{2}.",
                                   name, sets.count, sets.highest)));
}

void check_sets(const Context& context, const model::Primitive& primitive, const Path& path) {
  const Sets colors = count_sets(primitive.attributes, SemanticKind::color);
  const Sets joints = count_sets(primitive.attributes, SemanticKind::joints);
  const Sets weights = count_sets(primitive.attributes, SemanticKind::weights);
  const Sets texcoords = count_sets(primitive.attributes, SemanticKind::texcoord);
  check_continuity(context, primitive, SemanticKind::color, colors, path);
  check_continuity(context, primitive, SemanticKind::joints, joints, path);
  check_continuity(context, primitive, SemanticKind::weights, weights, path);
  check_continuity(context, primitive, SemanticKind::texcoord, texcoords, path);
  // A gap is reported; the missing set may simply be the other half.
  const bool gap = !joints.continuous() || !weights.continuous();
  if (gap && !context.deviations.sets_with_gaps_are_empty) return;
  const std::uint64_t joint_sets = joints.continuous() ? joints.count : 0;
  const std::uint64_t weight_sets = weights.continuous() ? weights.count : 0;
  if (joint_sets == weight_sets) return;
  context.schema_sink.report(
      path,
      finding_on(
          context, primitive.attributes_node, Code::MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH,
          fmt::format("The number of JOINTS sets is {}, but the number of WEIGHTS sets is {}.",
                      joint_sets, weight_sets)));
}

void check_primitive(const Context& context, json::NodeId object, const Path& path) {
  const model::Primitive primitive = model::read_primitive(context.asset, object);
  const Path attributes(path, "attributes");
  if (!primitive.attributes.empty()) {
    check_names(context, primitive.attributes, false, attributes);
    check_presence(context, primitive, attributes);
    check_sets(context, primitive, attributes);
  }
  const Path targets(path, "targets");
  for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
    check_names(context, model::read_attributes(context.asset, primitive.targets[i]), true,
                Path(targets, static_cast<std::uint64_t>(i)));
  }
}

void check_listed(const Context& context, const std::set<std::string_view>& listed,
                  const std::vector<Attribute>& attributes, const Path& path) {
  for (const Attribute& attribute : attributes) {
    if (attribute.semantic.kind != SemanticKind::extension) continue;
    const std::string_view extension = model::semantic_extension(attribute.name);
    if (listed.contains(extension)) continue;
    Finding finding = finding_on(
        context, attribute.value, Code::MESH_PRIMITIVE_INVALID_ATTRIBUTE,
        fmt::format("{} is an attribute of the extension {}, which extensionsUsed does not list.",
                    quoted(attribute.name), quoted(extension)),
        "add the extension to extensionsUsed, or start the name with an underscore");
    finding.severity = Severity::warning;
    context.link_sink.report(Path(path, attribute.name), std::move(finding));
  }
}

// After version 2.0, an extension brings attributes only if the asset lists it.
void check_listed_extensions(const Context& context) {
  if (context.version <= schema::kVersion2) return;
  const auto& used = context.checked.extensions_used;
  const std::set<std::string_view> listed(used.begin(), used.end());
  const Path root;
  const Path meshes(root, "meshes");
  for (std::size_t i = 0; i < context.views.meshes.size(); ++i) {
    const Path mesh(meshes, static_cast<std::uint64_t>(i));
    const Path primitives(mesh, "primitives");
    const auto& list = context.views.meshes[i].primitives;
    for (std::size_t k = 0; k < list.size(); ++k) {
      const Path primitive(primitives, static_cast<std::uint64_t>(k));
      check_listed(context, listed, list[k].attributes, Path(primitive, "attributes"));
      const Path targets(primitive, "targets");
      for (std::size_t t = 0; t < list[k].targets.size(); ++t) {
        check_listed(context, listed, model::read_attributes(context.asset, list[k].targets[t]),
                     Path(targets, static_cast<std::uint64_t>(t)));
      }
    }
  }
}

}  // namespace

const RuleGroup& attribute_names_rules() {
  static constexpr ObjectRuleEntry kObjectRules[] = {
      {"mesh.primitive", check_primitive, "attributes"}};
  static constexpr MapRule kMapRules[] = {check_entry};
  static constexpr LinkRule kLinkRules[] = {check_listed_extensions};
  static constexpr RuleGroup group{
      .object_rules = kObjectRules, .link_rules = kLinkRules, .map_rules = kMapRules};
  return group;
}

}  // namespace gltfx::validate

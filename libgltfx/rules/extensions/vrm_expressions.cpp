// SPDX-License-Identifier: Apache-2.0
// Expressions of avatars (VRM 0.x, VRMC_vrm) compared with the morph targets of meshes, and
// materials of VRM 0.x with those of the asset: counts and names over several lists.
#include <algorithm>
#include <cctype>
#include <unordered_map>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "model/mesh.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kExpressionsOf = "VRMC_vrm";
constexpr std::string_view kFirstExpressionsOf = "VRM";
constexpr std::string_view kToonMaterial = "VRMC_materials_mtoon";

// The number of morph targets per primitive, by mesh; nothing: unknown.
std::vector<std::optional<std::uint64_t>> target_counts(const Context& context) {
  std::vector<std::optional<std::uint64_t>> counts;
  for (const model::Mesh& mesh : context.views.meshes) {
    std::optional<std::uint64_t> least;
    for (const model::Primitive& primitive : mesh.primitives) {
      const json::NodeId list = context.document.find(primitive.node, "targets");
      const bool is_list = list != json::kNoNode && context.document.is_array(list);
      const std::uint64_t count = is_list ? context.document.array_size(list) : 0;
      least = std::min(least.value_or(count), count);
    }
    counts.push_back(mesh.has_holes ? std::nullopt : least);
  }
  return counts;
}

class MorphBinds {
 public:
  explicit MorphBinds(const Context& context)
      : context_(context), counts_(target_counts(context)) {}

  void check(json::NodeId bind, std::optional<std::uint32_t> mesh, const std::string& place) const {
    const auto index = model::unsigned_member(context_.document, bind, "index");
    if (!mesh || !index || !counts_[*mesh] || *index < *counts_[*mesh]) return;
    report_at(
        context_.link_sink, place + "/index",
        finding_on(
            context_, context_.document.find(bind, "index"), Code::EXPRESSION_MORPH_TARGET,
            fmt::format("The index is {}, but {} has {} morph targets.", *index,
                        object_label(context_, model::RootArray::meshes, *mesh), *counts_[*mesh])));
  }

 private:
  const Context& context_;
  std::vector<std::optional<std::uint64_t>> counts_;
};

// Invalid weights: a program that uses percentages writes many of them, so only one is reported.
struct BadWeights {
  std::size_t count = 0;
  double weight = 0;
  std::string place;
  json::NodeId value = json::kNoNode;

  void add(double number, json::NodeId node, std::string at) {
    if (count++ != 0) return;
    weight = number;
    value = node;
    place = std::move(at);
  }
  void report(const Context& context) const {
    if (count == 0) return;
    std::string message =
        fmt::format("The weight is {}; it must be between 0 and 1.", number_text(weight));
    if (count > 1) message += fmt::format(" It is the first of {}.", count);
    report_at(context.link_sink, place,
              finding_on(context, value, Code::EXPRESSION_WEIGHT, std::move(message)));
  }
};

// Only toon materials have the other colors.
void check_colors(const Context& context, json::NodeId expression, const std::string& place) {
  const json::Document& document = context.document;
  const auto list = object_list(document, expression, "materialColorBinds");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto material = context.asset.index(list[i], "material", model::RootArray::materials);
    const std::string type = model::string_member(document, list[i], "type");
    if (!material || type.empty() || type == "color" || type == "emissionColor") continue;
    const json::NodeId object = context.asset.elements(model::RootArray::materials)[*material];
    if (model::extension_object(document, object, kToonMaterial) != json::kNoNode) continue;
    report_at(context.link_sink, fmt::format("{}/materialColorBinds/{}/type", place, i),
              finding_on(context, document.find(list[i], "type"), Code::EXPRESSION_COLOR_UNUSED,
                         fmt::format("{} has no effect: {} does not have {}.", type,
                                     object_label(context, model::RootArray::materials, *material),
                                     kToonMaterial)));
  }
}

void check_expression(const Context& context, const MorphBinds& binds, json::NodeId expression,
                      const std::string& place, BadWeights& bad) {
  check_colors(context, expression, place);
  const auto list = object_list(context.document, expression, "morphTargetBinds");
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto node = context.asset.index(list[i], "node", model::RootArray::nodes);
    const std::string at = fmt::format("{}/morphTargetBinds/{}", place, i);
    if (node) binds.check(list[i], context.views.nodes[*node].mesh, at);
    const double weight = model::number_member(context.document, list[i], "weight").value_or(0);
    if (weight >= 0 && weight <= 1) continue;
    bad.add(weight, context.document.find(list[i], "weight"), at + "/weight");
  }
}

void check_expressions(const Context& context) {
  const json::NodeId object = root_extension(context, kExpressionsOf);
  const json::Document& document = context.document;
  const json::NodeId expressions = model::object_member(document, object, "expressions");
  if (expressions == json::kNoNode) return;
  const MorphBinds binds(context);
  BadWeights bad;
  for (const std::string_view group : {"preset", "custom"}) {
    const json::NodeId list = model::object_member(document, expressions, group);
    if (list == json::kNoNode) continue;
    for (const auto member : document.members(list)) {
      std::string place = fmt::format("/extensions/{}/expressions/{}", kExpressionsOf, group);
      append_pointer_step(place, document.key(member.key_id));
      check_expression(context, binds, member.value, place, bad);
    }
  }
  bad.report(context);
}

// Programs look up the preset or, if there is none, the name, both in upper case.
std::string identifier(const json::Document& document, json::NodeId group) {
  std::string id = model::string_member(document, group, "presetName");
  if (id.empty() || id == "unknown") id = model::string_member(document, group, "name");
  for (char& c : id) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return id;
}

void check_first_expressions(const Context& context) {
  const json::NodeId object = root_extension(context, kFirstExpressionsOf);
  const json::Document& document = context.document;
  const json::NodeId master = model::object_member(document, object, "blendShapeMaster");
  const auto groups = object_list(document, master, "blendShapeGroups");
  if (groups.empty()) return;
  const MorphBinds binds(context);
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::string place =
        fmt::format("/extensions/{}/blendShapeMaster/blendShapeGroups/{}", kFirstExpressionsOf, i);
    const auto list = object_list(document, groups[i], "binds");
    for (std::size_t b = 0; b < list.size(); ++b) {
      binds.check(list[b], context.asset.index(list[b], "mesh", model::RootArray::meshes),
                  fmt::format("{}/binds/{}", place, b));
    }
    const std::string id = identifier(document, groups[i]);
    const auto [first, fresh] = known.emplace(id, i);
    if (fresh || id.empty() || groups[i] == json::kNoNode) continue;
    report_at(context.link_sink, place,
              finding_on(context, groups[i], Code::EXPRESSION_REPEATED,
                         fmt::format("Expression {} already has the identifier {}.", first->second,
                                     gltfx::quoted(id))));
  }
}

void check_material_properties(const Context& context) {
  const json::NodeId object = root_extension(context, kFirstExpressionsOf);
  const json::Document& document = context.document;
  const json::NodeId list = document.find(object, "materialProperties");
  const std::string place = fmt::format("/extensions/{}/materialProperties", kFirstExpressionsOf);
  const auto& materials = context.asset.elements(model::RootArray::materials);
  if (object != json::kNoNode && list == json::kNoNode && !materials.empty()) {
    Finding finding = finding_on(context, object, Code::VRM_MATERIAL_MISMATCH,
                                 fmt::format("materialProperties is missing, but the asset has {} "
                                             "materials.",
                                             materials.size()));
    finding.severity = Severity::warning;
    report_at(context.link_sink, place, std::move(finding));
  }
  if (list == json::kNoNode || !document.is_array(list)) return;
  const auto properties = object_list(document, object, "materialProperties");
  if (properties.size() != materials.size()) {
    report_at(context.link_sink, place,
              finding_on(context, list, Code::VRM_MATERIAL_MISMATCH,
                         fmt::format("materialProperties has length {}, but the asset has {} "
                                     "materials.",
                                     properties.size(), materials.size())));
    return;
  }
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const json::NodeId name = document.find(properties[i], "name");
    const std::string material = model::string_member(document, materials[i], "name");
    if (name == json::kNoNode || !document.is_string(name) || document.string(name) == material) {
      continue;
    }
    report_at(
        context.link_sink, fmt::format("{}/{}/name", place, i),
        finding_on(context, name, Code::VRM_MATERIAL_MISMATCH,
                   fmt::format("The name is {}, but that of material {} is {}.",
                               gltfx::quoted(document.string(name)), i, gltfx::quoted(material))));
  }
}

}  // namespace

const RuleGroup& vrm_expressions_rules() {
  static constexpr LinkRule kLinkRules[] = {check_expressions, check_first_expressions,
                                            check_material_properties};
  static constexpr RuleGroup group{.additional = true, .link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
// Extensions that refer by name (AGI_articulations, AGI_stk_metadata): a name must be one thing's
// only. Uniqueness over a list of objects is nothing a schema file states; this file names the
// lists.
#include "validate/rules/name_registries.hpp"

#include <unordered_map>

#include <fmt/format.h>

#include "base/text.hpp"
#include "validate/rules/extension_walk.hpp"
#include "validate/rules/families.hpp"
#include "validate/rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kGood =
    R"({"asset": {"version": "2.0"}, "extensionsUsed": ["AGI_articulations"],
 "extensions": {"AGI_articulations": {"articulations": [{"name": "arm", "stages": [
  {"name": "turn", "type": "zRotate", "minimumValue": -90, "maximumValue": 90, "initialValue": 0},
  {"name": "reach", "type": "xTranslate", "minimumValue": 0, "maximumValue": 2, "initialValue": 0}]}]}},
 "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"camera": 0, "extensions": {"AGI_articulations": {"articulationName": "arm"}}}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})";

constexpr RuleDescription kRules[] = {
    {"ARTICULATION_RANGE_ORDER", Severity::warning,
     "An articulation stage begins outside its own range",
     "A program that keeps to the range moves the part as soon as it is touched.",
     "Order the values: minimumValue, initialValue, maximumValue.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["AGI_articulations"],
 "extensions": {"AGI_articulations": {"articulations": [{"name": "arm", "stages": [
  {"name": "turn", "type": "zRotate", "minimumValue": 10, "maximumValue": 90, "initialValue": 0}]}]}},
 "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"camera": 0, "extensions": {"AGI_articulations": {"articulationName": "arm"}}}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})",
     kGood, Fix::none, false},
    {"NAME_REPEATED", Severity::error, "A name that is referred to belongs to two things",
     "Nodes and applications refer to these objects by name; which one they get is chance.",
     "Give each its own name.",
     R"({"asset": {"version": "2.0"}, "extensionsUsed": ["AGI_articulations"],
 "extensions": {"AGI_articulations": {"articulations": [{"name": "arm", "stages": [
  {"name": "turn", "type": "zRotate", "minimumValue": -90, "maximumValue": 90, "initialValue": 0},
  {"name": "turn", "type": "xTranslate", "minimumValue": 0, "maximumValue": 2, "initialValue": 0}]}]}},
 "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"camera": 0, "extensions": {"AGI_articulations": {"articulationName": "arm"}}}],
 "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1}}]})",
     kGood, Fix::none, false},
};

void check_range(const Context& context, json::NodeId stage, const Path& path) {
  const auto least = model::number_member(context.document, stage, "minimumValue");
  const auto most = model::number_member(context.document, stage, "maximumValue");
  const auto first = model::number_member(context.document, stage, "initialValue");
  if (!least || !most || !first || (*least <= *first && *first <= *most)) return;
  report_member(context.link_sink, context, path, stage, "initialValue", "ARTICULATION_RANGE_ORDER",
                fmt::format("The stage begins at {}, outside of {} to {}.", number_text(*first),
                            number_text(*least), number_text(*most)));
}

void check_articulations(const Context& context) {
  constexpr std::string_view kExtension = "AGI_articulations";
  const json::NodeId object = root_extension(context, kExtension);
  if (object == json::kNoNode) return;
  const Path root;
  const Path extensions(root, "extensions");
  const Path extension(extensions, kExtension);
  const Path list(extension, "articulations");
  const auto articulations = object_list(context.document, object, "articulations");
  check_unique_names(context, articulations, list);
  for (std::size_t i = 0; i < articulations.size(); ++i) {
    const auto stages = object_list(context.document, articulations[i], "stages");
    const Path articulation(list, i);
    const Path at(articulation, "stages");
    check_unique_names(context, stages, at);
    for (std::size_t s = 0; s < stages.size(); ++s) check_range(context, stages[s], Path(at, s));
  }
}

void check_panel_groups(const Context& context) {
  constexpr std::string_view kExtension = "AGI_stk_metadata";
  const json::NodeId object = root_extension(context, kExtension);
  if (object == json::kNoNode) return;
  const Path root;
  const Path extensions(root, "extensions");
  const Path extension(extensions, kExtension);
  check_unique_names(context, object_list(context.document, object, "solarPanelGroups"),
                     Path(extension, "solarPanelGroups"));
}

constexpr LinkRule kLinkRules[] = {check_articulations, check_panel_groups};

}  // namespace

void check_unique_names(const Context& context, const std::vector<json::NodeId>& objects,
                        const Path& list) {
  const json::Document& document = context.document;
  std::unordered_map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const json::NodeId name = document.find(objects[i], "name");
    if (name == json::kNoNode || !document.is_string(name)) continue;
    const auto [first, fresh] = known.try_emplace(document.string(name), i);
    if (fresh) continue;
    const Path at(list, i);
    report_link(context, Path(at, "name"), name, "NAME_REPEATED",
                fmt::format("Element {} of this list is named {}, too.", first->second,
                            gltfx::quoted(first->first)));
  }
}

const Family& name_registries_family() {
  static const Family family{"name_registries", kRules, {}, kLinkRules};
  return family;
}

}  // namespace gltfx::validate

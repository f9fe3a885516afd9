// SPDX-License-Identifier: Apache-2.0
// Extensions that refer by name (AGI_articulations, AGI_stk_metadata): a name must be unique.
// Schema files cannot state uniqueness over a list of objects; this file names the lists.
#include "rules/extensions/agi_names.hpp"

#include <unordered_map>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/number.hpp"
#include "base/text.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

void check_range(const Context& context, json::NodeId stage, const Path& path) {
  const auto least = model::number_member(context.document, stage, "minimumValue");
  const auto most = model::number_member(context.document, stage, "maximumValue");
  const auto first = model::number_member(context.document, stage, "initialValue");
  if (!least || !most || !first || (*least <= *first && *first <= *most)) return;
  report_member(context.link_sink, context, path, stage, "initialValue",
                Code::ARTICULATION_RANGE_ORDER,
                fmt::format("initialValue is {}; it must be between {} and {}.",
                            number_text(*first), number_text(*least), number_text(*most)));
}

void check_articulations(const Context& context) {
  constexpr std::string_view kNameRegistriesExtension = "AGI_articulations";
  const json::NodeId object = root_extension(context, kNameRegistriesExtension);
  if (object == json::kNoNode) return;
  const Path root;
  const Path extensions(root, "extensions");
  const Path extension(extensions, kNameRegistriesExtension);
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
  constexpr std::string_view kNameRegistriesExtension = "AGI_stk_metadata";
  const json::NodeId object = root_extension(context, kNameRegistriesExtension);
  if (object == json::kNoNode) return;
  const Path root;
  const Path extensions(root, "extensions");
  const Path extension(extensions, kNameRegistriesExtension);
  check_unique_names(context, object_list(context.document, object, "solarPanelGroups"),
                     Path(extension, "solarPanelGroups"));
}

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
    report_link(context, Path(at, "name"), name, Code::NAME_REPEATED,
                fmt::format("Element {} already has the name {}.", first->second,
                            gltfx::quoted(first->first)));
  }
}

const RuleGroup& agi_names_rules() {
  static constexpr LinkRule kLinkRules[] = {check_articulations, check_panel_groups};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

// SPDX-License-Identifier: Apache-2.0
// KHR_techniques_webgl: values that materials give to uniforms, and the meanings that uniforms and
// attributes may have. This file is about that one extension and names it.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kTechniquesExtension = "KHR_techniques_webgl";

constexpr std::array<std::string_view, 16> kUniforms{"LOCAL",
                                                     "MODEL",
                                                     "VIEW",
                                                     "PROJECTION",
                                                     "MODELVIEW",
                                                     "MODELVIEWPROJECTION",
                                                     "MODELINVERSE",
                                                     "VIEWINVERSE",
                                                     "PROJECTIONINVERSE",
                                                     "MODELVIEWINVERSE",
                                                     "MODELVIEWPROJECTIONINVERSE",
                                                     "MODELINVERSETRANSPOSE",
                                                     "MODELVIEWINVERSETRANSPOSE",
                                                     "VIEWPORT",
                                                     "JOINTMATRIX",
                                                     "ALPHACUTOFF"};
// The extension is older than some current names.
constexpr std::array<std::string_view, 8> kAttributes{"POSITION", "NORMAL", "TANGENT", "TEXCOORD",
                                                      "COLOR",    "JOINT",  "JOINTS",  "WEIGHTS"};
constexpr std::string_view kOneWeight = "WEIGHT";

bool is_attribute(std::string_view semantic) {
  const std::size_t set = semantic.rfind('_');
  const bool numbered = set != std::string_view::npos && set + 1 < semantic.size() &&
                        semantic.find_first_not_of("0123456789", set + 1) == std::string_view::npos;
  const std::string_view name = numbered ? semantic.substr(0, set) : semantic;
  return name == kOneWeight ||
         std::find(kAttributes.begin(), kAttributes.end(), name) != kAttributes.end();
}

bool is_uniform(std::string_view semantic) {
  return std::find(kUniforms.begin(), kUniforms.end(), semantic) != kUniforms.end();
}

// Each attribute or uniform of a technique.
void check_semantics(const Context& context, json::NodeId technique, std::string_view member,
                     bool (*known)(std::string_view), const Path& path) {
  const json::Document& document = context.document;
  const json::NodeId map = model::object_member(document, technique, member);
  if (map == json::kNoNode) return;
  const Path list(path, member);
  for (const auto each : document.members(map)) {
    const std::string semantic = model::string_member(document, each.value, "semantic");
    if (semantic.empty() || semantic.front() == '_' || known(semantic)) continue;
    const Path at(list, document.key(each.key_id));
    report_link(context, Path(at, "semantic"), document.find(each.value, "semantic"),
                Code::TECHNIQUE_SEMANTIC_UNKNOWN,
                fmt::format("{} is not a known semantic.", gltfx::quoted(semantic)));
  }
}

void check_technique(const Context& context, json::NodeId technique, const Path& path) {
  check_semantics(context, technique, "attributes", is_attribute, path);
  check_semantics(context, technique, "uniforms", is_uniform, path);
}

void check_values(const Context& context, const ExtensionPlace& place, json::NodeId uniforms,
                  const Path& path) {
  const json::Document& document = context.document;
  const json::NodeId values = model::object_member(document, place.object, "values");
  const Path list(path, "values");
  if (values != json::kNoNode) {
    for (const auto each : document.members(values)) {
      const std::string_view name = document.key(each.key_id);
      if (document.find(uniforms, name) != json::kNoNode) continue;
      report_link(context, Path(list, name), each.key, Code::TECHNIQUE_VALUE_UNKNOWN,
                  fmt::format("The technique has no uniform {}.", gltfx::quoted(name)));
    }
  }
  if (uniforms == json::kNoNode) return;
  for (const auto each : document.members(uniforms)) {
    const std::string_view name = document.key(each.key_id);
    const bool served = document.find(each.value, "semantic") != json::kNoNode ||
                        document.find(each.value, "node") != json::kNoNode ||
                        document.find(each.value, "value") != json::kNoNode ||
                        document.find(values, name) != json::kNoNode;
    if (served || !document.is_object(each.value)) continue;
    report_link(context, path, place.object, Code::TECHNIQUE_VALUE_MISSING,
                fmt::format("The uniform {} of the technique has neither a value nor a default.",
                            gltfx::quoted(name)));
  }
}

void check_techniques(const Context& context) {
  const json::NodeId object = root_extension(context, kTechniquesExtension);
  if (object == json::kNoNode) return;
  const Path root;
  const Path extensions(root, "extensions");
  const Path extension(extensions, kTechniquesExtension);
  const Path list(extension, "techniques");
  const auto techniques = object_list(context.document, object, "techniques");
  for (std::size_t i = 0; i < techniques.size(); ++i) {
    check_technique(context, techniques[i], Path(list, i));
  }
  for_each_extension(
      context, model::RootArray::materials, kTechniquesExtension,
      [&](const ExtensionPlace& place, const Path& path) {
        const auto index = model::unsigned_member(context.document, place.object, "technique");
        if (!index || *index >= techniques.size()) return;
        const json::NodeId technique = techniques[*index];
        if (technique == json::kNoNode) return;
        check_values(context, place, model::object_member(context.document, technique, "uniforms"),
                     path);
      });
}

}  // namespace

const RuleGroup& techniques_webgl_rules() {
  static constexpr LinkRule kLinkRules[] = {check_techniques};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

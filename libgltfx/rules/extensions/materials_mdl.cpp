// SPDX-License-Identifier: Apache-2.0
// NV_materials_mdl: the functions that a material calls, and the names of arguments. This file is
// about that one extension and names it.

#include <fmt/format.h>

#include "base/codes.hpp"
#include "base/text.hpp"
#include "rules/context.hpp"
#include "rules/extension_walk.hpp"
#include "rules/extensions/agi_names.hpp"
#include "rules/finding.hpp"

namespace gltfx::validate {
namespace {

constexpr std::string_view kMdlExtension = "NV_materials_mdl";

void check_entry(const Context& context, const ExtensionPlace& place,
                 const std::vector<json::NodeId>& calls, const Path& path) {
  const json::Document& document = context.document;
  const auto index = model::unsigned_member(document, place.object, "functionCall");
  if (!index || *index >= calls.size()) return;
  const json::NodeId type = model::object_member(document, calls[*index], "type");
  const std::string name = model::string_member(document, type, "typeName");
  if (name.empty() || name == "material") return;
  report_member(context.link_sink, context, path, place.object, "functionCall",
                Code::MDL_NOT_A_MATERIAL,
                fmt::format("Function call {} returns {}; it must return a material.", *index,
                            gltfx::quoted(name)));
}

void check_mdl(const Context& context) {
  const json::NodeId object = root_extension(context, kMdlExtension);
  if (object == json::kNoNode) return;
  const auto calls = object_list(context.document, object, "functionCalls");
  const Path root;
  const Path extensions(root, "extensions");
  const Path extension(extensions, kMdlExtension);
  const Path list(extension, "functionCalls");
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const Path call(list, i);
    check_unique_names(context, object_list(context.document, calls[i], "arguments"),
                       Path(call, "arguments"));
  }
  for_each_extension(context, model::RootArray::materials, kMdlExtension,
                     [&](const ExtensionPlace& place, const Path& path) {
                       check_entry(context, place, calls, path);
                     });
}

}  // namespace

const RuleGroup& materials_mdl_rules() {
  static constexpr LinkRule kLinkRules[] = {check_mdl};
  static constexpr RuleGroup group{.link_rules = kLinkRules};
  return group;
}

}  // namespace gltfx::validate

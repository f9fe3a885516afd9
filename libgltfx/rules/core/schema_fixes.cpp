// SPDX-License-Identifier: Apache-2.0
// Fixes of findings of the schema walk: repeats, empty members, and the lists of extensions.
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "base/codes.hpp"
#include "graph/extensions.hpp"
#include "rules/context.hpp"
#include "rules/core/fix_data.hpp"
#include "rules/fix_deletion.hpp"

namespace gltfx::validate {
namespace {

// An unknown name may be misspelt, or not an extension.
bool declare(Fixing& fixing, const Subject& extension) {
  if (fixing.schemas().find_extension(extension.name) == schema::kNone) return false;
  if (!fixing.extensions_used().can_change()) return false;
  fixing.extensions_used().add(extension.name);
  return true;
}

/// Names of all extensions with an object in the document, except in extras.
struct ExtensionsSeen {
  explicit ExtensionsSeen(const Fixing& fixing) {
    const json::Document& document = fixing.document();
    graph::each_extension(document,
                          [&](const auto& member) { names.emplace(document.key(member.key_id)); });
  }
  std::set<std::string, std::less<>> names;
};

// A used extension is declared; an unused one is deleted from extensionsRequired.
bool declare_or_forget(Fixing& fixing, const Subject& required) {
  if (!fixing.document().is_string(required.value)) return false;
  const std::string name = fixing.document().string(required.value);
  const schema::ExtensionId id = fixing.schemas().find_extension(name);
  const bool without_objects =
      id != schema::kNone && fixing.schemas().extensions()[id].attachment_points.empty();
  if (without_objects || fixing.table<ExtensionsSeen>().names.contains(name)) {
    if (!fixing.extensions_used().can_change()) return false;
    fixing.extensions_used().add(name);
    return true;
  }
  if (!fixing.extensions_required().has(name)) return false;
  fixing.extensions_required().remove_at(required.value);
  return true;
}

// The extension's object is marked, or its name in extensionsUsed.
bool require_extension(Fixing& fixing, const Subject& extension) {
  if (!fixing.extensions_required().can_change()) return false;
  fixing.extensions_required().add(extension.is_name ? std::string(extension.name)
                                                     : fixing.document().string(extension.value));
  return true;
}

// A required empty member is not deleted.
bool remove_empty(Fixing& fixing, const Subject& empty) {
  constexpr std::array<std::string_view, 8> kNeeded{
      "asset", "attributes", "channels", "joints", "primitives", "samplers", "sparse", "target"};
  if (write_bound(fixing, empty.value)) return true;
  const auto needed = std::find(kNeeded.begin(), kNeeded.end(), empty.name);
  return needed == kNeeded.end() && fixing.remove_member(empty.value);
}

// All at once: there may be more of them than a report has findings.
bool remove_repeated_names(Fixing& fixing, json::NodeId list) {
  if (!fixing.claim(list)) return true;
  const json::Document& document = fixing.document();
  json::KeyTable names;
  for (const json::NodeId element : document.elements(list)) {
    if (!document.is_string(element) || document.insert_string(element, names)) continue;
    if (fixing.claim(element)) fixing.editor().remove(list, element);
  }
  return true;
}

// Only in lists whose order and length have no meaning, unlike the joints of a skin.
bool remove_repeat(Fixing& fixing, const Subject& repeat) {
  const auto is_set = [](std::string_view name) {
    return name == "nodes" || name == "children" || name == "extensionsUsed" ||
           name == "extensionsRequired";
  };
  const json::NodeId list = repeat.owner;
  if (list == json::kNoNode || !is_set(fixing.member_name(list))) return false;
  const json::Document& document = fixing.document();
  if (repeat.value == json::kNoNode) {
    return fixing.is_claimed(list) || fixing.replace(list, without_repeats(document, list));
  }
  if (document.is_string(repeat.value)) return remove_repeated_names(fixing, list);
  if (!fixing.claim(repeat.value)) return false;
  fixing.editor().remove(list, repeat.value);
  return true;
}

/// Current names of properties by their names in earlier drafts; empty if two properties had the
/// name.
struct DraftNames {
  explicit DraftNames(const Fixing& fixing) {
    const schema::Set& set = fixing.schemas();
    for (schema::TypeId id = 0; id < set.types().size(); ++id) {
      for (const schema::Property& property : set.type(id).properties) {
        for (const std::string& alias : property.aliases) {
          const auto [known, is_new] = now.emplace(alias, property.name);
          if (!is_new && known->second != property.name) known->second.clear();
        }
      }
    }
  }
  std::map<std::string, std::string, std::less<>> now;
};

bool rename_draft(Fixing& fixing, const Subject& member) {
  const auto& names = fixing.table<DraftNames>().now;
  const auto name = names.find(member.name);
  if (name == names.end() || name->second.empty()) return false;
  const json::NodeId key = member.value - 1;
  if (fixing.document().holds(member.owner, name->second) || !fixing.claim(key)) return false;
  fixing.editor().rename(key, name->second);
  return true;
}

constexpr FixEntry kSchemaFixes[] = {
    {Code::PROPERTY_RENAMED, rename_draft},
    {Code::UNDECLARED_EXTENSION, declare},
    {Code::UNUSED_EXTENSION_REQUIRED, declare_or_forget},
    {Code::NON_REQUIRED_EXTENSION, require_extension},
    {Code::EMPTY_ENTITY, remove_empty},
    {Code::DUPLICATE_ELEMENTS, remove_repeat},
    {Code::UNRESOLVED_REFERENCE, delete_marked, FixStage::deletion},
};

}  // namespace

const RuleGroup& schema_fix_rules() {
  static constexpr RuleGroup group{.fixes = kSchemaFixes};
  return group;
}

}  // namespace gltfx::validate

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

// `place` is the name of an extension's object. An unknown name may be misspelt, or not an
// extension.
bool declare(Fixing& fixing, Span place) {
  const json::NodeId key = fixing.node_at(place);
  if (key == json::kNoNode || fixing.document().kind(key) != json::Kind::key) return false;
  const std::string_view name = fixing.document().key(fixing.document().node(key).next);
  if (fixing.schemas().find_extension(name) == schema::kNone) return false;
  if (!fixing.extensions_used().can_change()) return false;
  fixing.extensions_used().add(name);
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

// `place` is a name in extensionsRequired. A used extension is declared; an unused one is deleted.
bool declare_or_forget(Fixing& fixing, Span place) {
  const json::NodeId node = fixing.node_at(place);
  if (node == json::kNoNode || !fixing.document().is_string(node)) return false;
  const std::string name = fixing.document().string(node);
  const schema::ExtensionId id = fixing.schemas().find_extension(name);
  const bool without_objects =
      id != schema::kNone && fixing.schemas().extensions()[id].attachment_points.empty();
  if (without_objects || fixing.table<ExtensionsSeen>().names.contains(name)) {
    if (!fixing.extensions_used().can_change()) return false;
    fixing.extensions_used().add(name);
    return true;
  }
  if (!fixing.extensions_required().has(name)) return false;
  fixing.extensions_required().remove_at(node);
  return true;
}

// `place` is a name in extensionsUsed, or the name of an extension's object.
bool require_extension(Fixing& fixing, Span place) {
  const json::NodeId node = fixing.node_at(place);
  if (node == json::kNoNode || !fixing.extensions_required().can_change()) return false;
  const json::Document& document = fixing.document();
  const std::string name = document.kind(node) == json::Kind::key
                               ? std::string(document.key(document.node(node).next))
                               : document.string(node);
  fixing.extensions_required().add(name);
  return true;
}

// A required empty member is not deleted.
bool remove_empty(Fixing& fixing, Span place) {
  constexpr std::array<std::string_view, 8> kNeeded{
      "asset", "attributes", "channels", "joints", "primitives", "samplers", "sparse", "target"};
  const json::NodeId value = fixing.node_at(place);
  if (value == json::kNoNode) return false;
  if (write_bound(fixing, value)) return true;
  const auto needed = std::find(kNeeded.begin(), kNeeded.end(), fixing.member_name(value));
  if (needed != kNeeded.end()) return false;
  return fixing.remove_member(value);
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
bool remove_repeat(Fixing& fixing, Span place) {
  const auto is_set = [](std::string_view name) {
    return name == "nodes" || name == "children" || name == "extensionsUsed" ||
           name == "extensionsRequired";
  };
  const json::NodeId node = fixing.node_around(place);
  if (node == json::kNoNode) return false;
  const json::Document& document = fixing.document();
  if (document.kind(node) == json::Kind::number_array) {
    if (!is_set(fixing.member_name(node))) return false;
    return fixing.is_claimed(node) || fixing.replace(node, without_repeats(document, node));
  }
  const json::NodeId list = fixing.parent(node);
  if (list == json::kNoNode || !is_set(fixing.member_name(list))) return false;
  if (document.is_string(node)) return remove_repeated_names(fixing, list);
  if (!fixing.claim(node)) return false;
  fixing.editor().remove(list, node);
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

// `place` is a name of an earlier draft.
bool rename_draft(Fixing& fixing, Span place) {
  const json::NodeId key = fixing.node_at(place);
  if (key == json::kNoNode || fixing.document().kind(key) != json::Kind::key) return false;
  const auto& names = fixing.table<DraftNames>().now;
  const auto name = names.find(fixing.document().key(fixing.document().node(key).next));
  if (name == names.end() || name->second.empty()) return false;
  if (fixing.document().holds(fixing.parent(key), name->second) || !fixing.claim(key)) return false;
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

// SPDX-License-Identifier: Apache-2.0
/// The input of rules, and their registration in the phases.
#pragma once

#include <gltfx/validate.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/json_pointer.hpp"
#include "base/sink.hpp"
#include "container/container.hpp"
#include "container/opened_files.hpp"
#include "container/uri.hpp"
#include "json/document.hpp"
#include "model/asset.hpp"
#include "model/opened_asset.hpp"
#include "model/scene_graph.hpp"
#include "model/views.hpp"
#include "rules/data_uris.hpp"
#include "rules/fix_entry.hpp"
#include "rules/khronos/deviations.hpp"
#include "rules/khronos/link_order.hpp"
#include "schema/check.hpp"
#include "schema/set.hpp"
#include "schema/version.hpp"

namespace gltfx::validate {

/// The data that a rule may read. Lives for one asset; rules do not keep it.
struct Context {
  const container::Container& container;
  container::OpenedFiles& files;
  const json::Document& document;
  const schema::Set& schemas;
  const model::Asset& asset;
  const ValidateOptions& options;
  /// Results of the schema walk. Complete for link rules; empty while object rules run.
  schema::CheckResult checked;
  /// Findings of phase 3, and of phase 4, which is reported after it.
  Sink& schema_sink;
  Sink& link_sink;
  /// Accessors, buffer views and their first uses. Complete for link rules; empty before.
  model::Views views{};
  /// Parents of nodes. Complete for link rules; empty before.
  model::SceneGraph graph{};
  /// Deviations::reading_order: the sink that `link_sink` refers to, with the broken references
  /// that are not reported yet.
  LinkOrder* order = nullptr;
  /// Filled by the phases that read data URIs; no two of them run at once.
  DataUris* data_uris = nullptr;
  /// The asset, for what its external assets hold.
  const model::OpenedAsset* opened = nullptr;

  /// Deviations of the profile; rules do not check the profile itself.
  const Deviations& deviations = deviations_of(options.profile);
  /// The version of glTF that the asset is judged by.
  schema::Version version = deviations.minor_versions_are_unknown
                                ? schema::kVersion2
                                : schema::judged_version(document, schemas);

  container::UriReading uri_reading() const {
    return deviations.uris_are_repaired ? container::UriReading::lenient
                                        : container::UriReading::strict;
  }
};

/// A rule about the members of one object, run right after its members are checked. Reports to
/// `schema_sink`.
using ObjectRule = void (*)(const Context& context, json::NodeId object, const Path& path);

/// A rule about references between objects, run once when all objects are read. Reports to
/// `link_sink`.
using LinkRule = void (*)(const Context& context);

/// Deviations::reading_order may need a separate rule in place of one that sees all members.
enum class Runs : std::uint8_t { always, in_reading_order, otherwise };

struct ObjectRuleEntry {
  std::string_view type;  ///< object type name: "node", "mesh.primitive"
  ObjectRule rule;
  /// Reading order: the rule runs after this member; empty: after all members.
  std::string_view behind = {};
  Runs runs = Runs::always;
};

/// Reading order: decides how a member is treated before its form is checked. Findings go to
/// `schema_sink`.
using MemberRule = schema::Reading (*)(const Context& context, json::NodeId object,
                                       json::NodeId value, const Path& object_path);
struct MemberRuleEntry {
  std::string_view type, member;
  MemberRule rule;
};

/// Reading order: a rule about one member of an object that maps names to indices.
using MapRule = void (*)(const Context& context, std::string_view name, json::NodeId value,
                         const Path& map_path);

/// The rules that a file of rules/ contributes to the walk over the objects and to the phase of
/// links. It defines `const RuleGroup& NAME_rules()`, which rules/order.cpp lists.
struct RuleGroup {
  /// Deviations::no_additional_rules leaves its link rules out.
  bool additional = false;
  std::span<const ObjectRuleEntry> object_rules = {};
  std::span<const LinkRule> link_rules = {};
  std::span<const MemberRuleEntry> member_rules = {};
  std::span<const MapRule> map_rules = {};
  /// Fixes for its findings (rules/fix.hpp).
  std::span<const FixEntry> fixes = {};
};

/// All groups, in the order in which they run (rules/order.cpp).
std::span<const RuleGroup> rule_groups();

/// The description of a rule of gltfx.
const RuleDescription& description(Code code);
/// The description of any rule: also of an own rule of the options.
const RuleDescription& description(const ValidateOptions& options, Code code);
/// The code of that name, also of a page of `own`, which may be null; or nothing.
std::optional<Code> code_of(std::string_view name, const OwnRules* own);
/// The severity of a rule of gltfx in the profile `strict`.
Severity strict_severity(Code code);

/// A rule for assets of a version of glTF and later ones.
struct LaterSeverity {
  Code code;
  schema::Version since;
  std::optional<Severity> severity;  ///< nothing: the rule does not apply
};
std::span<const LaterSeverity> later_severities();

/// Span of a member's value, or of the first character of the object when it has no such member.
Span member_span(const json::Document& document, json::NodeId object, std::string_view member);
/// The first character of a value: keeps the caret short for a whole object.
Span first_character(const json::Document& document, json::NodeId value);

}  // namespace gltfx::validate
